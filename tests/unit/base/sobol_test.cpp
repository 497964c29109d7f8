#include "renderer/base/sobol.h"

#include "renderer/base/pixel_sampler.h"
#include "tests/support/statistics.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using Point4 = std::array<std::uint32_t, 4>;

std::vector<Point4> prefix(unsigned log2Count, std::uint64_t seed, std::uint32_t first = 0) {
  std::vector<Point4> points;
  for (std::uint32_t i = 0; i < (1u << log2Count); ++i) points.push_back(owenSobol4(reverseBits(first + i), seed));
  return points;
}

/// Whether each elementary interval of 2^−bits per dimension holds as many points as every other.
bool isEven(const std::vector<Point4>& points, const std::array<unsigned, 4>& bits) {
  unsigned sum = 0;
  for (const unsigned b : bits) sum += b;
  std::vector<std::size_t> counts(std::size_t{1} << sum);
  for (const Point4& p : points) {
    std::size_t cell = 0;
    for (std::size_t d = 0; d < 4; ++d) {
      if (bits[d] > 0) cell = (cell << bits[d]) | (p[d] >> (32 - bits[d]));
    }
    ++counts[cell];
  }
  for (const std::size_t count : counts) {
    if (count * counts.size() != points.size()) return false;
  }
  return true;
}

constexpr std::uint64_t kSeeds[] = {0, 1, 0x123456789abcdefull, ~0ull};

TEST(Sobol, FirstTwoDimensionsOfAnyPrefixAreANet) {
  for (const std::uint64_t seed : kSeeds) {
    for (unsigned m = 0; m <= 10; ++m) {
      for (unsigned a = 0; a <= m; ++a) EXPECT_TRUE(isEven(prefix(m, seed), {a, m - a, 0, 0})) << m << " " << a;
    }
  }
}

TEST(Sobol, FourDimensionsOfAnyPrefixAreANetOfQualityThree) {
  // t = Σ (degree − 1) of the polynomials of degree 1, 2, 3 (Sobol' 1967).
  constexpr unsigned kQuality = 3;
  for (const std::uint64_t seed : kSeeds) {
    for (unsigned m = kQuality; m <= 10; ++m) {
      const std::vector<Point4> points = prefix(m, seed);
      const unsigned sum = m - kQuality;
      for (unsigned a = 0; a <= sum; ++a) {
        for (unsigned b = 0; a + b <= sum; ++b) {
          for (unsigned c = 0; a + b + c <= sum; ++c) EXPECT_TRUE(isEven(points, {a, b, c, sum - a - b - c}));
        }
      }
    }
  }
}

TEST(Sobol, EveryPairOfDimensionsIsStratified) {
  constexpr std::array<unsigned, 4> kQuality{0, 0, 1,
                                             2};  // degree − 1 of each dimension's polynomial; a pair has their sum
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      for (unsigned m = 4; m <= 12; ++m) {
        const unsigned sum = m - kQuality[a] - kQuality[b];
        for (unsigned first = 0; first <= sum; ++first) {
          std::array<unsigned, 4> bits{};
          bits[a] = first;
          bits[b] = sum - first;
          EXPECT_TRUE(isEven(prefix(m, 21), bits)) << a << " and " << b << ", 2^" << m << " points";
        }
      }
    }
  }
}

TEST(Sobol, EveryDimensionAloneIsStratified) {
  for (std::size_t d = 0; d < 4; ++d) {
    std::array<unsigned, 4> bits{};
    bits[d] = 12;
    EXPECT_TRUE(isEven(prefix(12, 5), bits)) << d;
  }
}

TEST(Sobol, LaterBlocksAreNetsToo) {
  // Beyond 2¹⁶, where the shuffle of the index ends.
  for (const std::uint32_t first : {1u << 10, 1u << 16, 1u << 20, 0xfffffc00u}) {
    for (unsigned a = 0; a <= 10; ++a)
      EXPECT_TRUE(isEven(prefix(10, 9, first), {a, 10 - a, 0, 0})) << first << " " << a;
  }
}

