/// \file viewer_state.h
/// What a person can set: panels edit a copy, the viewer applies it.
#pragma once

#include "renderer/trace/session_input.h"
#include "ui/image_view.h"
#include "ui/overlays/color_scale.h"
#include "ui/overlays/overlay.h"
#include "ui/overlays/slice.h"
#include "ui/viewer/camera_control.h"

#include <array>
#include <optional>

namespace cellcut {

struct OverlayChoice {
  Overlay overlay = Overlay::kNone;
  ScaleSettings scale;
  float opacity = 0.7f;  ///< [0, 1]
  bool grid = false;     ///< wireframe of the touched cells
  Slice slice;           ///< overlays of cells are drawn on it

  bool operator==(const OverlayChoice&) const = default;
};

enum class ErrorMetric { kMse, kRelMse, kFlip };

struct PlotChoice {
  ErrorMetric metric = ErrorMetric::kRelMse;
  bool overPasses = false;  ///< else over seconds
};

inline constexpr std::size_t kBookmarks = 9;

struct ViewerState {
  RenderSettings settings;  ///< width and height follow the window
  std::optional<std::uint64_t> passLimit;
  std::optional<double> timeLimit;   ///< seconds
  std::optional<double> noiseLimit;  ///< √relMSE, as SessionInput's
  bool paused = false;
  ImageViewSettings display;
  OverlayChoice overlay;
  std::optional<glm::ivec2> pick;              ///< image pixel whose cell is inspected
  std::optional<std::size_t> hoveredCluster;   ///< row of the inspector, or box in the picture, under the pointer
  std::optional<std::size_t> selectedCluster;  ///< row that was clicked
  int selectedLight = 0;                       ///< of the selected cluster, from 1; 0: all of them
  std::array<std::optional<CameraPose>, kBookmarks> bookmarks;  ///< of this scene
  std::size_t chosen = 0;      ///< the bookmark or the recent file that a command is about
  int referencePasses = 1024;  ///< of a reference made here
  PlotChoice plot;
  bool duel = false;
  Strategy opponent = Strategy::kPower;  ///< in a duel
  bool showUi = true;
  bool showHelp = false;
};

}  // namespace cellcut
