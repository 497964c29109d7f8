#include "renderer/sampling/alias_table.h"

#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/statistics.h"

#include <bit>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Share of [0, 1) that leads to each index: where a bin changes from its own index to its alias is found by bisection
/// on u.
std::vector<double> sharesOf(const AliasTable& table, std::size_t n) {
  std::vector<double> shares(n);
  const double width = 1 / static_cast<double>(n);
  for (std::size_t bin = 0; bin < n; ++bin) {
    // A hair inside, where u · n rounds into this bin; borders of powers of two are exact.
    const double hair = std::has_single_bit(n) ? 0 : 1e-9 * width;
    double low = static_cast<double>(bin) * width + hair;
    double high = std::nextafter(static_cast<double>(bin + 1) * width - hair, 0.0);
    const std::size_t own = table.sample(low).index, rest = table.sample(high).index;
    while (own != rest && high - low > 1e-17) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (table.sample(middle).index == own ? low : high) = middle;
    }
    const double share = own == rest ? width : low - static_cast<double>(bin) * width;
    shares[own] += share;
    shares[rest] += width - share;
  }
  return shares;
}

TEST(AliasTable, SamplesWithItsPmf) {
  Rng rng(3);
  for (const std::size_t n : {1u, 2u, 3u, 33u, 1000u}) {
    std::vector<double> weights(n);
    for (double& w : weights) w = std::pow(10.0, 6 * rng.uniformDouble());
    const AliasTable table(weights);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<double> shares = sharesOf(table, n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_FLOAT_EQ(table.pmf(i), static_cast<float>(weights[i] / sum));
      // Shares of bins are floats: 2⁻²⁴ of each that leads here, and as much of the probability itself.
      EXPECT_NEAR(shares[i], static_cast<double>(table.pmf(i)),
                  0x1p-23 * static_cast<double>(table.pmf(i)) + 0x1p-24 / static_cast<double>(n))
          << i << " of " << n;
    }
  }
}

TEST(AliasTable, NeverReturnsAnIndexWithoutWeight) {
  // All places of the zeros, sums that do not come out even.
  for (unsigned zeros = 0; zeros < 63; ++zeros) {
    std::vector<double> weights(6);
    for (unsigned i = 0; i < 6; ++i) weights[i] = (zeros >> i) & 1 ? 0 : 0.1 * (i + 1);
    const AliasTable table(weights);
    for (int k = 0; k < 600; ++k) EXPECT_GT(weights[table.sample(k / 600.0).index], 0);
    EXPECT_GT(weights[table.sample(1 - 0x1p-53).index], 0);
  }
}

TEST(AliasTable, WithoutWeightsIsEmpty) {
  EXPECT_TRUE(AliasTable({}).empty());
  EXPECT_TRUE(AliasTable(std::vector<double>(5, 0.0)).empty());
  EXPECT_EQ(AliasTable(std::vector<double>(5, 0.0)).pmf(2), 0);
}

TEST(AliasTable, ReachesWeightsTwelveDecadesApart) {
  const std::vector<double> weights{1e-12, 1, 1e-12, 1};
  const AliasTable table(weights);
  EXPECT_EQ(table.sample(0).index, 0u);
  EXPECT_EQ(table.sample(0.5).index, 2u);
  const std::vector<double> shares = sharesOf(table, 4);
  // Doubles below 1 are 10⁻¹⁶ apart: 10⁻⁴ of the share.
  EXPECT_NEAR(shares[0] / 5e-13, 1, 5e-3);
}

TEST(AliasTable, CountsFollowItsPmf) {
  Rng rng(5);
  std::vector<double> weights(100);
  for (double& w : weights) w = rng.uniformDouble() < 0.2 ? 0 : rng.uniformDouble();
  const AliasTable table(weights);
  std::vector<std::uint64_t> counts(100);
  for (std::size_t i = 0; i < sampleShare(200'000); ++i) ++counts[table.sample(rng.uniformDouble()).index];
  const ChiSquare test = chiSquareTest(counts, weights);
  EXPECT_EQ(test.impossible, 0u);
  EXPECT_GT(test.p, kAlpha);
}

TEST(AliasTable, WhatIsLeftOfTheNumberIsUniform) {
  const AliasTable table(std::vector<double>{1, 7, 0, 3, 0.1});
  std::vector<std::uint64_t> counts(16);
  Rng rng(6);
  for (std::size_t i = 0; i < sampleShare(200'000); ++i) {
    const double rest = table.sample(rng.uniformDouble()).rest;
    ASSERT_TRUE(rest >= 0 && rest < 1);
    ++counts[static_cast<std::size_t>(rest * 16)];
  }
  EXPECT_GT(chiSquareTest(counts, std::vector<double>(16, 1.0 / 16)).p, kAlpha);
}

}  // namespace
}  // namespace cellcut::test
