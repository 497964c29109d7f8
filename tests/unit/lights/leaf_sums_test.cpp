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

struct Range {
  std::uint32_t first, end;
};
/// Of 1,000 leaves: all, one, inside a block of 64, over the border of two, many blocks with parts at both ends.
constexpr Range kRanges[] = {{0, 1000}, {999, 1000}, {70, 90}, {60, 70}, {63, 960}};

TEST(LeafSums, PmfIsProportionalToIntensityInAnyRange) {
  const std::vector<float> intensities = spreadIntensities(1000, 3);
  const LeafSums sums(intensities);
  for (const auto [first, end] : kRanges) {
    const double sum = std::accumulate(intensities.begin() + first, intensities.begin() + end, 0.0);
    double total = 0;
    for (std::uint32_t leaf = first; leaf < end; ++leaf) {
      const double pmf = sums.pmf(first, end, leaf);
      total += pmf;
      // A unit is 2⁻²⁴ of a block, whose sum is at most 64: 4·10⁻⁶, of the 10⁻³ that the faintest have.
      EXPECT_NEAR(pmf * sum / static_cast<double>(intensities[leaf]), 1, 5e-3) << first << " " << leaf;
    }
    EXPECT_NEAR(total, 1, 1e-12);  // a thousand double roundings
  }
}

TEST(LeafSums, DrawsEachLeafInAsManyOfEvenlySpacedNumbersAsItsPmfSays) {
  const LeafSums sums(spreadIntensities(1000, 1));
  constexpr int kDraws = 100'000;
  for (const auto [first, end] : kRanges) {
    std::vector<int> counts(1000);
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

TEST(LeafSums, FaintLeavesBesideStrongOnesCanBeDrawnAndAreEven) {
  std::vector<float> intensities(10'000, std::numeric_limits<float>::max());
  // Two in a block of bright ones, and a range of their own.
  std::fill(intensities.begin() + 100, intensities.begin() + 102, std::numeric_limits<float>::denorm_min());
  std::fill(intensities.begin() + 640, intensities.begin() + 1280, 1e-30f);
  const LeafSums sums(intensities);
  EXPECT_EQ(sums.pmf(100, 102, 100), 0.5);
  EXPECT_EQ(sums.sample(100, 102, 0.4).leaf, 100u);
  EXPECT_EQ(sums.sample(100, 102, 0.6).leaf, 101u);
  EXPECT_GT(sums.pmf(0, 10'000, 101), 0);
  EXPECT_LT(sums.pmf(0, 10'000, 101), 1e-9);
  for (std::uint32_t leaf = 640; leaf < 1280; ++leaf) EXPECT_NEAR(sums.pmf(640, 1280, leaf), 1.0 / 640, 1e-9);
}

TEST(LeafSums, EndsOfTheUnitIntervalAreTheFirstAndTheLastLeaf) {
  for (const std::uint32_t count : {1u, 2u, 63u, 64u, 65u, 128u, 1'000'000u}) {
    const LeafSums sums(std::vector<float>(count, 0.1f));
    EXPECT_EQ(sums.sample(0, count, 0).leaf, 0u);
    EXPECT_EQ(sums.sample(0, count, 1 - 0x1p-53).leaf, count - 1);
    EXPECT_NEAR(sums.pmf(0, count, count / 2) * count, 1, 1e-4) << count;
  }
}

}  // namespace
}  // namespace cellcut::test
