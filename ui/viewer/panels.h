/// \file panels.h
/// The viewer's panels. Each draws what there is and edits the state that it is handed; nobody is told.
#pragma once

#include "renderer/trace/snapshot.h"
#include "ui/viewer/convergence.h"
#include "ui/viewer/overlay_source.h"
#include "ui/viewer/recent_files.h"
#include "ui/viewer/reference.h"
#include "ui/viewer/trade.h"
#include "ui/viewer/viewer_state.h"
#include "ui/viewer/widgets.h"

#include <string>

namespace cellcut {

/// What is known of the errors.
struct MeasureFacts {
  bool making = false;                 ///< a reference
  std::uint64_t made = 0, wanted = 0;  ///< samples per pixel of it
  const Reference& reference;
  bool fits;                        ///< the reference shows what is rendered
  const ConvergenceRun& run;        ///< of what is rendered
  const ConvergenceRun* secondRun;  ///< of the opponent; null without a duel
  const std::vector<ConvergenceRun>& kept;
};

/// What panels show and cannot change.
struct ViewerFacts {
  const Scene& scene;
  const Snapshot& snapshot;
  const OverlayPicture* overlay;  ///< null before the first
  bool hasStored;                 ///< a picture to compare with is stored
  const Snapshot* second;         ///< of the opponent in a duel; null without
  const std::vector<std::filesystem::path>& recent;
  MeasureFacts measure;
  bool trying;          ///< settings are being tried
  const Trade* trade;   ///< what that said of what is rendered; null: nothing yet
  std::string problem;  ///< of the last file or edit, for a person; empty: none
  std::string notice;   ///< what was saved last; empty: nothing
};

/// What a person asked for by a button or a key: at most one per frame.
enum class ViewerCommand {
  kNone,
  kStore,   ///< keep the picture for comparison
  kForget,  ///< drop it
  kSave,    ///< the window as PNG, the rendering as EXR
  kReload,  ///< the scene's file
  kResetCamera,
  kCopyCamera,
  kPasteCamera,
  kSingleStep,
  kDismiss,  ///< the problem and the notice
  kUnpick,
  kExportCut,
  kSolo,  ///< only the selected lights
  kMute,  ///< all but the selected lights
  kAllLights,
  kKeepView,    ///< as bookmark state.chosen
  kRecallView,  ///< bookmark state.chosen
  kOpenRecent,  ///< file state.chosen of the list
  kReference,   ///< make one, or take it as far as it is
  kKeepRun,
  kClearRuns,
  kSaveCsv,
  kFindBest  ///< try settings, or stop that
};

ViewerCommand drawRenderPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
ViewerCommand drawViewPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
ViewerCommand drawReferencePanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
ViewerCommand drawTradePanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
void drawDuelPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
void drawOverlayPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
void drawStatisticsPanel(Widgets& widgets, const ViewerFacts& facts);
ViewerCommand drawInspectorPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state);
ViewerCommand drawMessages(Widgets& widgets, const ViewerFacts& facts);
void drawHelp(bool& open);
/// The bar that says which colour is which number, in a corner of the picture.
/// \param area  of the picture, framebuffer pixels
void drawLegend(const OverlayPicture& overlay, const OverlayChoice& choice, const PixelRect& area, float uiScale);

/// Below the slider of that label: what other values of it cost, as far as they were tried.
void drawCosts(const Trade* trade, const char* setting);
/// Of what a quality sets.
bool haveSameCuts(const SamplerSettings& a, const SamplerSettings& b);
void useCuts(SamplerSettings& settings, const SamplerSettings& cuts);
/// The settings of a quality; index into kQualities, or nothing if the settings are no preset's.
std::optional<std::size_t> qualityOf(const SamplerSettings& settings);

}  // namespace cellcut
