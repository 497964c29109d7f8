#include "renderer/trace/noise.h"

#include "renderer/base/rng.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/film.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

FilmState stateOf(const Film& film) {
  return {film.passes(), film.mean(), film.standardError()};
}

/// Renders `passes` independent samples of every pixel of a picture whose truth is 1 everywhere.
struct Synthetic {
  FilmState part, whole;
  double trueError = 0;  ///< √relMSE
};
Synthetic render(std::uint64_t seed, int passes, const std::function<float(Rng&)>& sample) {
  Film film(40, 25, false);
  Rng rng(seed);
  Synthetic result;
  for (int pass = 0; pass < passes; ++pass) {
    for (int y = 0; y < 25; ++y) {
      for (int x = 0; x < 40; ++x) film.record(x, y, {.radiance = Vec3(sample(rng))});
    }
    film.commit();
    if (pass + 1 == passes / 2) result.part = stateOf(film);
  }
  result.whole = stateOf(film);
  result.trueError = std::sqrt(compareImages(film.mean(), ImageRgb(40, 25, Vec3(1))).relmse);
  return result;
}

TEST(EstimateNoise, OfIndependentSamplesIsTheirStandardError) {
  // Uniform in [0, 2]: variance 1/3, 64 samples: √(1/3/64/1.01). 1,000 pixels leave 3 % of the estimate's own error.
  const Synthetic s = render(1, 64, [](Rng& rng) { return 2 * rng.uniform(); });
  const NoiseEstimate noise = estimateNoise(s.part, s.whole);
  EXPECT_NEAR(noise.value, std::sqrt(1.0 / 3 / 64 / 1.01), 0.03 * noise.value);
  EXPECT_GT(noise.bound, noise.value);
  EXPECT_LT(noise.bound, 1.1 * noise.value);
}

TEST(EstimateNoise, IsZeroWithoutNoiseAndWithoutLight) {
  const Synthetic flat = render(2, 32, [](Rng&) { return 1.0f; });
  EXPECT_EQ(estimateNoise(flat.part, flat.whole).bound, 0);
  const Synthetic black = render(3, 32, [](Rng&) { return 0.0f; });
  EXPECT_EQ(estimateNoise(black.part, black.whole).bound, 0);
}

TEST(EstimateNoise, DoesNotDependOnTheUnit) {
  const auto sample = [](Rng& rng) { return 2 * rng.uniform(); };
  const Synthetic one = render(4, 32, sample), scaled = render(4, 32, [&](Rng&rng) { return 0x1p-90f * sample(rng); });
  EXPECT_DOUBLE_EQ(estimateNoise(scaled.part, scaled.whole).bound, estimateNoise(one.part, one.whole).bound);
}

/// Designed for 97 %: of 100 pictures 90 at least, which honest bounds miss once in 2,000.
TEST(EstimateNoise, BoundHoldsForSmoothAndForRareLight) {
  const auto held = [](const std::function<float(Rng&)>& sample) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const Synthetic s = render(100 + seed, 32, sample);
      count += s.trueError < estimateNoise(s.part, s.whole).bound;
    }
    return count;
  };
  EXPECT_GE(held([](Rng& rng) { return 2 * rng.uniform(); }), 90);
  EXPECT_GE(held([](Rng& rng) { return rng.uniform() < 0.1f ? 10.0f : 0.0f; }), 90);
  EXPECT_GE(held([](Rng& rng) { return 0.5f + (rng.uniform() < 0.005f ? 100.0f : 0.0f); }), 90);
}

/// What Film::relativeError() misses: most pixels with a speck of light hold it once.
TEST(EstimateNoise, SeesRareBrightSamples) {
  Film film(40, 25, false);
  Rng rng(5);
  FilmState part;
  for (int pass = 0; pass < 32; ++pass) {
    for (int y = 0; y < 25; ++y) {
      for (int x = 0; x < 40; ++x)
        film.record(x, y, {.radiance = Vec3(0.5f + (rng.uniform() < 1e-3f ? 500.0f : 0.0f))});
    }
    film.commit();
    if (pass == 15) part = stateOf(film);
  }
  const double truth = std::sqrt(compareImages(film.mean(), ImageRgb(40, 25, Vec3(1))).relmse);
  EXPECT_LT(film.relativeError(), 0.2 * truth);
  EXPECT_GT(estimateNoise(part, stateOf(film)).bound, 0.8 * truth);
}

}  // namespace
}  // namespace cellcut
