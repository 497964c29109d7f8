/// What lies over the picture: overlay, legend, boxes of clusters, marks.
#include "ui/overlays/cluster_pick.h"
#include "ui/viewer/viewer.h"

#include <imgui.h>

namespace cellcut {
namespace {

/// Radius around a point light that counts as its box, pixels at scale 1.
constexpr float kPointSlack = 6;

bool sameOverlay(const ViewerState& a, const ViewerState& b) {
  return a.overlay.overlay == b.overlay.overlay && a.overlay.grid == b.overlay.grid &&
         a.overlay.slice == b.overlay.slice && a.pick == b.pick;
}

}  // namespace

float Viewer::displaySplit() const {
  if (!stored_) return 1;
  return flip_ ? 0 : state_.display.split;
}

bool Viewer::overlayWanted() const {
  return state_.overlay.overlay != Overlay::kNone || state_.overlay.grid || state_.pick ||
         state_.overlay.slice.axis != SliceAxis::kNone;
}

bool Viewer::overlayIsCurrent() const {
  // Anew when something else is asked for, and whenever the number of samples has grown by a tenth.
  return overlay_ && overlay_->generation == snapshot_->generation && sameOverlay(overlayState_, state_) &&
         10 * snapshot_->passes <= 11 * overlayPasses_;
}

void Viewer::requestOverlay() {
  if (!overlayWanted()) {
    overlay_.reset();
    return;
  }
  if (overlays_.busy() || snapshot_->generation < generation_ || overlayIsCurrent()) return;
  overlayState_ = state_;
  overlayPasses_ = snapshot_->passes;
  overlays_.request(session_, state_.overlay, state_.pick, reference_.picture);
}

void Viewer::refreshOverlay() {
  overlays_.wait();
  overlays_.take();
  overlayState_ = state_;
  overlayPasses_ = session_.snapshot()->passes;
  overlays_.request(session_, state_.overlay, state_.pick, reference_.picture);
  overlays_.wait();
}

void Viewer::showOverlay() {
  const bool sameColours =
      overlayState_.overlay.opacity == state_.overlay.opacity && overlayState_.overlay.scale == state_.overlay.scale;
  if (!overlay_) {
    view_.clearOverlay();
    return;
  }
  if (overlayDrawn_ && sameColours) return;
  overlayState_.overlay.opacity = state_.overlay.opacity;
  overlayState_.overlay.scale = state_.overlay.scale;
  overlayDrawn_ = true;
  ImageRgba8 shown;
  if (!overlay_->values.empty()) {
    shown = colorize(overlay_->values, ColorScale(overlay_->values, scaleOf(overlay_->overlay, state_.overlay.scale)),
                     state_.overlay.opacity);
  }
  if (shown.empty()) {
    shown = overlay_->lines;
  } else if (!overlay_->lines.empty()) {
    for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = over(shown[i], overlay_->lines[i]);
  }
  if (shown.empty()) {
    view_.clearOverlay();
  } else {
    view_.setOverlay(shown);
  }
}

void Viewer::drawOverPicture() {
  if (displaySplit() == 0) return;  // all of it is of the first picture
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  if (overlay_ && overlay_->overlay != Overlay::kNone && !overlay_->values.empty()) {
    drawLegend(*overlay_, state_.overlay, area_, gui_.scale());
  }
  if (state_.selectedCluster && state_.pick) drawCluster(*state_.selectedCluster, IM_COL32(255, 160, 60, 255));
  if (state_.hoveredCluster && state_.pick) drawCluster(*state_.hoveredCluster, IM_COL32(255, 255, 255, 230));
  if (state_.pick) {
    const Vec2 at = placement_.toFramebuffer(Vec2(*state_.pick) + 0.5f);
    const float r = 6 * gui_.scale();
    list->AddCircle(ImVec2(at.x, at.y), r, IM_COL32_BLACK, 0, 3);
    list->AddCircle(ImVec2(at.x, at.y), r, IM_COL32_WHITE, 0, 1.5f);
  }
  if (stored_) {
    const float x = placement_.origin.x + placement_.scale * static_cast<float>(snapshot_->width) * displaySplit();
    const float height = placement_.scale * static_cast<float>(snapshot_->height);
    list->AddLine(ImVec2(x, placement_.origin.y), ImVec2(x, placement_.origin.y + height),
                  IM_COL32(255, 255, 255, 160));
  }
}

std::optional<Vec2> Viewer::whereSeen(const Vec3& p) const {
  const std::optional<Vec2> film =
      projectToFilm(viewOf(*scene_, state_.settings), p, {snapshot_->width, snapshot_->height});
  if (!film) return std::nullopt;
  return placement_.toFramebuffer(*film);
}

void Viewer::drawCluster(std::size_t row, unsigned color) const {
  if (!overlay_ || !overlay_->inspection || row >= overlay_->inspection->clusters.size()) return;
  const Bounds& box = overlay_->inspection->clusters[row].cluster.box;
  if (box.empty()) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  if (box.lower == box.upper) {
    if (const auto at = whereSeen(box.lower)) {
      list->AddCircle(ImVec2(at->x, at->y), kPointSlack * gui_.scale(), color, 0, 2 * gui_.scale());
    }
    return;
  }
  for (unsigned c = 0; c < 8; ++c) {
    for (const unsigned axis : {1u, 2u, 4u}) {
      if (c & axis) continue;
      const std::optional<Vec2> a = whereSeen(box.corner(c)), b = whereSeen(box.corner(c | axis));
      if (a && b) list->AddLine(ImVec2(a->x, a->y), ImVec2(b->x, b->y), color, 2 * gui_.scale());
    }
  }
}

void Viewer::pointAtCluster() {
  if (!overlay_ || !overlay_->inspection || !state_.pick) return;
  const Vec2 position(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
  if (!state_.hoveredCluster && !gui_.wantsMouse() && area_.contains(position)) {
    state_.hoveredCluster = clusterAt(
        overlay_->inspection->clusters, [this](const Vec3& p) { return whereSeen(p); }, position,
        kPointSlack * gui_.scale());
  }
  pointing_ = state_.hoveredCluster != pointedBefore_;
  pointedBefore_ = state_.hoveredCluster;
}

}  // namespace cellcut
