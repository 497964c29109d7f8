#include "renderer/base/tone_map.h"

#include "tests/support/vectors.h"

#include <cmath>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(ToneMap, IsPlainSrgbBelowTheShoulder) {
  // IEC 61966-2-1: a linear piece up to 0.0031308, then 1.055 c^(1/2.4) − 0.055.
  const Vec3 shown = toneMap({0.002f, 0.18f, 0.8f});
  EXPECT_NEAR(shown.x, 0.02584f, kRounding);
  EXPECT_NEAR(shown.y, 1.055f * std::pow(0.18f, 1 / 2.4f) - 0.055f, kRounding);
  EXPECT_NEAR(shown.z, 1.055f * std::pow(0.8f, 1 / 2.4f) - 0.055f, kRounding);
  EXPECT_EQ(toneMap(Vec3(0.0f)), Vec3(0.0f));
}

TEST(ToneMap, RisesToWhiteWithoutReachingPastIt) {
  float previous = -1;
  for (int i = 0; i <= 300; ++i) {  // 2⁻¹⁰ … 2²⁰
    const Vec3 shown = toneMap(Vec3(std::exp2(-10 + 0.1f * static_cast<float>(i))));
    EXPECT_EQ(shown.x, shown.y);
    EXPECT_GE(shown.x, previous);
    EXPECT_LE(shown.x, 1.0f);
    previous = shown.x;
  }
  EXPECT_GT(previous, 0.999f);  // 1 − 0.2² / 2²⁰, encoded
}

TEST(ToneMap, ShoulderMeetsTheStraightPartSmoothly) {
  // Slope 1 on both sides of 0.8, measured in the encoded values, whose own slope is the same there.
  const float step = 1e-3f;
  const float below = toneMap(Vec3(0.8f)).x - toneMap(Vec3(0.8f - step)).x;
  const float above = toneMap(Vec3(0.8f + step)).x - toneMap(Vec3(0.8f)).x;
  EXPECT_NEAR(above / below, 1,
              0.02);  // second order: 2 · step / 0.2 from the shoulder's curvature, 1e-3 from rounding
}

TEST(ToneMap, BrightColorsKeepTheOrderOfTheirChannels) {
  const Vec3 shown = toneMap({9, 3, 1});
  EXPECT_GT(shown.x, shown.y);
  EXPECT_GT(shown.y, shown.z);
}

TEST(ToneMap, VeryBrightColorsFadeToWhite) {
  const Vec3 shown = toneMap({1e6f, 0, 0});
  EXPECT_GT(shown.y, 0.99f);
}

TEST(ToneMap, BadNumbersAreShown) {
  EXPECT_EQ(toneMap(Vec3(kNan)), Vec3(0.0f));
  EXPECT_EQ(toneMap(Vec3(-1.0f)), Vec3(0.0f));
  for (const float bright : {kInfinity, std::numeric_limits<float>::max()}) {
    const Vec3 shown = toneMap(Vec3(bright, 0, kNan));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], 1, kRounding);
  }
}

}  // namespace
}  // namespace cellcut::test
