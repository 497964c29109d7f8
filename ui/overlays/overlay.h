/// \file overlay.h
/// The strategy's decisions and the state of the picture as one number per pixel.
///
/// Cells are shown where the centre of a pixel first meets a surface, those that the light there is chosen from: fine ones
/// near what is seen, coarse ones towards the horizon. The coarse ones that bounces of light have among the fine are not shown.
/// NaN: there is no value, and nothing is drawn. Colours: color_scale.h. Threads: on the calling thread,
/// not while samples are drawn.
#pragma once

#include "renderer/sampling/inspection.h"
#include "ui/overlays/color_scale.h"
#include "ui/overlays/first_hits.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cellcut {

enum class Overlay : std::uint8_t {
  kNone,
  kTouched,
  kVisits,
  kCutSize,
  kEstimate,
  kTreeDepth,
  kVariance,
  kSamples,
  kError,
  kNan
};

struct OverlayName {
  Overlay overlay;
  std::string_view name;         ///< on the command line
  std::string_view title;        ///< over the legend
  std::string_view unit;         ///< "" for counts
  bool integral;                 ///< values are whole numbers
  std::string_view description;  ///< one line
};

inline constexpr std::array kOverlays{
    OverlayName{Overlay::kNone, "none", "no overlay", "", false, "the picture alone"},
    OverlayName{Overlay::kTouched, "touched", "cells touched", "", true, "cells whose cut was made"},
    OverlayName{Overlay::kVisits, "visits", "visits per cell", "", true, "lights asked for from the cell's cut"},
    OverlayName{Overlay::kCutSize, "cut-size", "cut size", "clusters", true, "clusters that one light is chosen from"},
    OverlayName{Overlay::kEstimate, "estimate", "estimate of the cut", "W/m²", false,
                "sum of the clusters' estimated irradiance"},
    OverlayName{Overlay::kTreeDepth, "tree-depth", "light-tree depth", "levels", true,
                "depth of the deepest cluster of the cut; the root is 0"},
    OverlayName{Overlay::kVariance, "variance", "variance of samples", "W²/(m⁴ sr²)", false,
                "variance of one sample, mean over the channels"},
    OverlayName{Overlay::kSamples, "samples", "samples", "per pixel", true, "samples per pixel so far"},
    OverlayName{Overlay::kError, "error", "error", "W/(m² sr)", false,
                "distance from the reference; without one, the standard error of the mean"},
    OverlayName{Overlay::kNan, "nan", "bad samples", "", true, "samples that were NaN or infinite"},
};

constexpr const OverlayName& describe(Overlay overlay) {
  return kOverlays[static_cast<std::size_t>(overlay)];
}

/// What overlays are read from. What is null is not there, and its overlays have no values.
struct OverlayInputs {
  const Image<FirstHit>* firstHits = nullptr;
  const LightSampler* sampler = nullptr;
  bool everyCell = false;                   ///< cells that no path touched have the cut that one would find there
  const ImageRgb* mean = nullptr;           ///< Film::mean()
  const ImageRgb* standardError = nullptr;  ///< Film::standardError()
  std::uint64_t passes = 0;                 ///< Film::passes()
  const ImageRgb* reference = nullptr;      ///< of the picture's size; another size has no error to show
  const Image<std::uint16_t>* badSamples = nullptr;  ///< Film::badSampleCounts(); null or empty: none was bad
};

/// The value of each pixel, of the size of the inputs' pictures (`size` for kNone and where all of them are missing).
/// - touched: 1 where the cell's cut was made, else 0; NaN without a hit, and for strategies without cells.
/// - visits: of the cell, 0 for a cell that was not touched or not kept, or without SamplerSettings::countVisits.
/// - cut size, estimate, tree depth: NaN in cells that were not touched; for `point-cut` of a cut that is found anew at
///   every pixel, which takes as long as a pass.
/// - variance: NaN with fewer than two passes. error: √(mean over channels of (mean − reference)²), without reference
///   √(mean over channels of standardError²).
/// \return nothing if `cancel` became true first
std::optional<Image<float>> computeOverlay(Overlay overlay, const OverlayInputs& inputs, glm::ivec2 size,
                                           const std::atomic<bool>& cancel);

/// The settings with the overlay's own automatic range: "touched" is 0 to 1 even where every cell, or none, is.
ScaleSettings scaleOf(Overlay overlay, const ScaleSettings& settings);

/// Of the finite values of a picture.
struct OverlayStatistics {
  std::size_t count = 0;  ///< of pixels with a value; with 0 the rest is 0
  double minimum = 0;
  double maximum = 0;
  double mean = 0;
};
OverlayStatistics statisticsOf(const Image<float>& values);

/// Fine cells whose cut was made, and remote coarse ones.
struct TouchedCells {
  std::size_t inside = 0;   ///< in the box that the grid covers
  std::size_t outside = 0;  ///< fine ones beyond it
  std::size_t remote = 0;   ///< GridGeometry::isRemote()
  std::size_t all = 0;      ///< cells of the box
  double share() const { return all > 0 ? static_cast<double>(inside) / static_cast<double>(all) : 0; }
};
/// Nothing for strategies without cells.
std::optional<TouchedCells> touchedCells(const LightSampler& sampler);

}  // namespace cellcut
