#include "app/viewer_options.h"

#include "app/numbers.h"
#include "app/option_text.h"
#include "renderer/scene/recipes/recipe.h"

#include <array>
#include <unistd.h>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

/// A recipe goes through a file, as every scene does.
std::shared_ptr<const Scene> defaultScene(const RenderOptions& render) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("cellcut-rooms-" + std::to_string(getpid()) + ".glb");
  writeFileAtomically(file, generateRecipe(Recipe::kRooms, kDefaultRecipeLights, 0));
  RenderOptions options = render;
  options.scene = file;
  struct Remove {
    const std::filesystem::path& file;
    ~Remove() {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }
  } const remove{file};
  return std::make_shared<const Scene>(loadWithOptions(options));
}

}  // namespace

void addViewerOptions(CLI::App& verb, ViewerCommandLine& o, bool sceneRequired) {
  const auto scene = [&o](const std::string& text) {
    o.render.scene = text;
    o.sceneGiven = true;
  };
  addText(verb, "SCENE", "", scene, "Scene: .gltf, .glb or .obj")->required(sceneRequired);
  addPictureOptions(verb, o.render);
  addText(
      verb, "--ui-scale", "X",
      [&o](const std::string& t) {
        o.uiScale = static_cast<float>(parseReal("--ui-scale", t, {.least = 0.5, .most = 4}));
      },
      "Size of text and panels (default 1)");
  addText(
      verb, "--reference", "FILE", [&o](const std::string& t) { o.reference = t; },
      "Converged picture (.exr, .pfm, .hdr) for the overlay 'error'");
  addText(
      verb, "--gl", "egl|osmesa",
      [&o](const std::string& t) {
        o.windowKind = requireNamed(std::array{WindowKind::kEgl, WindowKind::kOsmesa}, "--gl", t);
      },
      "Draw without a display, by EGL or OSMesa");
}

std::vector<NamedFile> inputsOf(const ViewerCommandLine& options) {
  std::vector<NamedFile> inputs = inputsOf(options.render);
  inputs.push_back({"--reference", options.reference.value_or("")});
  return inputs;
}

std::shared_ptr<const Scene> loadViewerScene(const ViewerCommandLine& options) {
  if (!options.sceneGiven) return defaultScene(options.render);
  return std::make_shared<const Scene>(loadWithOptions(options.render));
}

ViewerOptions viewerOptions(const ViewerCommandLine& options, const Scene& scene) {
  ViewerOptions viewer;
  viewer.uiScale = options.uiScale;
  viewer.file = options.render.scene;
  viewer.state.settings = options.render.settings;
  viewer.state.settings.camera = findCamera(scene, options.render.camera);
  if (const std::optional<StopRule>& stop = options.render.stop) {
    if (stop->kind == StopRule::Kind::kPasses) viewer.state.passLimit = stop->passes;
    if (stop->kind == StopRule::Kind::kSeconds) viewer.state.timeLimit = stop->seconds;
    if (stop->kind == StopRule::Kind::kNoise) viewer.state.noiseLimit = stop->noise;
  }
  if (options.reference) viewer.reference = std::make_shared<const ImageRgb>(readImage(*options.reference));
  return viewer;
}

SceneLoader sceneLoader(const ViewerCommandLine& options) {
  return [render = options.render](const std::filesystem::path& file) {
    RenderOptions wanted = render;
    wanted.scene = file;
    return std::make_shared<const Scene>(loadWithOptions(wanted));
  };
}

}  // namespace cellcut
