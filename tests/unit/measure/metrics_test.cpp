#include "renderer/measure/metrics.h"

#include "renderer/base/rng.h"
#include "renderer/measure/flip.h"

#include <gtest/gtest.h>

namespace cellcut {
namespace {

/// Two pixels whose errors are computed by hand: A = (3, 2, 1), (1, 1, 1); B = (1, 2, 3), (2, 2, 2).
struct TwoPixels {
  ImageRgb a{2, 1, Vec3(1.0f)};
  ImageRgb b{2, 1, Vec3(2.0f)};
  TwoPixels() {
    a.at(0, 0) = {3, 2, 1};
    b.at(0, 0) = {1, 2, 3};
  }
};

TEST(CompareImages, FollowsItsDefinitions) {
  const TwoPixels p;
  const ImageComparison c = compareImages(p.a, p.b);
  EXPECT_DOUBLE_EQ(c.meanA, 9.0 / 6);
  EXPECT_DOUBLE_EQ(c.meanB, 12.0 / 6);
  EXPECT_DOUBLE_EQ(c.epsilon, 0.04);
  EXPECT_DOUBLE_EQ(c.mse, (4 + 0 + 4 + 3) / 6.0);
  EXPECT_DOUBLE_EQ(c.relmse, (4 / 1.04 + 0 + 4 / 9.04 + 3 / 4.04) / 6);
  EXPECT_EQ(c.maxAbs, 2);
  double sum = 0;
  for (const float e : flipHdr(p.a, p.b)) sum += e;
  EXPECT_DOUBLE_EQ(c.flip, sum / 2);
}

TEST(CompareImages, SmapeFollowsItsDefinition) {
  const TwoPixels p;
  // ε = 0.01 · mean(B) = 0.02; channels (3,1) (2,2) (1,3) and three times (1,2).
  EXPECT_DOUBLE_EQ(compareImages(p.a, p.b).smape, (2 / 4.02 + 0 + 2 / 4.02 + 3 * (1 / 3.02)) / 6);
}

TEST(CompareImages, SmapeStaysBetweenZeroAndOne) {
  EXPECT_EQ(compareImages(ImageRgb(3, 2), ImageRgb(3, 2)).smape, 0);
  EXPECT_EQ(compareImages(ImageRgb(3, 2, Vec3(1.0f)), ImageRgb(3, 2)).smape, 1);
  const double nearlyAll = compareImages(ImageRgb(3, 2), ImageRgb(3, 2, Vec3(1.0f))).smape;
  EXPECT_DOUBLE_EQ(nearlyAll, 1 / 1.01);
}

TEST(CompareImages, LdrFlipSeesWhatTheDisplayShows) {
  const auto flipOf = [](const Vec3& a, const Vec3& b) {
    return compareImages(ImageRgb(8, 8, a), ImageRgb(8, 8, b)).flipLdr;
  };
  // Below its shoulder at 0.8 toneMap() changes nothing, so these are ꟻLIP's own: black against 0.5, and two greys as
  // computed by hand in flip_test.cpp. Filters in float leave 1e-4.
  EXPECT_NEAR(flipOf(Vec3(0.5f), Vec3(0.52f)), 0.06581283282068773, 1e-4);
  EXPECT_NEAR(flipOf(Vec3(0.18f), {0.2f, 0.18f, 0.16f}), 0.11041534912073062, 1e-4);
  // Far above white two brightnesses look the same, which MSE does not know.
  EXPECT_LT(flipOf(Vec3(1e6f), Vec3(2e6f)), 1e-3);
}

TEST(CompareImages, RedIsNotBlueToAnyMetric) {
  const ImageRgb red(8, 8, Vec3(0.8f, 0, 0)), blue(8, 8, Vec3(0, 0, 0.8f));
  const ImageComparison c = compareImages(red, blue);
  EXPECT_EQ(c.meanA, c.meanB);  // a comparison of brightness sees nothing
  EXPECT_NEAR(c.mse, 2 * 0.64 / 3, 1e-7);
  EXPECT_GT(c.relmse, 0.1);
  EXPECT_NEAR(c.smape, 2.0 / 3, 0.01);
  EXPECT_GT(c.flip, 0.9);
  EXPECT_GT(c.flipLdr, 0.9);
}

TEST(ReferenceError, IsWhatTwoNoisyPicturesHaveInCommon) {
  // Truth 1; both pictures are off by up to ± 0.5, the reference by ± 0.1: its relMSE is 0.01/1.01 of itself, the
  // pictures' own 0.083. 3 · 10⁴ products of a spread of 0.1 leave 6 · 10⁻⁴.
  Rng rng(3);
  ImageRgb a(100, 100), b(100, 100), reference(100, 100);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      a[i][c] = rng.uniform(0.5f, 1.5f);
      b[i][c] = rng.uniform(0.5f, 1.5f);
      reference[i][c] = rng.uniform() < 0.5f ? 0.9f : 1.1f;
    }
  }
  EXPECT_NEAR(referenceError(a, b, reference), 0.01, 2e-3);
  EXPECT_NEAR(referenceError(a, b, ImageRgb(100, 100, Vec3(1))), 0, 2e-3);
  EXPECT_GT(compareImages(a, reference).relmse, 0.08);
}

