#include "app/measure/plan.h"

#include <algorithm>
#include <cassert>

namespace cellcut {
namespace {

std::string fileSafe(std::string text) {
  const auto isSafe = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  std::replace_if(
      text.begin(), text.end(), [&](char c) { return !isSafe(c); }, '_');
  return text.empty() ? "scene" : text;
}

std::vector<int> depthsOf(const MeasureOptions& options) {
  std::vector<int> depths{options.picture.settings.maxDepth};
  for (const Sweep& sweep : options.sweeps) {
    if (sweep.name != "max-depth") continue;
    for (const std::string& value : sweep.values) depths.push_back(parseMaxDepth("--sweep", value));
  }
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  return depths;
}

std::vector<MeasureCase> casesOf(const MeasureOptions& options) {
  const auto recipe = recipeFromName(options.scene);
  const std::vector<std::size_t> lights =
      recipe && options.lights.empty() ? std::vector<std::size_t>{kDefaultRecipeLights} : options.lights;
  std::vector<MeasureCase> cases;
  for (const int depth : depthsOf(options)) {
    const std::string suffix = "-depth" + std::to_string(depth);
    if (!recipe)
      cases.push_back({fileSafe(std::filesystem::path(options.scene).stem().string()) + suffix, {}, 0, depth});
    for (const std::size_t n : recipe ? lights : std::vector<std::size_t>{}) {
      cases.push_back({options.scene + "-" + std::to_string(n) + suffix, recipe, n, depth});
    }
  }
  // Scenes one after the other: the depths of one share what was loaded.
  std::stable_sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.lights < b.lights; });
  return cases;
}

SamplerSettings swept(SamplerSettings settings, const std::string& name, const std::string& value) {
  if (name == "quality") {
    const std::size_t cellMemory = settings.cellMemory;
    settings = parseQuality("--sweep", value).settings;
    settings.cellMemory = cellMemory;
  } else if (name == "threshold") {
    settings.threshold = parseThreshold("--sweep", value);
  } else if (name == "max-cut") {
    settings.maxCut = parseMaxCut("--sweep", value);
  } else if (name == "grid-resolution") {
    settings.gridResolution = parseGridResolution("--sweep", value);
  } else {
    assert(name == "in-cluster");
    settings.inCluster = parseInCluster("--sweep", value);
  }
  return settings;
}

std::string nameAt(const std::string& base, const SweepPoint& point) {
  return base + "." + point.name + "=" + point.value;
}

/// The base of one strategy in one case, and the sweeps around it.
std::vector<Configuration> configurationsOf(const MeasureOptions& options, const MeasurePlan& plan,
                                            std::size_t caseIndex, Strategy strategy) {
  const std::string base = plan.cases[caseIndex].name + "." + std::string(nameOf(strategy));
  const SamplerSettings& settings = options.picture.settings.sampler;
  std::vector<Configuration> result{{base, caseIndex, strategy, settings, {}, true}};
  if (!hasCuts(strategy)) return result;
  for (const Sweep& sweep : options.sweeps) {
    if (sweep.name == "max-depth") continue;
    for (const std::string& value : sweep.values) {
      const SweepPoint point{sweep.name, value};
      const SamplerSettings varied = swept(settings, sweep.name, value);
      const auto same =
          std::find_if(result.begin(), result.end(), [&](const Configuration& c) { return c.sampler == varied; });
      if (same != result.end()) {
        same->points.push_back(point);
      } else {
        result.push_back({nameAt(base, point), caseIndex, strategy, varied, {point}, false});
      }
    }
  }
  return result;
}

}  // namespace

MeasurePlan planOf(const MeasureOptions& options) {
  MeasurePlan plan;
  plan.cases = casesOf(options);
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    for (const Strategy strategy : options.strategies) {
      for (Configuration& c : configurationsOf(options, plan, i, strategy)) plan.configurations.push_back(std::move(c));
    }
  }
  return plan;
}

RenderSettings settingsOf(const MeasureOptions& options, const MeasurePlan& plan, const Configuration& configuration) {
  RenderSettings settings = options.picture.settings;
  settings.auxiliary = false;
  settings.maxDepth = plan.cases[configuration.caseIndex].maxDepth;
  settings.strategy = configuration.strategy;
  settings.sampler = configuration.sampler;
  return settings;
}

}  // namespace cellcut
