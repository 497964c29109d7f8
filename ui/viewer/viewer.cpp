#include "ui/viewer/viewer.h"

#include "renderer/scene/camera.h"
#include "renderer/trace/light_mask.h"
#include "ui/gl_error.h"
#include "ui/viewer/is_ready.h"

#include <imgui.h>
#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

/// Panels' width in letters.
constexpr float kPanelLetters = 25;
/// Frames in a row that OpenGL may fail in before the viewer gives up: what is short of memory may get it, what is lost
/// for good never works again.
constexpr int kMostGlFailures = 40;

/// Of what can change while the viewer runs: `sampling`, `threads`, `niceness` and `auxiliary` are what it began with.
bool sameSettings(const RenderSettings& a, const RenderSettings& b) {
  const bool sameCamera =
      a.camera == b.camera && a.view.has_value() == b.view.has_value() && (!a.view || isSameView(*a.view, *b.view));
  return sameCamera && a.width == b.width && a.height == b.height && a.maxDepth == b.maxDepth &&
         a.strategy == b.strategy && a.seed == b.seed && a.sampler == b.sampler && a.shownLights == b.shownLights;
}

bool sameInput(const SessionInput& a, const SessionInput& b) {
  return a.scene == b.scene && sameSettings(a.settings, b.settings) && a.passLimit == b.passLimit &&
         a.timeLimit == b.timeLimit && a.noiseLimit == b.noiseLimit && a.paused == b.paused;
}

}  // namespace

Viewer::Viewer(Window& window, std::shared_ptr<const Scene> scene, SceneLoader loader, ViewerOptions options)
    : window_(window),
      scene_(std::move(scene)),
      loader_(std::move(loader)),
      options_(std::move(options)),
      state_(options_.state),
      pose_(poseOf(viewOf(*scene_, state_.settings), scene_->bounds)),
      gui_(window, {.scale = options_.uiScale * window.contentScale()}),
      recent_(options_.recentFiles),
      reference_{options_.reference, {}, 0},
      maker_([&window] { window.wake(); }),
      trials_([&window] { window.wake(); }),
      session_([&window] { window.wake(); }) {
  if (options_.record) recorder_ = std::make_unique<ScriptRecorder>(*options_.record);
  if (!options_.file.empty()) recent_.add(options_.file);
  snapshot_ = session_.snapshot();
  showWarnings();
}

Viewer::~Viewer() = default;

double Viewer::sleepSeconds() const {
  if (minimised_ || glFailures_ > 0) return 0.25;
  if (flying_ || pointing_ || gui_.inputPending()) return 0;
  return loading_.valid() || loadingReference_.valid() || saving_.valid() || overlays_.busy() || convergence_.busy() ||
                 secondConvergence_.busy()
             ? 0.02
             : 0.25;
}

bool Viewer::settled() const {
  return !edited_ && !loading_.valid() && !loadingReference_.valid() && !saving_.valid() && !overlays_.busy() &&
         !gui_.inputPending() && snapshot_->generation >= generation_ && (!overlayWanted() || overlayIsCurrent());
}

bool Viewer::hasNewsOfEdits() const {
  return snapshot_->generation < generation_ || isReady(loading_) || isReady(loadingReference_) || isReady(saving_) ||
         overlays_.ready();
}

bool Viewer::atRest() const {
  if (maker_.busy() || trials_.busy() || convergence_.busy() || secondConvergence_.busy()) return false;
  if (duel_ && !state_.paused) {
    if (!duel_->finished()) return false;
  } else if (!session_.atRest()) {
    return false;
  }
  if (session_.snapshot() != snapshot_) return false;  // it came after the last frame began
  // The last samples are measured too.
  const bool measured = !referenceFits() || snapshot_->preview || !snapshot_->error.empty() ||
                        convergence_.measured() >= snapshot_->passes;
  return settled() && measured;
}

bool Viewer::reachedLimit() const {
  const bool limited = applied_.passLimit || applied_.timeLimit || applied_.noiseLimit;
  return limited && !state_.paused && snapshot_->error.empty() && atRest();
}

void Viewer::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

void Viewer::takeNews() {
  for (const std::filesystem::path& file : window_.takeDroppedFiles()) {
    open(file);
    if (recorder_) recorder_->pictureChangesAfter({"drop", std::filesystem::absolute(file).string()});
  }
  if (panelsHeld_) return;
  takeScene();
  takeReference();
  if (isReady(saving_)) guarded([this] { notice_ = saving_.get(); });
  const std::shared_ptr<const Snapshot> newest = session_.snapshot();
  if (newest != snapshot_) {
    snapshot_ = newest;
    if (!snapshot_->error.empty()) problem_ = snapshot_->error;
    if (!snapshot_->radiance->empty()) view_.setImage(ImageSlot::kA, *snapshot_->radiance);
  }
  // What is new may move the panels: not while a person presses something there.
  if (ImGui::IsAnyItemActive()) return;
  takeTrade();
  std::optional<OverlayPicture> picture;
  guarded([&] {
    picture =
        OverlayPicture{.generation = snapshot_->generation};  // stands for one that failed: it is not asked for again
    picture = overlays_.take();
  });
  if (picture) {
    overlay_ = std::move(picture);
    overlayDrawn_ = false;
  }
}

