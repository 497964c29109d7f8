#include "renderer/base/srgb.h"

#include "tests/support/vectors.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(Srgb, HasTheStandardsValues) {
  EXPECT_EQ(srgbToLinear(0), 0.0f);
  EXPECT_NEAR(srgbToLinear(1), 1, kRounding);
  EXPECT_NEAR(srgbToLinear(0.5f), 0.21404114f, kRounding);
  EXPECT_NEAR(srgbToLinear(0.04f), 0.04f / 12.92f, kRounding);
}

TEST(Srgb, EncodingInvertsDecodingForEveryCode) {
  for (int code = 0; code < 256; ++code) {
    const float encoded = static_cast<float>(code) / 255;
    EXPECT_NEAR(linearToSrgb(srgbToLinear(encoded)), encoded, kRounding) << code;
  }
}

}  // namespace
}  // namespace cellcut::test
