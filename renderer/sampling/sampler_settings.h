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

/// Of the strategies with cuts; the others ignore them.
struct SamplerSettings {
  float threshold = 0.002f;  ///< a cluster above this share of the cut's estimate is split; [0, 1]
  int maxCut = 1024;         ///< most clusters of a cut; 2 … kMaxCutSize
  int gridResolution = 16;   ///< cells along the longest axis of what is seen; 1 … 1024
  InCluster inCluster = InCluster::kDescent;
  std::size_t cellMemory = std::size_t{256} << 20;  ///< bytes of kept cuts; beyond, cuts are found again at every use
};

/// Settings by what they trade. Their values come from measurement: README, "Measured".
struct Quality {
  std::string_view name;         ///< on the command line
  std::string_view description;  ///< one line
  SamplerSettings settings;
};
inline constexpr std::array kQualities{
    Quality{"preview",
            "the cheapest passes and cells, for a first look",
            {.threshold = 0.005f, .maxCut = 256, .inCluster = InCluster::kIntensity}},
    Quality{"balanced", "the least noise for the time, over the recipes", {}},
    Quality{"accurate", "the least noise per sample, for long renderings", {.threshold = 0.0005f, .maxCut = 2048}},
};

/// Largest maxCut: the weights of a cut lie on the stack.
inline constexpr int kMaxCutSize = 4096;
inline constexpr int kMaxGridResolution = 1024;

struct GridStatistics {
  std::array<int, 3> resolution{};  ///< cells that cover the pilot's box
  std::size_t touched = 0;          ///< cells that were made, inside the box or outside
};
struct CutStatistics {
  std::size_t min = 0, max = 0;  ///< clusters
  double mean = 0;
  double seconds = 0;  ///< of all threads together
  std::size_t bytes = 0;
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
