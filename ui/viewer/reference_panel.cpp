#include "ui/viewer/log_plot.h"
#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

#include <cmath>

namespace cellcut {
namespace {

double errorOf(const ConvergencePoint& p, ErrorMetric metric) {
  return metric == ErrorMetric::kMse ? p.mse : metric == ErrorMetric::kRelMse ? p.relmse : p.flip;
}

PlotCurve curveOf(const ConvergenceRun& run, const PlotChoice& choice) {
  PlotCurve curve{run.name, {}};
  for (const ConvergencePoint& p : run.points) {
    curve.points.emplace_back(choice.overPasses ? static_cast<double>(p.passes) : p.seconds, errorOf(p, choice.metric));
  }
  return curve;
}

void drawNumbers(Widgets& widgets, const ConvergenceRun& run) {
  if (run.points.empty()) {
    ImGui::TextUnformatted("measuring …");
    return;
  }
  const ConvergencePoint& newest = run.points.back();
  widgets.text("MSE", shortNumber(newest.mse, 4), "Mean of (picture − reference)²");
  widgets.text("relMSE", shortNumber(newest.relmse, 4), "Mean of (picture − reference)² / (reference² + ε)");
  for (auto p = run.points.rbegin(); p != run.points.rend(); ++p) {
    if (std::isnan(p->flip)) continue;
    widgets.text("FLIP", shortNumber(p->flip, 4) + " at " + std::to_string(p->passes) + " spp",
                 "Mean HDR-FLIP: the difference that a person sees, 0 to 1");
    break;
  }
}

ViewerCommand drawPlot(Widgets& widgets, const MeasureFacts& m, ViewerState& state) {
  static constexpr std::array<std::string_view, 3> kMetrics{"MSE", "relMSE", "HDR-FLIP"};
  chooseEnum(widgets, "Error", state.plot.metric, kMetrics, "What is plotted");
  int axis = state.plot.overPasses;
  static constexpr std::array<std::string_view, 2> kAxes{"seconds", "samples"};
  if (widgets.choice("Over", axis, kAxes, "Seconds of rendering, or samples per pixel"))
    state.plot.overPasses = axis == 1;
  std::vector<PlotCurve> curves{curveOf(m.run, state.plot)};
  if (m.secondRun) curves.push_back(curveOf(*m.secondRun, state.plot));
  for (const ConvergenceRun& run : m.kept) curves.push_back(curveOf(run, state.plot));
  drawLogPlot(curves, kAxes[state.plot.overPasses].data(),
              kMetrics[static_cast<std::size_t>(state.plot.metric)].data());
  ViewerCommand command = ViewerCommand::kNone;
  if (widgets.button("Keep run", "Keep this curve to compare with others (Y)")) command = ViewerCommand::kKeepRun;
  if (!m.kept.empty()) {
    besideIfRoom("Clear runs");
    if (widgets.button("Clear runs", "Forget the curves that were kept")) command = ViewerCommand::kClearRuns;
  }
  besideIfRoom("Save CSV");
  if (widgets.button("Save CSV", "All curves as numbers (Ctrl+E)")) command = ViewerCommand::kSaveCsv;
  return command;
}

}  // namespace

ViewerCommand drawReferencePanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  ViewerCommand command = ViewerCommand::kNone;
  if (!widgets.section("Reference", false)) return command;
  const MeasureFacts& m = facts.measure;
  widgets.slider("Reference spp", state.referencePasses, 16, 65536, "Samples per pixel of a reference made here", true);
  if (m.making) {
    widgets.text("Making", formatted("%llu of %llu spp", static_cast<unsigned long long>(m.made),
                                     static_cast<unsigned long long>(m.wanted)));
    if (widgets.button("Use it now", "Take the reference as far as it is (J)")) command = ViewerCommand::kReference;
  } else if (widgets.button("Make reference", "Render one of this view beside the picture (J)")) {
    command = ViewerCommand::kReference;
  }
  if (!m.reference.picture) {
    ImGui::TextWrapped("No reference: make one, drop an EXR, or start with --reference.");
    return command;
  }
  widgets.text("Compared with",
               m.reference.passes > 0 ? std::to_string(m.reference.passes) + " spp made here" : std::string("a file"));
  if (!m.fits) {
    ImGui::TextWrapped("It shows another view, size, depth or lights; it has %d x %d pixels.",
                       m.reference.picture->width(), m.reference.picture->height());
    return command;
  }
  drawNumbers(widgets, m.run);
  const ViewerCommand plot = drawPlot(widgets, m, state);
  return plot == ViewerCommand::kNone ? command : plot;
}

}  // namespace cellcut
