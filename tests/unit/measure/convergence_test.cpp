#include "renderer/measure/convergence.h"

#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

using ::testing::ElementsAre;

TEST(InterpolateLogLog, IsExactForPowers) {
  std::vector<CurvePoint> curve;
  for (const double x : {1.0, 2.0, 4.0, 32.0}) curve.push_back({x, 5 / x});
  for (const double x : {1.0, 1.7, 3.0, 9.0, 32.0}) EXPECT_NEAR(interpolateLogLog(curve, x), 5 / x, 1e-12);
}

TEST(InterpolateLogLog, ClaimsNothingOutsideOfThePoints) {
  const std::array curve{CurvePoint{1, 8}, CurvePoint{2, 4}};
  EXPECT_EQ(interpolateLogLog(curve, 0.5), 8);
  EXPECT_EQ(interpolateLogLog(curve, 100), 4);
  EXPECT_EQ(interpolateLogLog(std::array{CurvePoint{3, 7}}, 20), 7);
}

TEST(InterpolateLogLog, ReachesZeroInAStraightLine) {
  const std::array curve{CurvePoint{1, 8}, CurvePoint{4, 0}};
  EXPECT_NEAR(interpolateLogLog(curve, 2), 4, 1e-12);
}

TEST(LogLogSlope, IsTheExponent) {
  std::vector<CurvePoint> curve;
  for (const double x : {1.0, 2.0, 4.0, 32.0}) curve.push_back({x, 3 * std::pow(x, -1.25)});
  EXPECT_NEAR(logLogSlope(curve), -1.25, 1e-12);
  curve.push_back({64, 0});  // has no logarithm and is left out
  EXPECT_NEAR(logLogSlope(curve), -1.25, 1e-12);
  EXPECT_TRUE(std::isnan(logLogSlope(std::array{CurvePoint{1, 1}})));
}

TEST(ParetoFront, KeepsWhatNothingBeats) {
  const std::array points{CurvePoint{3, 1}, CurvePoint{1, 5}, CurvePoint{2, 6},
                          CurvePoint{2, 2}, CurvePoint{4, 1}, CurvePoint{1, 7}};
  EXPECT_THAT(paretoFront(points), ElementsAre(1, 3, 0));
  EXPECT_TRUE(paretoFront({}).empty());
}

}  // namespace
}  // namespace cellcut
