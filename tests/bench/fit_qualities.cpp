/// \file fit_qualities.cpp
/// Fits the presets of --quality over the recipes, and writes what it found: `./dev fit`.
///
/// Settings are tried in turns on every recipe, as `--quality auto` does it, but on larger films and with no more of
/// them at once: cells that few pixels ask, or that many others' came between, are in no cache, which favours few and
/// small ones (on 160×90 with all in turn 8 cells along won by 5 %; pictures of 640×360 take 5 to 40 % more time with
/// them for the same noise). Among their means over the recipes `balanced` has the least inefficiency (relMSE ×
/// seconds), `preview` the shortest pass and `accurate` the least relMSE at equal samples, of those that are not much
/// less efficient. A preset that is as good as the best, as far as the trials can tell, stays what it is.
#include "renderer/base/image_io.h"
#include "renderer/measure/quality_choice.h"
#include "tests/support/recipe_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace cellcut {
namespace {

/// Of the rendering that a setting is to be good for: what it builds is spread over it.
constexpr double kSeconds = 60;
/// Seconds of trials in direct light and at depth 5: three passes of each setting are the least.
constexpr double kDirectTrials = 10, kDeepTrials = 16;
/// Settings that take turns with `balanced`.
constexpr std::size_t kAtOnce = 3;
/// How much less efficient than `balanced` the others may be.
constexpr double kMostCost = 1.5;
/// What two settings differ by in one run of this program and not in the next.
constexpr double kSlack = 1.03;

/// Of a setting, over those of `balanced` as it was; geometric means over the recipes.
struct Score {
  SamplerSettings settings;
  double seconds = 1, error = 1, cost = 1;
};

/// All that is tried, each once; the first is `balanced`, which the others are held against.
std::vector<Quality> candidates() {
  std::vector<Quality> all(kQualities.begin(), kQualities.end());
  std::swap(all[0], all[1]);
  const auto add = [&](const SamplerSettings& settings) {
    const auto isIt = [&](const Quality& quality) { return quality.settings == settings; };
    if (std::none_of(all.begin(), all.end(), isIt)) all.push_back({"", "", settings});
  };
  for (const int maxCut : {256, 512, 1024, 2048}) {
    for (const float threshold : {0.0005f, 0.002f}) {
      for (const InCluster inCluster : {InCluster::kIntensity, InCluster::kDescent}) {
        add({.threshold = threshold, .maxCut = maxCut, .inCluster = inCluster});
      }
    }
  }
  for (const int grid : {8, 32}) add({.gridResolution = grid});
  return all;
}

std::vector<Score> scores() {
  struct Case {
    Recipe recipe;
    std::size_t lights;
    int maxDepth;
  };
  double cases = 0;
  const std::vector<Quality> all = candidates();
  std::vector<Score> sums;
  sums.reserve(all.size());
  for (const Quality& quality : all) sums.push_back({quality.settings, 0, 0, 0});
  for (const auto& [recipe, lights, maxDepth] :
       {Case{Recipe::kRooms, 4000, 1}, Case{Recipe::kStreet, 4000, 1}, Case{Recipe::kHall, 4000, 1},
        Case{Recipe::kKinds, 1000, 1}, Case{Recipe::kRooms, 4000, 5}, Case{Recipe::kStreet, 4000, 5},
        Case{Recipe::kHall, 4000, 5}, Case{Recipe::kKinds, 1000, 5}}) {
    const Scene scene = test::recipeScene(recipe, lights);
    // The films of its trials are of 640×360.
    const Renderer base(scene, {.width = 2560, .height = 1440, .maxDepth = maxDepth, .sampler = all[0].settings});
    double spent = 0;
    for (std::size_t begin = 1; begin < all.size(); begin += kAtOnce) {
      std::vector<Quality> tried{all[0]};
      for (std::size_t i = begin; i < std::min(begin + kAtOnce, all.size()); ++i) tried.push_back(all[i]);
      Renderer renderer(base, base.settings());
      const PlannedLength length{.seconds = (maxDepth == 1 ? kDirectTrials : kDeepTrials) / kTrialShare};
      const QualityChoice choice = chooseQuality(renderer, tried, length, std::atomic<bool>(false));
      spent += choice.seconds;
      const QualityTrial& first = choice.trials[0];
      for (std::size_t i = 1; i < tried.size(); ++i) {
        const QualityTrial& trial = choice.trials.at(i);
        if (!std::isfinite(trial.inefficiency.value)) throw std::runtime_error("a setting was too slow to be judged");
        const double seconds = trial.passSeconds / first.passSeconds,
                     error = trial.relativeVariance / first.relativeVariance;
        const double building = (kSeconds - first.buildSeconds) / (kSeconds - trial.buildSeconds);
        Score& sum = sums[begin + i - 1];
        sum.seconds += std::log(seconds);
        sum.error += std::log(error);
        sum.cost += std::log(seconds * error * building);
      }
    }
    std::printf("%s, %zu lights, depth %d: %.0f s\n", kRecipes[static_cast<std::size_t>(recipe)].name.data(), lights,
                maxDepth, spent);
    ++cases;
  }
  for (Score& s : sums) {
    for (double* value : {&s.seconds, &s.error, &s.cost}) *value = std::exp(*value / cases);
    std::printf("cut %4d, threshold %.4f, grid %2d, %-9s  time %.3f  relMSE %.3f  cost %.3f\n", s.settings.maxCut,
                static_cast<double>(s.settings.threshold), s.settings.gridResolution,
                nameOf(s.settings.inCluster).data(), s.seconds, s.error, s.cost);
  }
  return sums;
}

const Score& scoreOf(const std::vector<Score>& all, const SamplerSettings& settings) {
  return *std::find_if(all.begin(), all.end(), [&](const Score& s) { return s.settings == settings; });
}

/// The setting with the least of `what` among those that cost at most `mostCost`, or what it was when that is as good.
const Score& best(const std::vector<Score>& all, const SamplerSettings& before, double mostCost, double Score::*what) {
  const auto value = [&](const Score& s) {
    return s.cost <= mostCost ? s.*what : std::numeric_limits<double>::infinity();
  };
  const auto isLess = [&](const Score& a, const Score& b) { return value(a) < value(b); };
  const Score &least = *std::min_element(all.begin(), all.end(), isLess), &stays = scoreOf(all, before);
  return value(stays) <= kSlack * value(least) ? stays : least;
}

std::string codeOf(std::string_view name, const SamplerSettings& s) {
  std::ostringstream code;
  code << "inline constexpr FittedCuts k" << name << "Cuts{.threshold = " << s.threshold << "f, .maxCut = " << s.maxCut
       << ", .gridResolution = " << s.gridResolution
       << ", .inCluster = InCluster::" << (s.inCluster == InCluster::kDescent ? "kDescent" : "kIntensity") << "};\n";
  return code.str();
}

std::string rowOf(std::string_view name, const Score& s, const Score& balanced) {
  char text[256];
  std::snprintf(text, sizeof text, "| `%s` | %d | %g | %d | %s | %.2f | %.2f | %.2f |\n", name.data(),
                s.settings.maxCut, static_cast<double>(s.settings.threshold), s.settings.gridResolution,
                nameOf(s.settings.inCluster).data(), s.seconds / balanced.seconds, s.error / balanced.error,
                s.cost / balanced.cost);
  return text;
}

void write(const std::string& file, const std::string& text) {
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

/// Puts a table between the two marks of a text.
std::string withTable(const std::string& text, const std::string& table) {
  const std::string begin = "<!-- ./dev fit -->\n", end = "<!-- end -->\n";
  const std::size_t from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos)
    throw std::runtime_error("README has no place for the table");
  return text.substr(0, from + begin.size()) + table + text.substr(to);
}

void fit(const std::string& code, const std::string& readme) {
  std::ifstream in(readme);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  withTable(text, "");  // before minutes are spent
  const std::vector<Score> all = scores();
  const Score& balanced = best(all, kQualities[1].settings, std::numeric_limits<double>::infinity(), &Score::cost);
  const Score& preview = best(all, kQualities[0].settings, kMostCost * balanced.cost, &Score::seconds);
  const Score& accurate = best(all, kQualities[2].settings, kMostCost * balanced.cost, &Score::error);
  const std::string table =
      "| `--quality` | clusters up to | threshold | cells along | in clusters by | seconds per pass | relMSE per "
      "sample | "
      "relMSE × seconds |\n|---|---|---|---|---|---|---|---|\n" +
      rowOf("preview", preview, balanced) + rowOf("balanced", balanced, balanced) +
      rowOf("accurate", accurate, balanced);
  write(code, "// Written by `./dev fit`, which measures: not by hand.\n" + codeOf("Preview", preview.settings) +
                  codeOf("Balanced", balanced.settings) + codeOf("Accurate", accurate.settings));
  write(readme, withTable(text, table));
  std::printf("%s", table.c_str());
}

}  // namespace
}  // namespace cellcut

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: fit_qualities FILE.inc README.md\n");
    return 2;
  }
  try {
    cellcut::fit(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
