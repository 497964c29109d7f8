/// What a person's keys and mouse do to the picture, and how it is written down.
#include "renderer/base/exact_number.h"
#include "renderer/scene/camera.h"
#include "ui/viewer/viewer.h"

#include <array>

#include <imgui.h>

namespace cellcut {
namespace {

/// Pixels that a pointer may move between press and release of a click.
constexpr float kClickSlack = 3;
/// Radians per framebuffer height that a drag turns the camera.
constexpr float kTurnPerHeight = 3;
/// Shares of the focus distance that flying covers in a second.
constexpr float kFlySpeed = 0.7f;

Vec2 mousePosition() {
  return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
}

/// Share of the grid that [ and ] move the slice by: less than a layer of the default 16 cells.
constexpr float kSliceStep = 0.05f;

/// Space flies too.
constexpr std::string_view kFlightKeys = "WASDQEC";

bool isFunctionKey(Key key) {
  return key >= Key::kF1 && key <= Key::kF12;
}
Key digit(std::size_t i) {
  return static_cast<Key>(static_cast<std::size_t>(Key::k1) + i);
}
bool isModifier(Key key) {
  return key >= Key::kLeftShift;
}

}  // namespace

ViewerCommand Viewer::readKeys(double seconds) {
  flip_ = false;
  flying_ = false;
  if (gui_.keyPressed(Key::kF1)) state_.showHelp = !state_.showHelp;
  if (gui_.keyPressed(Key::kF2)) state_.showUi = !state_.showUi;
  if (gui_.keyPressed(Key::kF5)) return ViewerCommand::kReload;
  if (gui_.keyPressed(Key::kF12)) return ViewerCommand::kSave;
  if (gui_.wantsKeyboard()) return ViewerCommand::kNone;
  if (gui_.controlDown()) return readControlKeys();
  fly(seconds);
  flip_ = gui_.keyDown(Key::kB);
  for (std::size_t i = 0; gui_.shiftDown() && i < kBookmarks; ++i) {
    if (!gui_.keyPressed(digit(i))) continue;
    state_.chosen = i;
    return ViewerCommand::kRecallView;
  }
  for (std::size_t i = 0; i < kStrategies.size(); ++i) {
    if (gui_.keyPressed(digit(i))) state_.settings.strategy = kStrategies[i].strategy;
  }
  if (gui_.keyPressed(Key::kO)) {
    const auto count = static_cast<int>(kOverlays.size());
    const int step = gui_.shiftDown() ? count - 1 : 1;
    state_.overlay.overlay = static_cast<Overlay>((static_cast<int>(state_.overlay.overlay) + step) % count);
  }
  if (gui_.keyPressed(Key::kG)) state_.overlay.grid = !state_.overlay.grid;
  if (gui_.keyPressed(Key::kK)) {
    state_.overlay.slice.axis = static_cast<SliceAxis>((static_cast<int>(state_.overlay.slice.axis) + 1) % 4);
  }
  const float step = static_cast<float>(gui_.keyPressed(Key::kRightBracket, true)) -
                     static_cast<float>(gui_.keyPressed(Key::kLeftBracket, true));
  if (step != 0)
    state_.overlay.slice.position = std::clamp(state_.overlay.slice.position + kSliceStep * step, 0.0f, 1.0f);
  if (gui_.keyPressed(Key::kX) && pointedBefore_) {
    state_.selectedCluster = pointedBefore_;
    state_.selectedLight = 0;
  }
  if (gui_.keyPressed(Key::kU)) state_.duel = !state_.duel;
  if (gui_.keyPressed(Key::kJ)) return ViewerCommand::kReference;
  if (gui_.keyPressed(Key::kI)) return ViewerCommand::kFindBest;
  if (gui_.keyPressed(Key::kY)) return ViewerCommand::kKeepRun;
  if (gui_.keyPressed(Key::kL)) return ViewerCommand::kSolo;
  if (gui_.keyPressed(Key::kM)) return ViewerCommand::kMute;
  if (gui_.keyPressed(Key::kN)) return ViewerCommand::kAllLights;
  if (gui_.keyPressed(Key::kP)) state_.paused = !state_.paused;
  if (gui_.keyPressed(Key::kEqual, true) || gui_.keyPressed(Key::kKeypadAdd, true)) state_.display.exposure += 0.25f;
  if (gui_.keyPressed(Key::kMinus, true) || gui_.keyPressed(Key::kKeypadSubtract, true))
    state_.display.exposure -= 0.25f;
  if (gui_.keyPressed(Key::kEscape)) return ViewerCommand::kUnpick;
  if (gui_.keyPressed(Key::kPeriod)) return ViewerCommand::kSingleStep;
  if (gui_.keyPressed(Key::kT)) return ViewerCommand::kStore;
  if (gui_.keyPressed(Key::kF)) focusAt(mousePosition());
  return gui_.keyPressed(Key::kR) ? ViewerCommand::kResetCamera : ViewerCommand::kNone;
}

ViewerCommand Viewer::readControlKeys() {
  for (std::size_t i = 0; i < kBookmarks; ++i) {
    if (!gui_.keyPressed(digit(i))) continue;
    state_.chosen = i;
    return ViewerCommand::kKeepView;
  }
  if (gui_.keyPressed(Key::kO)) {
    // The first that is not the one that is shown.
    std::error_code ignored;
    const std::filesystem::path shown = std::filesystem::absolute(options_.file, ignored).lexically_normal();
    const auto& list = recent_.list();
    const auto other = std::find_if(list.begin(), list.end(), [&](const auto& file) { return file != shown; });
    state_.chosen = static_cast<std::size_t>(other - list.begin());
    return ViewerCommand::kOpenRecent;
  }
  if (gui_.keyPressed(Key::kE)) return ViewerCommand::kSaveCsv;
  if (gui_.keyPressed(Key::kC)) return ViewerCommand::kCopyCamera;
  return gui_.keyPressed(Key::kV) ? ViewerCommand::kPasteCamera : ViewerCommand::kNone;
}

CameraPose Viewer::pose() const {
  return {viewOf(*scene_, state_.settings), pose_.focus};
}

void Viewer::setPose(const CameraPose& pose) {
  if (!isUsable(pose)) return;  // the wheel turned until the numbers ended: the camera stays
  pose_ = pose;
  state_.settings.view = pose.camera;
}

void Viewer::fly(double seconds) {
  const auto axis = [&](Key plus, Key minus) {
    return static_cast<float>(gui_.keyDown(plus)) - static_cast<float>(gui_.keyDown(minus));
  };
  const Vec3 along(axis(Key::kD, Key::kA), axis(Key::kE, Key::kQ) + axis(Key::kSpace, Key::kC), axis(Key::kW, Key::kS));
  if (along == Vec3(0)) return;
  flying_ = true;
  const float speed = kFlySpeed * pose_.focus * (gui_.shiftDown() ? 10.0f : 1.0f);
  // A long frame is no reason to leave the building.
  setPose(flown(pose(), along * speed * static_cast<float>(std::min(seconds, 0.1))));
}

void Viewer::record(std::vector<std::string> words) {
  if (recorder_) recorder_->write(std::move(words));
}

void Viewer::recordKeys() {
  if (!recorder_) return;
  for (int i = 0; i < kKeyCount; ++i) {
    const auto key = static_cast<Key>(i);
    if (!gui_.keyPressed(key) || (gui_.wantsKeyboard() && !isFunctionKey(key)) || isModifier(key)) continue;
    const bool control = gui_.controlDown();
    if (!control && kFlightKeys.find(keyName(key)) != std::string_view::npos && keyName(key).size() == 1) continue;
    // view() says what came of them.
    if (key == Key::kSpace || (control && key == Key::kV) || (!control && key == Key::kF)) continue;
    if (key == Key::kX && !control) {  // means what is under the pointer
      recorder_->beforePosition(!state_.paused);
      record({"move", exactNumber(mousePosition().x), exactNumber(mousePosition().y)});
    }
    const std::string name = (control ? "Ctrl+" : "") + std::string(gui_.shiftDown() ? "Shift+" : "");
    record({"key", name + std::string(keyName(key))});
    if (key == Key::kF5) recorder_->pictureChanges();
  }
}

void Viewer::endRecording() {
  if (!recorder_) return;
  const std::unique_ptr<ScriptRecorder> ended = std::move(recorder_);
  ended->finish();
}

void Viewer::recordFrame() {
  if (!recorder_) return;
  recorder_->edits(shown_.edits());
  const bool landed = wasFlying_ && !flying_;
  if (landed) recorder_->view(pose());
  wasFlying_ = flying_;
  if (std::string problem = recorder_->takeProblem(); !problem.empty()) problem_ = std::move(problem);
}

void Viewer::readMouse() {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 position = mousePosition();
  const bool free = !gui_.wantsMouse() && area_.contains(position);
  if (free && io.MouseWheel != 0) {
    setPose(dollied(pose(), io.MouseWheel));
    record({"scroll", exactNumber(position.x), exactNumber(position.y), exactNumber(io.MouseWheel)});
  }
  for (int button = 0; button < kMouseButtonCount; ++button) {
    Drag& drag = drags_[button];
    if (ImGui::IsMouseClicked(button)) drag = {free, false, position, position};
    if (!drag.active) continue;
    if (glm::length(position - drag.start) > kClickSlack) drag.moved = true;
    // From where it began, so that a drag turns as far however many events it came in.
    const Vec2 share = (position - drag.last) / area_.size.y;
    if (drag.moved && share != Vec2(0)) {
      drag.last = position;
      if (button == ImGuiMouseButton_Left) setPose(orbited(pose(), kTurnPerHeight * share));
      if (button == ImGuiMouseButton_Right) setPose(turned(pose(), kTurnPerHeight * share));
      if (button == ImGuiMouseButton_Middle) setPose(panned(pose(), share));
    }
    if (ImGui::IsMouseDown(button)) continue;
    if (drag.moved) {
      record({"drag", std::string(kMouseButtonNames[static_cast<std::size_t>(button)]), exactNumber(drag.start.x),
              exactNumber(drag.start.y), exactNumber(position.x), exactNumber(position.y)});
    } else if (button == ImGuiMouseButton_Left) {
      const std::optional<glm::ivec2> pixel = imagePixelAt(placement_, {snapshot_->width, snapshot_->height}, position);
      if (pixel) {
        if (state_.pick != pixel) state_.selectedCluster.reset();
        state_.pick = pixel;
        if (recorder_) recorder_->beforePosition(!state_.paused);
        record({"pick", std::to_string(pixel->x), std::to_string(pixel->y)});
      }
    }
    drag.active = false;
  }
}

void Viewer::focusAt(const Vec2& position) {
  const PixelSize rendered{snapshot_->width, snapshot_->height};
  if (rendered.empty()) return;
  const auto pixel = imagePixelAt(fitImage(rendered, area_), rendered, position);
  const std::shared_ptr<const PreparedScene> prepared = snapshot_->prepared.lock();
  if (!pixel || !prepared || &prepared->scene != scene_.get()) return;
  const Ray ray = cameraRay(viewOf(*scene_, state_.settings), Vec2(*pixel) + 0.5f, {rendered.width, rendered.height});
  const auto hit = prepared->accel.intersect(ray, 0);
  if (!hit) return;
  pose_.focus = hit->t;
  if (recorder_) recorder_->view(pose());
}

}  // namespace cellcut