void Viewer::frame(double seconds) {
  try {
    drawFrame(seconds);
    glFailures_ = 0;
  } catch (const GlError& error) {
    gui_.abandonFrame();
    // What the context held may be gone with it: all of it is made anew.
    framebuffer_.reset();
    snapshot_ = std::make_shared<const Snapshot>();
    overlayDrawn_ = false;
    problem_ = error.what();
    if (++glFailures_ >= kMostGlFailures) throw;
  }
}

void Viewer::drawFrame(double seconds) {
  const PixelSize size = window_.framebufferSize();
  for (const InputEvent& event : window_.takeEvents()) heldEvents_.push_back(event);
  minimised_ = size.empty();
  if (minimised_) return;  // a key that is released meanwhile is released when there is a window again
  window_.makeCurrent();
  const std::vector<InputEvent> events = std::exchange(heldEvents_, {});
  if (!framebuffer_ || framebuffer_->size() != size) framebuffer_ = std::make_unique<GlFramebuffer>(size);
  if (recorder_ && size != recordedSize_) {
    recorder_->pictureChangesAfter({"size", std::to_string(size.width), std::to_string(size.height)});
    recordedSize_ = size;
  }
  takeNews();

  gui_.beginFrame(size, seconds, events);
  shown_ = Widgets(std::exchange(reveal_, ""));
  const float panel =
      state_.showUi ? std::min(kPanelLetters * ImGui::GetFontSize(), 0.45f * static_cast<float>(size.width)) : 0;
  area_ = {{panel, 0}, {static_cast<float>(size.width) - panel, static_cast<float>(size.height)}};
  if (state_.showUi) drawPanels();
  if (state_.showHelp) drawHelp(state_.showHelp);
  recordKeys();
  run(readKeys(seconds));
  followSize();
  const PixelSize rendered{snapshot_->width, snapshot_->height};
  if (!rendered.empty()) placement_ = fitImage(rendered, area_);
  readMouse();
  recordFrame();
  pointAtCluster();
  applyEdits();
  if (duel_ && !state_.paused) duel_->drive(session_, generation_);
  measure();
  requestOverlay();
  showOverlay();
  drawOverPicture();

  framebuffer_->clear({0.09f, 0.09f, 0.1f, 1});
  if (!view_.imageSize().empty()) {
    ImageViewSettings display = state_.display;
    display.overlayOpacity = 1;  // is in the overlay's own alpha
    display.split = displaySplit();
    // A preview has fewer pixels than the rendering: it is stretched over the same area.
    ImagePlacement shown = placement_;
    shown.scale *= static_cast<float>(rendered.width) / static_cast<float>(view_.imageSize().width);
    view_.draw(size, area_, shown, display);
  }
  gui_.endFrame();
  window_.present(*framebuffer_);
}

void Viewer::drawPanels() {
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(area_.origin.x, area_.size.y));
  constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::Begin("panels", nullptr, kFixed);
  const MeasureFacts errors{.making = maker_.busy(),
                            .made = maker_.passes(),
                            .wanted = maker_.wanted(),
                            .reference = reference_,
                            .fits = referenceFits(),
                            .run = convergence_.run(),
                            .secondRun = duel_ ? &secondConvergence_.run() : nullptr,
                            .kept = keptRuns_};
  const ViewerFacts facts{*scene_,  *snapshot_,     overlay(),
                          stored_,  second_.get(),  recent_.list(),
                          errors,   trials_.busy(), trade_ && trade_->fits(applied_) ? &*trade_ : nullptr,
                          problem_, notice_};
  run(drawMessages(shown_, facts));
  if (loading_.valid()) ImGui::TextWrapped("loading %s …", loadingFile_.filename().string().c_str());
  run(drawInspectorPanel(shown_, facts, state_));
  run(drawRenderPanel(shown_, facts, state_));
  run(drawViewPanel(shown_, facts, state_));
  drawOverlayPanel(shown_, facts, state_);
  run(drawTradePanel(shown_, facts, state_));
  run(drawReferencePanel(shown_, facts, state_));
  drawDuelPanel(shown_, facts, state_);
  drawStatisticsPanel(shown_, facts);
  ImGui::End();
}

