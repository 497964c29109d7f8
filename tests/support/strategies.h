/// \file strategies.h
/// Tests that hold for every strategy there is and will be, with every kind of light.
#pragma once

#include "renderer/sampling/light_sampler.h"
#include "tests/support/scenes.h"

#include <array>
#include <tuple>

#include <gtest/gtest.h>

namespace cellcut::test {

/// A strategy as the proofs run it.
struct SamplerVariant {
  std::string_view name;
  Strategy strategy;
  SamplerSettings settings{};

  /// A descent by bounds can end where no light is left: those of light-tree, and of cuts inside a cluster or to what a
  /// glossy surface mirrors.
  bool canEndInNothing(const ShadingPoint& point) const {
    const bool hasCuts = strategy == Strategy::kCellCut || strategy == Strategy::kPointCut;
    return strategy == Strategy::kLightTree ||
           (hasCuts && (settings.inCluster == InCluster::kDescent || point.lobe.share > 0));
  }
  /// Point-cut finds a cut for each sample, which costs a hundred times a sample of the others: it gets a sixteenth.
  std::size_t affordable(std::size_t samples) const { return strategy == Strategy::kPointCut ? samples / 16 : samples; }
  friend void PrintTo(const SamplerVariant& variant, std::ostream* stream) { *stream << variant.name; }
};

/// Every strategy, and those with cuts of so few clusters that most hold several lights.
inline constexpr std::array kSamplerVariants{
    SamplerVariant{"uniform", Strategy::kUniform},
    SamplerVariant{"power", Strategy::kPower},
    SamplerVariant{"proportional", Strategy::kProportional},
    SamplerVariant{"cell_cut", Strategy::kCellCut},
    SamplerVariant{"cell_cut_few", Strategy::kCellCut, {.maxCut = 6, .gridResolution = 4}},
    SamplerVariant{"cell_cut_few_intensity",
                   Strategy::kCellCut,
                   {.maxCut = 6, .gridResolution = 4, .inCluster = InCluster::kIntensity}},
    SamplerVariant{"point_cut", Strategy::kPointCut},
    SamplerVariant{"point_cut_few_intensity", Strategy::kPointCut, {.maxCut = 6, .inCluster = InCluster::kIntensity}},
    SamplerVariant{"light_tree", Strategy::kLightTree},
};

/// Those whose probabilities of a million lights take seconds at a point and not minutes (point-cut) or days
/// (proportional).
inline constexpr std::array kFastVariants{
    SamplerVariant{"uniform", Strategy::kUniform}, SamplerVariant{"power", Strategy::kPower},
    SamplerVariant{"cell_cut", Strategy::kCellCut}, SamplerVariant{"light_tree", Strategy::kLightTree}};

/// A variant and a set of lights.
class StrategyAndLights : public testing::TestWithParam<std::tuple<SamplerVariant, LightMix>> {
 protected:
  const SamplerVariant& variant() const { return std::get<0>(GetParam()); }
  std::unique_ptr<LightSampler> samplerOf(const Lights& lights) const {
    return makeLightSampler(variant().strategy, lights, variant().settings);
  }
  std::size_t affordable(std::size_t samples) const { return variant().affordable(samples); }
  LightMix mix() const { return std::get<1>(GetParam()); }
  /// Differs from mix to mix, so that no two sets are alike.
  std::uint64_t seed() const { return 1000 + static_cast<std::uint64_t>(mix()); }
};

/// Names the tests of a suite over kSamplerVariants.
inline std::string variantName(const testing::TestParamInfo<SamplerVariant>& info) {
  return std::string(info.param.name);
}
/// "cell_cut_All"
inline std::string strategyAndLightsName(const testing::TestParamInfo<StrategyAndLights::ParamType>& info) {
  return std::string(std::get<0>(info.param).name) + "_" + nameOf(std::get<1>(info.param));
}

}  // namespace cellcut::test

/// Makes the tests of a fixture derived from StrategyAndLights run for all strategies and lights.
#define CELLCUT_FOR_ALL_STRATEGIES_AND_LIGHTS(Fixture)                                          \
  INSTANTIATE_TEST_SUITE_P(Every, Fixture,                                                      \
                           testing::Combine(testing::ValuesIn(cellcut::test::kSamplerVariants), \
                                            testing::ValuesIn(cellcut::test::kLightMixes)),     \
                           cellcut::test::strategyAndLightsName)
