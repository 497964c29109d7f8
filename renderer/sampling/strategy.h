/// \file strategy.h
/// The light-sampling strategies by name.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cellcut {

enum class Strategy : std::uint8_t { kUniform, kPower, kProportional, kCellCut, kPointCut, kLightTree };

struct StrategyName {
  Strategy strategy;
  std::string_view name;         ///< on the command line and in reports
  std::string_view description;  ///< one line
};

inline constexpr std::array kStrategies{
    StrategyName{Strategy::kUniform, "uniform", "every light with the same probability"},
    StrategyName{Strategy::kPower, "power", "lights by their flux, wherever they are"},
    StrategyName{Strategy::kProportional, "proportional", "lights by their unoccluded irradiance at the point; O(N)"},
    StrategyName{Strategy::kCellCut, "cell-cut",
                 "a cut through the light trees per grid cell, lights by its cached estimates"},
    StrategyName{Strategy::kPointCut, "point-cut", "a cut found anew at every point, without cells"},
    StrategyName{Strategy::kLightTree, "light-tree", "one random descent through the light tree"},
};

constexpr std::string_view nameOf(Strategy strategy) {
  return kStrategies[static_cast<std::size_t>(strategy)].name;
}

/// Whether SamplerSettings matter to it.
constexpr bool hasCuts(Strategy strategy) {
  return strategy == Strategy::kCellCut || strategy == Strategy::kPointCut;
}

}  // namespace cellcut
