#include "renderer/lights/scalar_emission.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(ScalarEmission, OfGreyIsItsValueToTheLastBit) {
  for (const float grey : {1e-45f, 1e-30f, 0.1f, 1.0f, 3e38f}) EXPECT_EQ(scalarEmission(Vec3(grey)), grey);
}

TEST(ScalarEmission, IsTheNormOfTheChannelsOverThatOfWhite) {
  EXPECT_EQ(scalarEmission(Vec3(0)), 0);
  EXPECT_DOUBLE_EQ(scalarEmission(Vec3(0, 0, 1)), 1 / std::numbers::sqrt3);
  EXPECT_DOUBLE_EQ(scalarEmission(Vec3(1, 2, 3)), std::sqrt(14.0 / 3));
}

TEST(ScalarEmission, OfTheDimmestColorIsAFloatAboveZero) {
  for (const Vec3& color : {Vec3(1e-45f, 0, 0), Vec3(0, 1e-45f, 0), Vec3(0, 0, 1e-45f)}) {
    EXPECT_GT(static_cast<float>(scalarEmission(color)), 0);
  }
}

}  // namespace
}  // namespace cellcut::test
