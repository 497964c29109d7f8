#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cellcut {
namespace {

/// "0.97 ±0.03"
std::string withInterval(const Estimate& e) {
  return shortNumber(e.value, 3) + " ±" + shortNumber(0.5 * (e.high - e.low), 2);
}

bool isKnown(const QualityTrial& trial) {
  return std::isfinite(trial.inefficiency.value);
}

/// The one setting that a trial varies, as its slider is called, and its value; nothing if it varies none or several.
std::optional<std::pair<std::string, std::string>> varied(const Trade& trade, const QualityTrial& trial) {
  const SamplerSettings &first = trade.trials[0].quality.settings, &s = trial.quality.settings;
  std::vector<std::pair<std::string, std::string>> all;
  if (s.maxCut != first.maxCut) all.emplace_back("Max cut", std::to_string(s.maxCut));
  if (s.threshold != first.threshold) all.emplace_back("Threshold", shortNumber(static_cast<double>(s.threshold), 2));
  if (s.gridResolution != first.gridResolution) all.emplace_back("Grid", std::to_string(s.gridResolution));
  if (s.inCluster != first.inCluster) all.emplace_back("In cluster", nameOf(s.inCluster));
  return all.size() == 1 ? std::optional(all[0]) : std::nullopt;
}

std::string nameOf(const Trade& trade, std::size_t i) {
  if (!trade.trials[i].quality.name.empty()) return std::string(trade.trials[i].quality.name);
  const auto setting = varied(trade, trade.trials[i]);
  return setting ? setting->first + " " + setting->second : "as it was";
}

void drawTable(Widgets& widgets, const Trade& trade, ViewerState& state) {
  if (!ImGui::BeginTable("trials", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
  for (const char* column : {"setting", "ms/pass", "noise", "cost"}) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < trade.trials.size(); ++i) {
    const QualityTrial& trial = trade.trials[i];
    const SamplerSettings& s = trial.quality.settings;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name = nameOf(trade, i);
    if (widgets.row(("Trial " + name).c_str(), name.c_str(), haveSameCuts(s, state.settings.sampler))) {
      useCuts(state.settings.sampler, s);
    }
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("cuts of %d, threshold %g, grid %d, by %s; %zu passes tried\nClick to use it", s.maxCut,
                        static_cast<double>(s.threshold), s.gridResolution, nameOf(s.inCluster).data(), trial.passes);
    }
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(isKnown(trial) ? shortNumber(1e3 * trial.passSeconds, 4).c_str() : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(isKnown(trial) ? shortNumber(std::sqrt(trial.relativeVariance), 3).c_str() : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(isKnown(trial) ? (i == 0 ? "1" : withInterval(trial.inefficiency).c_str()) : "-");
  }
  ImGui::EndTable();
}

}  // namespace

ViewerCommand drawTradePanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  if (!widgets.section("Trade", false)) return ViewerCommand::kNone;
  const Snapshot& s = facts.snapshot;
  std::string inefficiency = "after 16 spp";
  if (std::isfinite(s.noise.value)) {
    const auto cost = [&](double error) { return shortNumber(error * error * s.noiseSeconds, 3) + " s"; };
    inefficiency = cost(s.noise.value) + ", under " + cost(s.noise.bound);
  }
  widgets.text(
      "Inefficiency", inefficiency,
      "relMSE x seconds, as the samples tell: what a setting costs, however long it has rendered. Half of it is "
      "the same picture in half the time, and what else uses the cores counts. It is under the second number with 97 "
      "%");
  ViewerCommand command = ViewerCommand::kNone;
  if (facts.trying) {
    if (widgets.button("Stop trials", "Keep the settings (I)")) command = ViewerCommand::kFindBest;
    ImGui::TextWrapped("trying settings, about %.0f s …", kTradeLength * kTrialShare);
  } else if (!hasCuts(state.settings.strategy)) {
    ImGui::TextWrapped("This strategy has no cuts to set.");
  } else if (widgets.button("Find best",
                            "Try presets and neighbours of the settings on this view, and use what has the least "
                            "relMSE x seconds beyond doubt (I)")) {
    command = ViewerCommand::kFindBest;
  }
  if (!facts.trade) return command;
  widgets.text("Best", nameOf(*facts.trade, facts.trade->best),
               "The first of the table, unless another is better beyond its 95 % interval");
  drawTable(widgets, *facts.trade, state);
  ImGui::TextWrapped("noise: root of relMSE x spp; cost: relMSE x time over that of the first");
  return command;
}

void drawCosts(const Trade* trade, const char* setting) {
  if (!trade) return;
  std::string line;
  for (const QualityTrial& trial : trade->trials) {
    const auto other = varied(*trade, trial);
    if (!isKnown(trial) || !other || other->first != setting) continue;
    line += (line.empty() ? "cost at " : ", at ") + other->second + ": " + withInterval(trial.inefficiency);
  }
  if (line.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", line.c_str());
  ImGui::PopStyleColor();
}

}  // namespace cellcut
