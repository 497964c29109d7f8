/// \file viewer_options.h
/// What the verbs `view` and `screenshot` share: the options of the viewer and the way from them to its state.
#pragma once

#include "app/options.h"
#include "ui/viewer/viewer.h"

#include <memory>
#include <optional>
#include <vector>

namespace cellcut {

struct ViewerCommandLine {
  RenderOptions render;  ///< --size is the window's
  bool sceneGiven = false;
  float uiScale = 1;
  std::optional<std::filesystem::path> reference;
  std::optional<WindowKind> windowKind;
};

/// SCENE, the options of a picture, --ui-scale, --reference, --gl.
void addViewerOptions(CLI::App& verb, ViewerCommandLine& options, bool sceneRequired);

/// What a viewer reads at its start, a script aside.
std::vector<NamedFile> inputsOf(const ViewerCommandLine& options);

/// The scene that the options name, or a building with 4,000 lamps.
/// \throws InputError as loadScene()
std::shared_ptr<const Scene> loadViewerScene(const ViewerCommandLine& options);

/// \throws InputError for a camera that is not there or a reference that cannot be read
ViewerOptions viewerOptions(const ViewerCommandLine& options, const Scene& scene);

/// Loads a scene with the options' environment and scales.
SceneLoader sceneLoader(const ViewerCommandLine& options);

}  // namespace cellcut
