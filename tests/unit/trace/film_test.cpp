#include "renderer/trace/film.h"

#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

void add(Film& film, const Vec3& radiance) {
  film.record(0, 0, {radiance, Vec3(0.5f), Vec3(0, 1, 0), 2});
  film.commit();
}

TEST(Film, IsBlackBeforeTheFirstPass) {
  const Film film(2, 3, true);
  EXPECT_EQ(film.mean().at(1, 2), Vec3(0));
  EXPECT_EQ(film.passes(), 0u);
  EXPECT_EQ(film.relativeError(), std::numeric_limits<double>::infinity());
}

TEST(Film, KeepsSixDigitsOverManySamples) {
  // A float sum would stop growing at 2²⁴ samples. 10⁸ of them at night, 10⁷ always: rounding is worse with more.
  Film film(1, 1, false);
  const std::size_t n = sampleShare(byDepth(10'000'000, 100'000'000));
  Rng rng(1);
  long double sum = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    // Like a noisy pixel: mostly dim, now and then very bright.
    const float value = rng.uniform() < 0.001f ? 1000 * rng.uniform() : 0.1f * rng.uniform();
    sum += static_cast<long double>(value);
    squares += static_cast<long double>(value) * static_cast<long double>(value);
    film.record(0, 0, {Vec3(value), Vec3(0), Vec3(0), 0});
    film.commit();
  }
  const auto count = static_cast<long double>(n);
  EXPECT_NEAR(static_cast<double>(film.mean().at(0, 0).x / static_cast<float>(sum / count)), 1, 1e-6);
  const long double error = std::sqrt((squares - sum * sum / count) / (count * (count - 1)));
  EXPECT_NEAR(static_cast<double>(film.standardError().at(0, 0).y) / static_cast<double>(error), 1, 1e-6);
}

TEST(Film, CountsSamplesThatAreNoNumbers) {
  Film film(1, 1, false);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  add(film, Vec3(2));
  add(film, Vec3(nan, 1, 1));
  add(film, Vec3(1, kInfinity, 1));
  add(film, Vec3(1, -kInfinity, nan));
  EXPECT_EQ(film.badSamples().nan, 2u);
  EXPECT_EQ(film.badSamples().inf, 1u);
  EXPECT_EQ(film.badSampleCounts().at(0, 0), 3u);
  // They count as black, so that the mean stays a mean over all passes.
  EXPECT_EQ(film.mean().at(0, 0), Vec3(0.5f));
}

TEST(Film, StandardErrorIsThatOfTheMean) {
  Film film(1, 1, false);
  for (const float value : {1.0f, 2.0f, 3.0f, 6.0f}) add(film, Vec3(value, 0, 5));
  // Variance of {1, 2, 3, 6} is 14/3; a quarter of it, and its root.
  EXPECT_NEAR(film.standardError().at(0, 0).x, std::sqrt(14.0 / 3 / 4), 1e-6);
  EXPECT_EQ(film.standardError().at(0, 0).y, 0);
  EXPECT_EQ(film.standardError().at(0, 0).z, 0);
}

TEST(Film, StandardErrorCoversTheTruthAsOftenAsItShould) {
  Rng rng(8);
  Moments covered;
  for (int run = 0; run < 4000; ++run) {
    Film film(1, 1, false);
    for (int i = 0; i < 200; ++i) add(film, Vec3(rng.uniform()));
    covered.add(std::abs(film.mean().at(0, 0).x - 0.5f) < film.standardError().at(0, 0).x ? 1 : 0);
  }
  // erf(1/√2); Student's t with 199 degrees of freedom is within 0.001 of it.
  EXPECT_LT(std::abs(zScore(covered.mean(), covered.meanVariance(), 0.6827, 1e-6)), criticalZ(1));
}

TEST(Film, StandardErrorNeitherOverflowsNorVanishes) {
  for (const float scale : {1e-30f, 1e30f}) {
    Film film(1, 1, false);
    for (const float value : {1.0f, 3.0f}) add(film, Vec3(value * scale));
    EXPECT_NEAR(film.standardError().at(0, 0).x / scale, 1, 1e-6);
    // 1 / 2 of the mean, over √(1 + 0.01).
    EXPECT_NEAR(film.relativeError(), 0.5 / std::sqrt(1.01), 1e-6);
  }
}

TEST(Film, ScalesBitForBitByPowersOfTwo) {
  Film one(1, 1, false), scaled(1, 1, false);
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const float value = rng.uniform();
    add(one, Vec3(value));
    add(scaled, Vec3(value * 0x1p60f));
  }
  EXPECT_EQ(one.mean().at(0, 0).x * 0x1p60f, scaled.mean().at(0, 0).x);
  EXPECT_EQ(one.standardError().at(0, 0).x * 0x1p60f, scaled.standardError().at(0, 0).x);
  EXPECT_EQ(one.relativeError(), scaled.relativeError());
}

TEST(Film, ForgetsAPassThatIsNotCommitted) {
  Film film(1, 1, true);
  add(film, Vec3(1));
  film.record(0, 0, {Vec3(100), Vec3(1), Vec3(1), 9});
  EXPECT_EQ(film.mean().at(0, 0), Vec3(1));
  add(film, Vec3(3));
  EXPECT_EQ(film.mean().at(0, 0), Vec3(2));
  EXPECT_EQ(film.passes(), 2u);
}

TEST(Film, HasALayerForEachQuantity) {
  Film film(1, 1, true);
  add(film, Vec3(1, 2, 3));
  const LayeredImage image = film.layers();
  ASSERT_EQ(image.layers.size(), 5u);
  EXPECT_EQ(image.layers[0].values, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(image.layers[1].values, (std::vector<float>{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(image.layers[2].values, (std::vector<float>{0, 1, 0}));
  EXPECT_EQ(image.layers[3].values, (std::vector<float>{2}));
  EXPECT_EQ(image.layers[4].values, (std::vector<float>{0, 0, 0}));
}

}  // namespace
}  // namespace cellcut::test
