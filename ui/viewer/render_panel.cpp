#include "renderer/trace/light_mask.h"
#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace cellcut {
namespace {

void drawSamplerSettings(Widgets& widgets, const Trade* trade, ViewerState& state) {
  SamplerSettings& s = state.settings.sampler;
  std::array<std::string_view, kQualities.size() + 1> qualities;
  for (std::size_t i = 0; i < kQualities.size(); ++i) qualities[i] = kQualities[i].name;
  qualities.back() = "custom";
  int quality = static_cast<int>(qualityOf(s).value_or(kQualities.size()));
  if (widgets.choice("Quality", quality, qualities,
                     "Presets of the four settings below: what they trade is time per pass against noise per sample") &&
      quality < static_cast<int>(kQualities.size())) {
    useCuts(s, kQualities[static_cast<std::size_t>(quality)].settings);
  }
  widgets.slider("Max cut", s.maxCut, 2, kMaxCutSize,
                 "Most clusters of a cut. More: less noise, cells that take longer to make", true);
  drawCosts(trade, "Max cut");
  widgets.slider("Threshold", s.threshold, 0.0f, 0.1f,
                 "Clusters above this share of a cut's estimate are split. Lower: longer cuts, less noise", true);
  drawCosts(trade, "Threshold");
  if (state.settings.strategy == Strategy::kCellCut) {
    widgets.slider("Grid", s.gridResolution, 1, 256,
                   "Cells along the longest axis of what is seen. More: better estimates, more cells to make", true);
    drawCosts(trade, "Grid");
  }
  static constexpr std::array<std::string_view, 2> kInCluster{"intensity", "descent"};
  chooseEnum(
      widgets, "In cluster", s.inCluster, kInCluster,
      "How a light is chosen inside a cluster: by intensity (faster), or down the tree by importance (less noise)");
  drawCosts(trade, "In cluster");
}

template <class T>
void limitField(Widgets& widgets, const char* label, std::optional<T>& limit, const char* tooltip) {
  double value = limit ? static_cast<double>(*limit) : 0;
  if (!widgets.number(label, value, tooltip)) return;
  if constexpr (std::is_integral_v<T>)
    value = std::min(std::floor(value), 1e15);  // more than anyone waits for, and fits
  limit = value > 0 ? std::optional(static_cast<T>(value)) : std::nullopt;
}

/// A share of the work until the nearest limit, and how long it still takes.
std::string remaining(const ViewerState& state, const Snapshot& s) {
  if (!state.passLimit && !state.timeLimit && !state.noiseLimit) return "";
  if (s.passes == 0 || s.seconds <= 0) return "unknown yet";  // keeps its line: nothing moves with the first pass
  double least = std::numeric_limits<double>::infinity();
  const double perPass = s.seconds / static_cast<double>(s.passes);
  if (state.passLimit) {
    least = perPass * (static_cast<double>(*state.passLimit) - static_cast<double>(s.passes));
  }
  if (state.timeLimit) least = std::min(least, *state.timeLimit - s.seconds);
  if (state.noiseLimit && std::isfinite(s.noise.bound)) {
    const double ratio = s.noise.bound / *state.noiseLimit;
    least = std::min(least, s.seconds * (ratio * ratio - 1));
  }
  if (!std::isfinite(least)) return "unknown yet";
  return least <= 0 ? "done" : formatted("about %.0f s left", least);
}

}  // namespace

bool haveSameCuts(const SamplerSettings& a, const SamplerSettings& b) {
  return a.maxCut == b.maxCut && a.threshold == b.threshold && a.gridResolution == b.gridResolution &&
         a.inCluster == b.inCluster;
}

void useCuts(SamplerSettings& settings, const SamplerSettings& cuts) {
  settings.maxCut = cuts.maxCut;
  settings.threshold = cuts.threshold;
  settings.gridResolution = cuts.gridResolution;
  settings.inCluster = cuts.inCluster;
}

std::optional<std::size_t> qualityOf(const SamplerSettings& s) {
  const auto found =
      std::find_if(kQualities.begin(), kQualities.end(), [&](const Quality& q) { return haveSameCuts(q.settings, s); });
  if (found == kQualities.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kQualities.begin());
}

ViewerCommand drawRenderPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  ViewerCommand command = ViewerCommand::kNone;
  if (!widgets.section("Render")) return command;
  RenderSettings& s = state.settings;
  static constexpr auto kNames = namesOf(kStrategies);
  const std::string_view about = kStrategies[static_cast<std::size_t>(s.strategy)].description;
  chooseEnum(widgets, "Strategy", s.strategy, kNames, about.data());
  if (hasCuts(s.strategy)) drawSamplerSettings(widgets, facts.trade, state);
  widgets.slider("Max depth", s.maxDepth, 0, 32, "Times a path may scatter: 0 emitters only, 1 direct light only");
  if (s.shownLights) {
    const std::vector<bool>& shown = s.shownLights->shown();
    widgets.text("Lights", formatted("%zd of %zu", std::count(shown.begin(), shown.end(), true), shown.size()),
                 "Solo and mute of the inspector; what is seen of the others directly stays");
    if (widgets.button("All lights", "Show every light again (N)")) command = ViewerCommand::kAllLights;
  }
  widgets.whole("Seed", s.seed, "Another seed, another noise");
  limitField(widgets, "Stop at spp", state.passLimit, "Samples per pixel after which rendering rests");
  limitField(widgets, "Stop at s", state.timeLimit, "Seconds after which rendering rests");
  limitField(widgets, "Stop at REL", state.noiseLimit,
             "Relative error (root of relMSE) below which it rests: looked at after 16, 20, 25, 32, ... spp");
  widgets.checkbox("Pause", state.paused, "P");
  besideIfRoom("Step");
  if (widgets.button("Step", "One pass of a paused rendering (.)")) command = ViewerCommand::kSingleStep;
  const std::string rest = remaining(state, facts.snapshot);
  if (!rest.empty()) widgets.text("ETA", rest, "Until the nearest of the limits");
  return command;
}

}  // namespace cellcut
