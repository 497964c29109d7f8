#include "app/stop_rule.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

StopRule passRule(std::uint64_t passes) {
  return {.kind = StopRule::Kind::kPasses, .passes = passes};
}
StopRule timeRule(double seconds) {
  return {.kind = StopRule::Kind::kSeconds, .seconds = seconds};
}
StopRule noiseRule(double noise) {
  return {.kind = StopRule::Kind::kNoise, .noise = noise};
}

TEST(StopRule, IsSixtyFourPassesByDefault) {
  EXPECT_FALSE(isReached(StopRule{}, {.passes = 63}));
  EXPECT_TRUE(isReached(StopRule{}, {.passes = 64}));
}

TEST(StopRule, PassesDoNotLookAtTheClock) {
  EXPECT_FALSE(isReached(passRule(2), {.passes = 1, .seconds = 1e6}));
}

TEST(StopRule, TimeWaitsForTheFirstPass) {
  EXPECT_FALSE(isReached(timeRule(1), {.passes = 0, .seconds = 2}));
  EXPECT_FALSE(isReached(timeRule(1), {.passes = 5, .seconds = 0.999}));
  EXPECT_TRUE(isReached(timeRule(1), {.passes = 1, .seconds = 1}));
}

TEST(StopRule, NoiseWaitsForEnoughPasses) {
  EXPECT_FALSE(isReached(noiseRule(0.1), {.passes = kMinNoisePasses - 1, .relativeError = 0.01}));
  EXPECT_TRUE(isReached(noiseRule(0.1), {.passes = kMinNoisePasses, .relativeError = 0.01}));
}

TEST(StopRule, NoiseGoesOnWhileTheErrorIsNotBelow) {
  EXPECT_FALSE(isReached(noiseRule(0.1), {.passes = 100, .relativeError = 0.1}));
  EXPECT_FALSE(isReached(noiseRule(0.1), {.passes = 100, .relativeError = std::numeric_limits<double>::infinity()}));
}

TEST(StopRule, PictureWithoutLightHasNoNoise) {
  EXPECT_TRUE(isReached(noiseRule(0.1), {.passes = 100, .relativeError = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_TRUE(isReached(noiseRule(0.1), {.passes = 100, .relativeError = 0}));
}

TEST(StopRule, DoneShareIsCountedInTheRulesOwnUnit) {
  EXPECT_DOUBLE_EQ(doneShare(passRule(8), {.passes = 2}), 0.25);
  EXPECT_DOUBLE_EQ(doneShare(timeRule(8), {.passes = 7, .seconds = 2}), 0.25);
  // Half of the error takes four times the passes.
  EXPECT_DOUBLE_EQ(doneShare(noiseRule(0.5), {.passes = 100, .relativeError = 1.0}), 0.25);
}

TEST(StopRule, DoneShareNeverPassesOne) {
  EXPECT_DOUBLE_EQ(doneShare(timeRule(1), {.passes = 1, .seconds = 3}), 1);
  EXPECT_DOUBLE_EQ(doneShare(noiseRule(1), {.passes = 100, .relativeError = 1e-9}), 1);
}

TEST(StopRule, DoneShareOfNoiseIsZeroWhileUnknown) {
  EXPECT_EQ(doneShare(noiseRule(1), {.passes = 2, .relativeError = 0}), 0);
  EXPECT_EQ(doneShare(noiseRule(1), {.passes = 100, .relativeError = 0}), 1) << "black";
  EXPECT_EQ(doneShare(noiseRule(1), {.passes = 100, .relativeError = std::nan("")}), 1) << "isReached() says so";
}

}  // namespace
}  // namespace cellcut
