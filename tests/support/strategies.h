/// \file strategies.h
/// Tests that hold for every strategy there is and will be, with every kind of light.
#pragma once

#include "renderer/sampling/light_sampler.h"
#include "tests/support/scenes.h"

#include <tuple>

#include <gtest/gtest.h>

namespace cellcut::test {

/// A strategy of kStrategies and a set of lights.
class StrategyAndLights : public testing::TestWithParam<std::tuple<StrategyName, LightMix>> {
 protected:
  Strategy strategy() const { return std::get<0>(GetParam()).strategy; }
  LightMix mix() const { return std::get<1>(GetParam()); }
  /// Differs from mix to mix, so that no two sets are alike.
  std::uint64_t seed() const { return 1000 + static_cast<std::uint64_t>(mix()); }
};

/// "cell_cut_All": names of GoogleTest hold no hyphen.
inline std::string strategyName(std::string_view name) {
  std::string result(name);
  std::replace(result.begin(), result.end(), '-', '_');
  return result;
}
inline std::string strategyAndLightsName(const testing::TestParamInfo<StrategyAndLights::ParamType>& info) {
  return strategyName(std::get<0>(info.param).name) + "_" + nameOf(std::get<1>(info.param));
}

}  // namespace cellcut::test

/// Makes the tests of a fixture derived from StrategyAndLights run for all strategies and lights.
#define CELLCUT_FOR_ALL_STRATEGIES_AND_LIGHTS(Fixture)                                                          \
  INSTANTIATE_TEST_SUITE_P(                                                                                     \
      Every, Fixture,                                                                                           \
      testing::Combine(testing::ValuesIn(cellcut::kStrategies), testing::ValuesIn(cellcut::test::kLightMixes)), \
      cellcut::test::strategyAndLightsName)
