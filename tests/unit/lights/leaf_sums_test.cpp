#include "renderer/lights/leaf_sums.h"

#include "renderer/base/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Intensities over so many decades below 1.
std::vector<float> spreadIntensities(std::size_t count, float decades) {
  Rng rng(3);
  std::vector<float> intensities(count);
  for (float& intensity : intensities) intensity = std::pow(10.0f, -decades * rng.uniform());
  return intensities;
}

LeafSums oneBlock(const std::vector<float>& intensities) {
  LeafSums sums;
  sums.addBlock(intensities);
  return sums;
}

struct Range {
  std::uint32_t first, end;
};
/// Of 200 leaves.
constexpr Range kRanges[] = {{0, 200}, {199, 200}, {0, 1}, {70, 90}, {100, 200}};

TEST(LeafSums, PmfIsProportionalToIntensityInAnyRange) {
  const std::vector<float> intensities = spreadIntensities(200, 3);
  const LeafSums sums = oneBlock(intensities);
  for (const auto [first, end] : kRanges) {
    const double sum = std::accumulate(intensities.begin() + first, intensities.begin() + end, 0.0);
    double total = 0;
    for (std::uint32_t leaf = first; leaf < end; ++leaf) {
      const double pmf = sums.pmf(first, end, leaf);
      total += pmf;
      // The faintest have 10⁻³ of 200, which is 80 of 2²⁴; rounded to one of these, and each has one more.
      EXPECT_NEAR(pmf * sum / static_cast<double>(intensities[leaf]), 1, 2.0 / 80) << first << " " << leaf;
    }
    EXPECT_NEAR(total, 1, 1e-12);  // 200 double roundings
  }
}

TEST(LeafSums, DrawsEachLeafInAsManyOfEvenlySpacedNumbersAsItsPmfSays) {
  const LeafSums sums = oneBlock(spreadIntensities(200, 1));
  constexpr int kDraws = 100'000;
  for (const auto [first, end] : kRanges) {
    std::vector<int> counts(200);
    for (int i = 0; i < kDraws; ++i) {
      const SampledLeaf drawn = sums.sample(first, end, (i + 0.5) / kDraws);
      ASSERT_GE(drawn.leaf, first);
      ASSERT_LT(drawn.leaf, end);
      ASSERT_EQ(drawn.pmf, sums.pmf(first, end, drawn.leaf));
      ++counts[drawn.leaf];
    }
    // An interval of u of this length holds so many of them, give or take one.
    for (std::uint32_t leaf = first; leaf < end; ++leaf)
      EXPECT_NEAR(counts[leaf], kDraws * sums.pmf(first, end, leaf), 1) << first << " " << leaf;
  }
}

TEST(LeafSums, OfOneBlockAreNothingToAnother) {
  LeafSums sums;
  sums.addBlock(std::vector<float>{1, 3});
  sums.addBlock(std::vector<float>(1, std::numeric_limits<float>::max()));
  sums.addBlock(std::vector<float>{3, 1, 1e-30f});
  EXPECT_NEAR(sums.pmf(0, 2, 1), 0.75, 1e-6);
  EXPECT_EQ(sums.pmf(2, 3, 2), 1);
  EXPECT_NEAR(sums.pmf(3, 6, 3), 0.75, 1e-6);
  EXPECT_EQ(sums.sample(0, 2, 1 - 0x1p-53).leaf, 1u);
  EXPECT_EQ(sums.sample(2, 3, 0.5).leaf, 2u);
  EXPECT_EQ(sums.sample(3, 6, 0).leaf, 3u);
  EXPECT_EQ(sums.sample(3, 6, 1 - 0x1p-53).leaf, 5u);
}

TEST(LeafSums, FaintLeavesBesideStrongOnesCanBeDrawnAndAreEven) {
  std::vector<float> intensities(256, std::numeric_limits<float>::max());
  std::fill(intensities.begin() + 100, intensities.begin() + 102, std::numeric_limits<float>::denorm_min());
  const LeafSums sums = oneBlock(intensities);
  EXPECT_EQ(sums.pmf(100, 102, 100), 0.5);
  EXPECT_EQ(sums.sample(100, 102, 0.4).leaf, 100u);
  EXPECT_EQ(sums.sample(100, 102, 0.6).leaf, 101u);
  EXPECT_GT(sums.pmf(0, 256, 101), 0);
  EXPECT_LT(sums.pmf(0, 256, 101), 1e-7);
}

}  // namespace
}  // namespace cellcut::test
