/// \file sampler_settings.h
/// Parameters and statistics that strategies share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cellcut {

/// How a light is chosen inside a cluster.
enum class InCluster : std::uint8_t {
  kIntensity,  ///< proportional to J (Vévoda and Křivánek 2016)
  kDescent,    ///< small clusters down the tree by importance at the point (Conty Estevez and Kulla 2018)
};

/// On the command line and in reports.
constexpr std::string_view nameOf(InCluster choice) {
  return choice == InCluster::kDescent ? "descent" : "intensity";
}

/// What a quality sets: SamplerSettings says what it is.
struct FittedCuts {
  float threshold;
  int maxCut;
  int gridResolution;
  InCluster inCluster;
};
#include "renderer/sampling/fitted_qualities.inc"

/// Of the strategies with cuts; the others ignore them.
struct SamplerSettings {
  float threshold = kBalancedCuts.threshold;  ///< a cluster above this share of the cut's estimate is split; [0, 1]
  int maxCut = kBalancedCuts.maxCut;          ///< most clusters of a cut; 2 … kMaxCutSize
  int gridResolution = kBalancedCuts.gridResolution;  ///< cells along the longest axis of what is seen; 1 … 1024
  InCluster inCluster = kBalancedCuts.inCluster;
  std::size_t cellMemory = std::size_t{256} << 20;  ///< bytes of kept cuts; beyond, cuts are found again at every use
  bool countVisits = false;                         ///< count how often each kept cut is asked for a light

  bool operator==(const SamplerSettings&) const = default;
};

constexpr SamplerSettings settingsOf(const FittedCuts& cuts) {
  return {cuts.threshold, cuts.maxCut, cuts.gridResolution, cuts.inCluster};
}

/// Settings by what they trade; `./dev fit` measures their values.
struct Quality {
  std::string_view name;         ///< on the command line
  std::string_view description;  ///< one line
  SamplerSettings settings;
};
inline constexpr std::array kQualities{
    Quality{"preview", "the cheapest passes and cells, for a first look", settingsOf(kPreviewCuts)},
    Quality{"balanced", "the least noise for the time, over the recipes", settingsOf(kBalancedCuts)},
    Quality{"accurate", "the least noise per sample, for long renderings", settingsOf(kAccurateCuts)},
};

/// Largest maxCut: the weights of a cut lie on the stack.
inline constexpr int kMaxCutSize = 4096;
inline constexpr int kMaxGridResolution = 1024;

struct GridStatistics {
  std::array<int, 3> resolution{};  ///< fine cells that cover the pilot's box
  std::size_t fine = 0;             ///< fine cells that were made, inside the box or outside
  std::size_t coarse = 0;           ///< coarse cells that were made: of later path vertices and of remote points
  std::size_t made() const { return fine + coarse; }
};
struct CutStatistics {
  std::size_t min = 0, max = 0;  ///< clusters of the fine cells
  double mean = 0;
  double seconds = 0;     ///< of all cells and threads together
  std::size_t bytes = 0;  ///< of all cells
};
struct TreeStatistics {
  std::size_t nodes = 0;
  int depth = 0;
  double seconds = 0;  ///< of the build
  std::size_t bytes = 0;
};
/// What a strategy has of each.
struct SamplerStatistics {
  std::optional<GridStatistics> grid;
  std::optional<CutStatistics> cut;
  std::optional<TreeStatistics> tree;
};

}  // namespace cellcut
