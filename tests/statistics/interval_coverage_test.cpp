// Intervals of rendered errors hold the long-run value as often as they say. Of synthetic ones: unit/measure.
#include "renderer/measure/intervals.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/renderer.h"
#include "tests/support/images.h"
#include "tests/support/nightly.h"
#include "tests/support/recipe_scene.h"

#include <cmath>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

ImageRgb render(const Scene& scene, std::uint64_t seed, std::size_t passes) {
  RenderSettings settings;
  settings.width = 32;
  settings.height = 18;
  settings.maxDepth = 2;
  settings.seed = seed;
  settings.auxiliary = false;
  Renderer renderer(scene, settings);
  return renderPasses(renderer, passes);
}

TEST(IntervalCoverage, HoldsTheLongRunErrorOfRenderings) {
  if (!isNightly()) GTEST_SKIP() << "1,800 renderings: nightly";
  constexpr int kPasses = 4, kMostRuns = 20, kRepetitions = 40, kLongRun = 1000;
  const Scene scene = recipeScene(Recipe::kHall, 40);
  const ImageRgb reference = render(scene, 1'000'000, 1024);
  const auto errorOf = [&](std::uint64_t seed) {
    return compareImages(render(scene, seed, kPasses), reference).relmse;
  };
  std::vector<double> errors;
  errors.reserve(kRepetitions * kMostRuns);
  for (int i = 0; i < kRepetitions * kMostRuns; ++i) errors.push_back(errorOf(static_cast<std::uint64_t>(i)));
  double logarithm = 0;
  for (int i = 0; i < kLongRun; ++i) logarithm += std::log(errorOf(10'000 + static_cast<std::uint64_t>(i))) / kLongRun;
  const auto heldWith = [&](std::size_t runs) {
    int held = 0;
    for (std::size_t repetition = 0; repetition < kRepetitions; ++repetition) {
      const Estimate e = estimatePositive(std::span(errors).subspan(repetition * kMostRuns, runs));
      held += e.low <= std::exp(logarithm) && std::exp(logarithm) <= e.high;
    }
    return held;
  };
  // The hall's rare bright paths make its errors as skewed as any: five runs are few there, which only is said.
  std::cout << "5 runs: " << heldWith(5) << " of 40, 10 runs: " << heldWith(10) << ", 20 runs: " << heldWith(20)
            << "\n";
  EXPECT_GE(heldWith(20),
            34);  // 38 are expected; fewer than 34 once in 36 for honest intervals, and the seeds are fixed
}

}  // namespace
}  // namespace cellcut::test
