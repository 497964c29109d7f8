#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

namespace cellcut {

void drawDuelPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  if (!widgets.section("Duel", false)) return;
  static constexpr auto kNames = namesOf(kStrategies);
  chooseEnum(widgets, "Opponent", state.opponent, kNames, "Rendered right of the split, with the same settings");
  widgets.checkbox(
      "Duel in equal time", state.duel,
      "Both strategies in turns of equal seconds (U); limits on spp and REL rest, the one on s counts for each");
  if (!state.duel || !facts.second) return;
  const Snapshot &a = facts.snapshot, &b = *facts.second;
  const auto progress = [](const Snapshot& s) {
    return s.preview ? std::string("…")
                     : formatted("%.1f s, %llu spp", s.seconds, static_cast<unsigned long long>(s.passes));
  };
  widgets.text("Left", progress(a));
  widgets.text("Right", progress(b));
  const MeasureFacts& m = facts.measure;
  const auto ratio = m.secondRun ? efficiencyRatio(m.run, *m.secondRun) : std::nullopt;
  if (ratio) {
    widgets.text("Ratio", formatted("%.3g", *ratio),
                 "relMSE x time, left over right, against the reference: below 1 the left one is better");
  } else {
    ImGui::TextWrapped("%s", m.reference.picture && m.fits ? "measuring …" : "The ratio needs a reference (J).");
  }
}

}  // namespace cellcut
