#include "renderer/sampling/discrete_cdf.h"

#include "renderer/base/rng.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

constexpr double kOne = 1 << 30;  // the running sums' unit of probability

/// Over twelve decades, a third of them 0.
std::vector<double> manyWeights(std::size_t count) {
  Rng rng(count);
  std::vector<double> weights(count);
  for (double& w : weights) w = rng.uniform() < 0.3f ? 0 : std::pow(10.0, 12 * rng.uniformDouble());
  weights[count / 2] = 1e12;
  return weights;
}

TEST(DiscreteCdf, DrawsEachElementWithExactlyThePmfThatItReports) {
  for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 256u, 257u, 1000u, 4096u}) {
    const std::vector<double> weights = manyWeights(count);
    const DiscreteCdf cdf(weights);
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double pmf = cdf.pmf(i);
      ASSERT_EQ(pmf > 0, weights[i] > 0);
      if (pmf == 0) continue;
      // The first and the last number that lead here.
      for (const double u : {before, before + 0.5 * pmf, std::nextafter(before + pmf, 0.0)}) {
        const DiscreteCdf::Sample sample = cdf.sample(u);
        ASSERT_EQ(sample.index, i) << count;
        ASSERT_EQ(sample.pmf, pmf);
        ASSERT_DOUBLE_EQ(sample.rest, (u - before) / pmf);
        ASSERT_LT(sample.rest, 1);
      }
      before += pmf;
    }
    EXPECT_EQ(before, 1) << count;
  }
}

TEST(DiscreteCdf, PmfsAreTheSharesOfTheWeights) {
  for (const std::size_t count : {2u, 33u, 4096u}) {
    const std::vector<double> weights = manyWeights(count);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const DiscreteCdf cdf(weights);
    for (std::size_t i = 0; i < count; ++i) {
      // Each share is rounded, and what that leaves, a unit per element, is the largest's.
      EXPECT_NEAR(cdf.pmf(i), weights[i] / sum, static_cast<double>(count) / kOne);
    }
  }
}

TEST(DiscreteCdf, WithoutWeightsIsEmpty) {
  for (const std::vector<double>& weights : {std::vector<double>{}, std::vector<double>(40, 0.0)}) {
    const DiscreteCdf cdf(weights);
    EXPECT_TRUE(cdf.empty());
    EXPECT_EQ(cdf.pmf(0), 0);
  }
}

}  // namespace
}  // namespace cellcut::test
