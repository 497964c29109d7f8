/// \file cell_inspector.h
/// Everything that is known of one pixel: its values, its cell, and the cut that its light is chosen from beside the
/// truth by brute force.
///
/// Space: world, metres. Threads: on the calling thread, beside sampling at will; the film's images must hold still.
#pragma once

#include "renderer/sampling/inspection.h"
#include "ui/overlays/light_contribution.h"

#include <nlohmann/json_fwd.hpp>

namespace cellcut {

/// A row of the table: a cluster, what the strategy thinks of it and what it truly sends.
struct ClusterRow {
  ClusterInspection cluster;
  std::vector<LightId> lights;  ///< in the order of the cluster's leaves
  Contribution contribution;    ///< of all of its lights, W/m²
  double share = 0;             ///< of the visible contribution of the whole cut; 0 where nothing is visible
  double mismatch = 0;          ///< probability − share, [−1, 1]: above 0 it is asked too often
};

struct PixelReport {
  glm::ivec2 pixel{0};             ///< origin top left
  std::uint64_t samples = 0;       ///< per pixel
  std::optional<Vec3> radiance;    ///< HDR value, W/(m² sr)
  std::optional<double> variance;  ///< of one sample, mean over the channels, as the overlay; with two passes or more
  FirstHit hit;                    ///< of the pixel's centre; without one there is nothing below

  bool hasCut = false;                  ///< the strategy chooses from cuts
  std::optional<CellCoordinates> cell;  ///< nothing where the point is a region of its own
  Bounds cellBox;                       ///< empty without a cell
  bool kept = false;                    ///< a path touched the cell
  std::uint64_t visits = 0;             ///< SamplerSettings::countVisits
  std::vector<ClusterRow> clusters;     ///< its number is the cut size
  double mirrored = 0;                  ///< share of the samples that follow what the surface mirrors, and no cluster
  double unoccluded = 0;                ///< Σ over clusters, W/m²
  double visible = 0;
  /// ½ Σ |mismatch|, the total variation distance between choice and truth: 0 perfect, 1 hopeless. Nothing where no
  /// light is visible.
  std::optional<double> distance;
};

struct InspectionInputs {
  const Scene& scene;
  const Accel& accel;
  const Lights& lights;
  const LightSampler& sampler;
  const Camera& camera;
  glm::ivec2 size;                          ///< of the picture
  const ImageRgb* mean = nullptr;           ///< Film::mean(), of that size
  const ImageRgb* standardError = nullptr;  ///< Film::standardError()
  std::uint64_t passes = 0;
};

/// \param pixel           inside of the picture
/// \param samplesPerSide  shadow rays per triangle or tile, squared; other lights take one: a million rays take about a
///                        second
/// \return nothing if `cancel` became true first
std::optional<PixelReport> inspectPixel(const InspectionInputs& inputs, glm::ivec2 pixel, int samplesPerSide,
                                        const std::atomic<bool>& cancel);

/// The report as it is exported. Boxes are [lower, upper]; what is not known is null; a cluster's `lights` is their
/// number.
nlohmann::ordered_json toJson(const PixelReport& report);

}  // namespace cellcut
