#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

namespace cellcut {

void drawOverlayPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  if (!widgets.section("Overlay")) return;
  OverlayChoice& o = state.overlay;
  static constexpr auto kNames = namesOf(kOverlays);
  chooseEnum(widgets, "Show", o.overlay, kNames, describe(o.overlay).description.data());
  widgets.checkbox("Grid cells", o.grid,
                   "Wireframe of the cells that were touched, but for coarse ones of bounces among them (G)");
  if (facts.overlay && facts.overlay->touched) {
    const TouchedCells& t = *facts.overlay->touched;
    widgets.text("Cells touched",
                 formatted("%zu of %zu (%.1f %%), %zu beyond", t.inside, t.all, 100 * t.share(), t.outside + t.remote),
                 "Of the cells that cover what the pilot paths saw; beyond them also coarse ones");
  }
  if (state.settings.strategy == Strategy::kCellCut) {
    static constexpr std::array<std::string_view, 4> kAxes{"no slice", "across x", "across y", "across z"};
    chooseEnum(widgets, "Slice", o.slice.axis, kAxes,
               "A plane through the grid that shows cells in mid-air too (K); it is hidden by what stands before it");
    if (o.slice.axis != SliceAxis::kNone) {
      widgets.slider("Slice at", o.slice.position, 0, 1, "From one side of the grid to the other ([ and ])");
      if (facts.overlay && facts.overlay->slice) {
        widgets.text("Slice lies at", formatted("%c = %.3g m", "xyz"[static_cast<int>(o.slice.axis) - 1],
                                                static_cast<double>(*facts.overlay->slice)));
      }
    }
  }
  if (o.overlay == Overlay::kNone) return;
  static constexpr auto kMaps = namesOf(kColormaps);
  chooseEnum(widgets, "Colours", o.scale.colormap, kMaps, "Viridis and magma have even steps");
  static constexpr std::array<std::string_view, 2> kScales{"linear", "log"};
  chooseEnum(widgets, "Scale", o.scale.kind, kScales, "Linear or logarithmic");
  widgets.slider("Opacity", o.opacity, 0, 1, "Of the overlay");
  bool pinned = o.scale.pinned.has_value();
  if (widgets.checkbox("Pin range", pinned, "Keep the range that there is now") && facts.overlay) {
    o.scale.pinned.reset();
    if (pinned) o.scale.pinned = ColorScale(facts.overlay->values, scaleOf(o.overlay, o.scale)).range();
  }
  if (facts.overlay && facts.overlay->overlay == o.overlay && facts.overlay->statistics.count > 0) {
    const OverlayStatistics& s = facts.overlay->statistics;
    widgets.text("Range", shortNumber(s.minimum, 3) + " … " + shortNumber(s.maximum, 3));
    widgets.text("Mean", shortNumber(s.mean, 4));
  }
}

}  // namespace cellcut
