#include "renderer/base/srgb.h"

#include <gtest/gtest.h>

namespace cellcut {
namespace {

constexpr float kUlps = 1e-6f;  // a few roundings of numbers up to 1

TEST(Srgb, HasTheStandardsValues) {
  EXPECT_EQ(srgbToLinear(0), 0.0f);
  EXPECT_NEAR(srgbToLinear(1), 1, kUlps);
  EXPECT_NEAR(srgbToLinear(0.5f), 0.21404114f, kUlps);
  EXPECT_NEAR(srgbToLinear(0.04f), 0.04f / 12.92f, kUlps);
}

TEST(Srgb, EncodingInvertsDecodingForEveryCode) {
  for (int code = 0; code < 256; ++code) {
    const float encoded = static_cast<float>(code) / 255;
    EXPECT_NEAR(linearToSrgb(srgbToLinear(encoded)), encoded, kUlps) << code;
  }
}

}  // namespace
}  // namespace cellcut