void Viewer::run(ViewerCommand command) {
  switch (command) {
    case ViewerCommand::kNone:
      return;
    case ViewerCommand::kStore:
      return guarded([this] { storePicture(); });
    case ViewerCommand::kForget:
      state_.duel = false;
      view_.clearImage(ImageSlot::kB);
      stored_ = false;
      return;
    case ViewerCommand::kSave:
      return guarded([this] { save(); });
    case ViewerCommand::kReload:
      return open(options_.file);
    case ViewerCommand::kResetCamera:
      state_.settings.view.reset();
      pose_ = poseOf(scene_->cameras[state_.settings.camera], scene_->bounds);
      return;
    case ViewerCommand::kCopyCamera:
      return window_.setClipboard(poseToJson(pose()));
    case ViewerCommand::kPasteCamera:
      return guarded([this] {
        setPose(poseFromJson(window_.clipboard(), scene_->bounds));
        if (recorder_) recorder_->view(pose());
      });
    case ViewerCommand::kSingleStep:
      return session_.singleStep();
    case ViewerCommand::kDismiss:
      problem_.clear();
      return notice_.clear();
    case ViewerCommand::kUnpick:
      return state_.pick.reset();
    case ViewerCommand::kSolo:
    case ViewerCommand::kMute:
      return showLights(command == ViewerCommand::kSolo);
    case ViewerCommand::kAllLights:
      return state_.settings.shownLights.reset();
    case ViewerCommand::kKeepView:
      return keepView();
    case ViewerCommand::kRecallView:
      return recallView();
    case ViewerCommand::kOpenRecent:
      return openRecent();
    case ViewerCommand::kReference:
      return toggleReference();
    case ViewerCommand::kKeepRun:
      if (!convergence_.run().points.empty()) keptRuns_.push_back(convergence_.run());
      return;
    case ViewerCommand::kClearRuns:
      return keptRuns_.clear();
    case ViewerCommand::kSaveCsv:
      return guarded([this] { saveCsv(); });
    case ViewerCommand::kFindBest:
      return toggleTrials();
    case ViewerCommand::kExportCut:
      if (overlay_ && overlay_->inspection) window_.setClipboard(toJson(*overlay_->inspection).dump(2));
      return;
  }
}

void Viewer::showLights(bool solo) {
  const std::optional<std::size_t> row = state_.selectedCluster ? state_.selectedCluster : pointedBefore_;
  if (!row || !state_.pick || !overlayIsOfScene() || !overlay_->inspection ||
      *row >= overlay_->inspection->clusters.size())
    return;
  std::span<const LightId> lights = overlay_->inspection->clusters[*row].lights;
  if (row == state_.selectedCluster && state_.selectedLight > 0) {
    lights = lights.subspan(static_cast<std::size_t>(state_.selectedLight) - 1, 1);
  }
  std::vector<bool> shown(overlay_->lightCount, !solo);
  // Muting goes on from what is shown; solo begins anew.
  if (!solo && state_.settings.shownLights) shown = state_.settings.shownLights->shown();
  shown.resize(overlay_->lightCount, true);
  for (const LightId light : lights) shown[static_cast<std::size_t>(light)] = solo;
  state_.settings.shownLights = std::make_shared<const LightMask>(std::move(shown));
}

void Viewer::storePicture() {
  if (snapshot_->radiance->empty()) return;
  view_.setImage(ImageSlot::kB, *snapshot_->radiance);
  if (!stored_) state_.display.split = 0.5f;
  stored_ = true;
}

void Viewer::followSize() {
  const PixelSize now{std::max(1, static_cast<int>(area_.size.x)), std::max(1, static_cast<int>(area_.size.y))};
  sizeAge_ = now == wantedSize_ ? sizeAge_ + 1 : 0;
  wantedSize_ = now;
  const bool first = generation_ == 0;
  if (!first && options_.sizeSettleFrames && sizeAge_ < *options_.sizeSettleFrames) return;
  state_.settings.width = now.width;
  state_.settings.height = now.height;
}

void Viewer::applyEdits() {
  SessionInput input;
  input.scene = scene_;
  input.settings = state_.settings;
  input.settings.sampler.countVisits = state_.overlay.overlay == Overlay::kVisits;
  input.passLimit = state_.passLimit;
  input.timeLimit = state_.timeLimit;
  input.noiseLimit = state_.noiseLimit;
  input.paused = state_.paused;
  input.noise = true;
  edited_ = false;
  const bool newScene = applied_.scene != input.scene;
  const bool otherDuel = state_.duel != (duel_ != nullptr) || (state_.duel && state_.opponent != opponent_);
  if (sameInput(input, applied_) && !otherDuel) return;
  const RenderSettings& before = applied_.settings;
  if (applied_.scene && (input.settings.width != before.width || input.settings.height != before.height)) {
    state_.pick.reset();  // that pixel shows something else now
  }
  if (!applied_.scene || newScene || !sameSettings(before, input.settings) || otherDuel) {
    convergence_.restart(std::string(nameOf(input.settings.strategy)));
    secondConvergence_.restart(std::string(nameOf(state_.opponent)));
  }
  applied_ = input;
  opponent_ = state_.opponent;
  if (!state_.duel) endDuel();
  if (state_.duel) {
    if (!duel_) duel_ = std::make_unique<Duel>([&window = window_] { window.wake(); });
    input = duel_->edit(input, state_.opponent);
  }
  generation_ = session_.edit(std::move(input));
  if (newScene) sceneGeneration_ = generation_;
}

}  // namespace cellcut
