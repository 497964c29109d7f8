/// \file inspection.h
/// What a strategy with cuts decides at a point, for those who look: overlays and the cell inspector.
///
/// Looking changes nothing: no cell is made by it, no visit counted, no time added to the statistics. The cut of a cell
/// that no path has touched yet is found for the looker and forgotten. Space: world, metres. Threads: const members may
/// run concurrently with each other and with sampling; forEachCell() not while samples are drawn.
#pragma once

#include "renderer/sampling/cell_grid.h"
#include "renderer/sampling/cut_choice.h"

#include <functional>
#include <optional>
#include <vector>

namespace cellcut {

/// One cluster of a cut as a shading point sees it.
struct ClusterInspection {
  NodeId node;
  bool distant;              ///< of the distant tree: directional lights and environment tiles
  bool far;                  ///< weighed once for all surfaces of one facing; the others at the point itself
  std::uint32_t lightCount;  ///< ≥ 1
  Bounds box;                ///< of its lights, metres; empty for distant clusters
  Cone directions;           ///< distant clusters: where their lights lie as seen from the scene; else not set
  int depth;                 ///< of its node in its tree; 0 is the root
  double estimate;           ///< of the irradiance of a surface that faces it, W/m² (scalar emission)
  double probability;        ///< that a choice by the cut goes into it at the point; Σ is 1, or all are 0
};

/// The cut that a light is chosen from at a point.
struct CutInspection {
  std::optional<CellCoordinates> cell;      ///< nothing where the point is a region of its own
  Bounds cellBox;                           ///< empty without a cell
  bool kept = false;                        ///< a path touched the cell and its cut is in the table
  std::uint64_t visits = 0;                 ///< SamplerSettings::countVisits
  std::vector<ClusterInspection> clusters;  ///< in the order of Cut::members()
};

/// A cut in a few numbers.
struct CutSummary {
  std::uint64_t visits = 0;  ///< SamplerSettings::countVisits
  std::size_t size = 0;      ///< clusters
  double estimate = 0;       ///< Σ of their estimates, W/m²
  int depth = 0;             ///< of the deepest cluster in its tree; 0: no cluster, or roots only
};

class CutInspector {
 public:
  /// Nothing for a strategy without cuts. The strategy must outlive the inspector.
  static std::optional<CutInspector> of(const LightSampler& sampler);

  /// The grid of cells; null where every point has a cut of its own.
  const GridGeometry* grid() const { return strategy_.grid; }
  /// GridGeometry::cellOf(); nothing without a grid.
  std::optional<CellCoordinates> cellOf(const Vec3& p, bool indirect = false) const;
  /// The cell's cut if a path touched it and it was kept.
  const Cut* find(const CellCoordinates& cell) const;
  /// Every cell that was touched and kept, in no order.
  void forEachCell(const std::function<void(const CellCoordinates&, const Cut&)>& visit) const;

  CutSummary summary(const Cut& cut) const;
  /// Of the cut that a point has for itself alone: what `point-cut` asks there.
  CutSummary summaryOfPoint(const Vec3& p) const;
  /// Of the cut that a path would find for a cell. \pre there is a grid
  CutSummary summaryOfCell(const CellCoordinates& cell) const;

  CutInspection inspect(const ShadingPoint& point) const;
  /// MirroredLights::share(): of the samples at a point, those that go by its lobe and not by the cut.
  double mirroredShare(const ShadingPoint& point) const;
  /// The lights of a cluster, in the order of its leaves.
  std::vector<LightId> lights(const ClusterInspection& cluster) const;

 private:
  explicit CutInspector(const CutStrategy& strategy) : strategy_(strategy) {}
  const LightTree& tree(bool distant) const;
  Cut cutFor(const CellCoordinates& cell) const;
  Cut cutFor(const Vec3& p) const;
  std::vector<ClusterInspection> clusters(const Cut& cut, const ShadingPoint& point) const;

  CutStrategy strategy_;
};

/// Levels between the root of a tree and a node.
int depthOf(const LightTree& tree, NodeId node);

}  // namespace cellcut
