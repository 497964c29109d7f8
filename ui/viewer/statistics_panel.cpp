#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

namespace cellcut {

void drawStatisticsPanel(Widgets& widgets, const ViewerFacts& facts) {
  if (!widgets.section("Statistics")) return;
  const Snapshot& s = facts.snapshot;
  widgets.text("Samples", formatted("%llu spp in %.1f s", static_cast<unsigned long long>(s.passes), s.seconds));
  const double rays = static_cast<double>(s.rays.camera + s.rays.bounce + s.rays.shadow);
  if (s.seconds > 0) widgets.text("Speed", formatted("%.2f Mray/s", rays / s.seconds * 1e-6));
  if (std::isfinite(s.noise.bound)) {
    widgets.text("Relative error", formatted("%.4f", s.noise.bound),
                 "The root of relMSE is below it with 97 %, as far as the samples tell: looked at after 16, 20, 25, "
                 "32, ... spp");
  }
  widgets.text("Picture", formatted("%d x %d%s", s.width, s.height, s.preview ? ", preview" : ""));
  if (s.sampler.cut && s.sampler.grid && s.sampler.grid->made() > 0) {
    widgets.text("Cells made", formatted("%zu fine, %zu coarse", s.sampler.grid->fine, s.sampler.grid->coarse),
                 "Coarse cells are those of light's bounces and of what is far from the view");
    widgets.text("Cut size", formatted("%zu … %.0f … %zu", s.sampler.cut->min, s.sampler.cut->mean, s.sampler.cut->max),
                 "Least, mean and most clusters of the fine cells");
    widgets.text("Cells' memory", formatted("%.1f MB", static_cast<double>(s.sampler.cut->bytes) * 1e-6));
  }
  if (s.sampler.tree) {
    widgets.text("Light tree", formatted("%zu nodes, depth %d", s.sampler.tree->nodes, s.sampler.tree->depth));
  }
  if (s.bad.nan + s.bad.inf > 0) {
    widgets.text("Bad samples", formatted("%llu NaN, %llu infinite", static_cast<unsigned long long>(s.bad.nan),
                                          static_cast<unsigned long long>(s.bad.inf)));
  }
}

}  // namespace cellcut