TEST(CompareImages, FindsNoErrorInTheSamePicture) {
  const TwoPixels p;
  const ImageComparison c = compareImages(p.a, p.a);
  EXPECT_EQ(c.mse, 0);
  EXPECT_EQ(c.relmse, 0);
  EXPECT_EQ(c.smape, 0);
  EXPECT_EQ(c.flip, 0);
  EXPECT_EQ(c.flipLdr, 0);
  EXPECT_EQ(c.maxAbs, 0);
}

TEST(CompareImages, BlackReferenceIsRightOrInfinitelyWrong) {
  const ImageRgb black(3, 2);
  EXPECT_EQ(compareImages(black, black).relmse, 0);
  EXPECT_EQ(compareImages(ImageRgb(3, 2, Vec3(1.0f)), black).relmse, std::numeric_limits<double>::infinity());
}

TEST(CompareImages, SumsInDouble) {
  // 6e4 pixels of 1 + 2⁻²⁰ against 1: a float sum would lose the difference.
  const ImageRgb a(256, 256, Vec3(1 + 0x1p-20f)), b(256, 256, Vec3(1.0f));
  const ImageComparison c = compareImages(a, b);
  EXPECT_DOUBLE_EQ(c.meanA, 1 + 0x1p-20);
  EXPECT_NEAR(c.mse, 0x1p-40, 0x1p-80);  // each square is exact; 6e4 roundings of 2⁻⁵³, relative
}

TEST(CompareImages, SquaresBeyondFloatsAreFinite) {
  const ImageComparison c = compareImages(ImageRgb(2, 2, Vec3(3e38f)), ImageRgb(2, 2, Vec3(1e38f)));
  EXPECT_NEAR(c.mse, 4e76, 4e69);  // 2⁻²⁴ of the two floats, relative
  EXPECT_NEAR(c.relmse, 4 / 1.01, 1e-6);
}

TEST(CompareImages, NanIsNotHidden) {
  ImageRgb a(2, 2, Vec3(1.0f));
  a.at(0, 0).y = std::numeric_limits<float>::quiet_NaN();
  const ImageComparison c = compareImages(a, ImageRgb(2, 2, Vec3(1.0f)));
  EXPECT_TRUE(std::isnan(c.mse));
  EXPECT_TRUE(std::isnan(c.relmse));
  EXPECT_TRUE(std::isnan(c.maxAbs));
  EXPECT_TRUE(std::isfinite(c.flip));
}

TEST(CompareImages, RelativeErrorDoesNotDependOnTheUnit) {
  Rng rng(1);
  ImageRgb a(16, 16), b(16, 16);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = {rng.uniform(), rng.uniform(), rng.uniform()};
    b[i] = {rng.uniform(), rng.uniform(), rng.uniform()};
  }
  const double expected = compareImages(a, b).relmse;
  for (Vec3& p : a) p *= 0x1p40f;
  for (Vec3& p : b) p *= 0x1p40f;
  EXPECT_DOUBLE_EQ(compareImages(a, b).relmse, expected);
}

}  // namespace
}  // namespace cellcut
