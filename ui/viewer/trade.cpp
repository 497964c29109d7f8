#include "ui/viewer/trade.h"

#include "ui/viewer/is_ready.h"

#include <algorithm>

namespace cellcut {
namespace {

/// As that of a session's workers: the picture goes on and the UI wakes at once.
constexpr int kTrialNiceness = 19;

Trade tryOut(const SessionInput& input, const std::atomic<bool>& cancel) {
  const std::vector<Quality> candidates = tradeCandidates(input.settings);
  RenderSettings settings = input.settings;
  settings.sampler = candidates[0].settings;
  settings.niceness = kTrialNiceness;
  Renderer renderer(*input.scene, settings);
  const QualityChoice choice = chooseQuality(renderer, candidates, {.seconds = kTradeLength}, cancel);
  return {input, choice.trials, bestTrial(choice.trials)};
}

}  // namespace

bool Trade::fits(const SessionInput& rendered) const {
  return input.scene == rendered.scene && input.settings.strategy == rendered.settings.strategy &&
         input.settings.maxDepth == rendered.settings.maxDepth &&
         input.settings.shownLights == rendered.settings.shownLights;
}

std::vector<Quality> tradeCandidates(const RenderSettings& settings) {
  SamplerSettings now = settings.sampler;
  now.countVisits = false;
  std::vector<Quality> candidates{{"", "", now}};
  const auto add = [&](const Quality& candidate) {
    const auto isSame = [&](const Quality& other) { return other.settings == candidate.settings; };
    const auto same = std::find_if(candidates.begin(), candidates.end(), isSame);
    if (same == candidates.end())
      candidates.push_back(candidate);
    else if (same->name.empty())
      *same = candidate;
  };
  for (Quality preset : kQualities) {
    preset.settings.cellMemory = now.cellMemory;
    add(preset);
  }
  const auto vary = [&](auto SamplerSettings::*setting, auto value) {
    Quality other{"", "", now};
    other.settings.*setting = value;
    add(other);
  };
  vary(&SamplerSettings::maxCut, std::max(2, now.maxCut / 4));
  vary(&SamplerSettings::maxCut, std::min(kMaxCutSize, now.maxCut * 4));
  vary(&SamplerSettings::threshold, now.threshold / 4);
  vary(&SamplerSettings::threshold, std::min(1.0f, now.threshold * 4));
  if (settings.strategy == Strategy::kCellCut) {
    vary(&SamplerSettings::gridResolution, std::max(1, now.gridResolution / 2));
    vary(&SamplerSettings::gridResolution, std::min(kMaxGridResolution, now.gridResolution * 2));
  }
  vary(&SamplerSettings::inCluster, now.inCluster == InCluster::kDescent ? InCluster::kIntensity : InCluster::kDescent);
  return candidates;
}

void TradeTrials::start(const SessionInput& input) {
  stop();
  cancel_ = std::make_shared<std::atomic<bool>>(false);
  made_ = std::async(std::launch::async, [input, cancel = cancel_, wake = wake_] {
    Trade trade = tryOut(input, *cancel);
    wake();
    return trade;
  });
}

void TradeTrials::stop() {
  if (!made_.valid()) return;
  *cancel_ = true;
  ending_.push_back(std::move(made_));
}

std::optional<Trade> TradeTrials::take() {
  std::erase_if(ending_, [](const auto& ending) { return isReady(ending); });
  if (!isReady(made_)) return std::nullopt;
  try {
    return made_.get();
  } catch (const std::exception& error) {
    problem_ = error.what();
    return std::nullopt;
  }
}

}  // namespace cellcut
