#include "renderer/measure/intervals.h"

#include "renderer/base/rng.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

/// Box and Muller 1958.
double normal(Rng& rng) {
  const double u = 1 - rng.uniformDouble(), v = rng.uniformDouble();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

TEST(Student, QuantilesAreThoseOfThePublishedTables) {
  // Three decimals are what the tables print (NIST/SEMATECH e-Handbook, 1.3.6.7.2).
  EXPECT_NEAR(studentQuantile(0.975, 1), 12.706, 5e-4);
  EXPECT_NEAR(studentQuantile(0.975, 2), 4.303, 5e-4);
  EXPECT_NEAR(studentQuantile(0.975, 4), 2.776, 5e-4);
  EXPECT_NEAR(studentQuantile(0.975, 19), 2.093, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 10), 1.812, 5e-4);
  EXPECT_NEAR(studentQuantile(0.995, 30), 2.750, 5e-4);
  EXPECT_NEAR(studentQuantile(0.025, 4), -2.776, 5e-4);
  EXPECT_NEAR(studentQuantile(0.975, 1e7), 1.95996, 1e-4);  // the normal distribution
}

TEST(Student, DistributionHasItsClosedForms) {
  for (const double t : {-30.0, -1.0, 0.0, 0.3, 2.0, 1e6}) {
    EXPECT_NEAR(studentCdf(t, 1), 0.5 + std::atan(t) / std::numbers::pi, 1e-12);
    EXPECT_NEAR(studentCdf(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 1e-12);
  }
}

TEST(EstimateMean, IsTheTextbooks) {
  const std::array values{1.0, 2.0, 3.0, 4.0, 5.0};
  const Estimate e = estimateMean(values);
  EXPECT_DOUBLE_EQ(e.value, 3);
  const double half = 2.7764451051977987 * std::sqrt(2.5 / 5);
  EXPECT_NEAR(e.low, 3 - half, 1e-12);
  EXPECT_NEAR(e.high, 3 + half, 1e-12);
}

TEST(EstimateMean, OfOneNumberHasNoInterval) {
  const std::array values{2.0};
  EXPECT_EQ(estimateMean(values).value, 2);
  EXPECT_TRUE(std::isnan(estimateMean(values).low));
  EXPECT_TRUE(std::isnan(estimatePositive(values).high));
}

TEST(EstimatePositive, IsTheGeometricMeanAndNeverNegative) {
  const std::array values{0.01, 1.0, 100.0};
  const Estimate e = estimatePositive(values);
  EXPECT_NEAR(e.value, 1, 1e-12);
  EXPECT_GT(e.low, 0);
  EXPECT_NEAR(e.low * e.high, 1, 1e-9);  // symmetric as a factor
}

TEST(EstimatePositive, SaysTheSameOfASquareAndItsRoot) {
  const std::array squares{0.2, 0.3, 0.25, 0.6};
  auto roots = squares;
  for (double& v : roots) v = std::sqrt(v);
  const Estimate e = estimatePositive(squares), r = estimatePositive(roots);
  EXPECT_NEAR(r.value * r.value, e.value, 1e-12);
  EXPECT_NEAR(r.low * r.low, e.low, 1e-12);
  EXPECT_NEAR(r.high * r.high, e.high, 1e-12);
}

TEST(EstimatePositive, WithZerosIsTheMean) {
  const std::array values{0.0, 2.0};
  EXPECT_EQ(estimatePositive(values).value, 1);
}

/// 40 repetitions of a few runs whose errors are skewed as those of renderings: the interval holds the long-run value
/// at least 34 times (of 38 expected; fewer than 34 happen once in 36 for honest intervals, and the seed is fixed).
TEST(EstimatePositive, IntervalsCoverTheLongRunValue) {
  for (const std::size_t runs : {2u, 5u, 20u}) {
    Rng rng(runs);
    int held = 0;
    for (int repetition = 0; repetition < 40; ++repetition) {
      std::vector<double> errors;
      for (std::size_t i = 0; i < runs; ++i) errors.push_back(0.01 * std::exp(0.8 * normal(rng)));
      const Estimate e = estimatePositive(errors);
      held += e.low <= 0.01 && 0.01 <= e.high;
    }
    EXPECT_GE(held, 34) << runs << " runs";
  }
}

/// The same of a sum of squares, which is not log-normal: relMSE over few independent pixels. Its long-run value is the
/// geometric mean of many.
TEST(EstimatePositive, IntervalsCoverForSumsOfSquares) {
  const auto errorOf = [](Rng& rng) {
    double sum = 0;
    for (int pixel = 0; pixel < 10; ++pixel) sum += std::pow(normal(rng), 2) / 10;
    return sum;
  };
  Rng many(1);
  double logarithm = 0;
  constexpr int kMany = 100'000;  // leaves 0.15 % of an error, against intervals of ± 50 %
  for (int i = 0; i < kMany; ++i) logarithm += std::log(errorOf(many)) / kMany;
  Rng rng(2);
  int held = 0;
  for (int repetition = 0; repetition < 40; ++repetition) {
    std::array<double, 5> errors;
    for (double& error : errors) error = errorOf(rng);
    const Estimate e = estimatePositive(errors);
    held += e.low <= std::exp(logarithm) && std::exp(logarithm) <= e.high;
  }
  EXPECT_GE(held, 34);
}

}  // namespace
}  // namespace cellcut