TEST(Sobol, FirstMillionPointsAreANet) {
  const std::vector<Point4> points = prefix(20, 77);
  for (unsigned a = 0; a <= 20; a += 5) EXPECT_TRUE(isEven(points, {a, 20 - a, 0, 0}));
}

TEST(Sobol, SeedsScrambleDifferently) {
  std::set<Point4> firsts;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) firsts.insert(owenSobol4(reverseBits(0), seed));
  EXPECT_EQ(firsts.size(), 1000u);
}

TEST(Sobol, OnePointIsUniformOverSeeds) {
  constexpr std::size_t kBins = 64;
  for (std::size_t d = 0; d < 4; ++d) {
    std::vector<std::uint64_t> counts(kBins);
    for (std::uint64_t seed = 0; seed < 100'000; ++seed) ++counts[owenSobol4(reverseBits(3), mixBits(seed))[d] >> 26];
    EXPECT_GT(chiSquareTest(counts, std::vector<double>(kBins, 1.0)).p, sidak(kAlpha, 4)) << d;
  }
}

TEST(Sobol, ScramblesOfTwoSeedsAreUncorrelated) {
  // The product of two centred uniform numbers has variance 1/144.
  Moments products;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    products.add((toUnitFloat(owenSobol4(reverseBits(7), mixBits(seed))[0]) - 0.5) *
                 (toUnitFloat(owenSobol4(reverseBits(7), mixBits(seed + 1'000'000))[0]) - 0.5));
  }
  EXPECT_LT(std::abs(zScore(products.mean(), products.meanVariance(), 0, 0)), criticalZ(1));
}

TEST(PixelSampler, AnyTwoGroupsOfDimensionsArePaddedIndependently) {
  // Pairs across groups are as even as independent numbers: χ² over passes neither too large nor, as if they were one
  // net, zero.
  for (const PixelSampling sampling : {PixelSampling::kSobol, PixelSampling::kIndependent}) {
    constexpr std::size_t kSide = 8;
    std::vector<std::uint64_t> counts(kSide * kSide);
    for (int pixel = 0; pixel < 64; ++pixel) {
      for (std::uint64_t pass = 0; pass < 1024; ++pass) {
        PixelSampler random(sampling, 1, pixel, 0, pass);
        const Sample4 first = random.next(), second = random.next();
        ++counts[static_cast<std::size_t>(first[0] * kSide) * kSide + static_cast<std::size_t>(second[1] * kSide)];
      }
    }
    const ChiSquare test = chiSquareTest(counts, std::vector<double>(counts.size(), 1.0));
    // Sobol' rows and columns are exactly even, which takes 14 of the 63 degrees of freedom: only the upper tail is
    // tested.
    EXPECT_GT(test.p, sidak(kAlpha, 2));
    EXPECT_GT(test.statistic, 10);
  }
}

TEST(PixelSampler, StartsAnotherScrambleAfterTwoToTheThirtyTwoPasses) {
  PixelSampler first(PixelSampling::kSobol, 1, 2, 3, 5), later(PixelSampling::kSobol, 1, 2, 3, 5 + (1ull << 32));
  EXPECT_NE(first.next().bits, later.next().bits);
}

TEST(PixelSampler, WideNumbersKeepTheirUpperBits) {
  PixelSampler random(PixelSampling::kSobol, 1, 2, 3, 5);
  const Sample4 numbers = random.next();
  EXPECT_EQ(std::floor(numbers.wide(2) * 0x1p32), numbers.bits[2]);
  EXPECT_LT((Sample4{{~0u, ~0u, ~0u, ~0u}, ~0ull}.wide(0)), 1.0);
  EXPECT_LT((Sample4{{~0u, ~0u, ~0u, ~0u}, ~0ull}[0]), 1.0f);
}

}  // namespace
}  // namespace cellcut::test
