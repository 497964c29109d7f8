#include "renderer/sampling/inspection.h"

#include "renderer/sampling/facing.h"
#include "renderer/sampling/mirrored_lights.h"

namespace cellcut {

int depthOf(const LightTree& tree, NodeId node) {
  // Nodes lie in depth-first order: all below a left child come before the right one.
  int depth = 0;
  for (NodeId at = tree.root(); at != node; ++depth) at = node < tree.right(at) ? tree.left(at) : tree.right(at);
  return depth;
}

std::optional<CutInspector> CutInspector::of(const LightSampler& sampler) {
  const std::optional<CutStrategy> strategy = sampler.cutStrategy();
  if (!strategy) return std::nullopt;
  return CutInspector(*strategy);
}

const LightTree& CutInspector::tree(bool distant) const {
  return strategy_.trees->of(distant);
}

std::optional<CellCoordinates> CutInspector::cellOf(const Vec3& p, bool indirect) const {
  return strategy_.grid ? strategy_.grid->cellOf(p, indirect) : std::nullopt;
}

const Cut* CutInspector::find(const CellCoordinates& cell) const {
  return strategy_.cells ? strategy_.cells->find(cell) : nullptr;
}

Cut CutInspector::cutFor(const CellCoordinates& cell) const {
  return makeCut(*strategy_.trees, strategy_.grid->region(cell), cutSettingsOf(strategy_.settings, cell));
}

Cut CutInspector::cutFor(const Vec3& p) const {
  return makeCut(*strategy_.trees, {p, 0}, {strategy_.settings.threshold, strategy_.settings.maxCut});
}

void CutInspector::forEachCell(const std::function<void(const CellCoordinates&, const Cut&)>& visit) const {
  if (strategy_.cells) strategy_.cells->forEach(visit);
}

CutSummary CutInspector::summary(const Cut& cut) const {
  CutSummary summary{.visits = cut.visits(), .size = cut.size()};
  for (const Cut::Member& m : cut.members()) {
    summary.estimate += std::ldexp(static_cast<double>(m.estimate), strategy_.trees->exponent);
    summary.depth = std::max(summary.depth, depthOf(tree(m.distant), m.node));
  }
  return summary;
}

CutSummary CutInspector::summaryOfPoint(const Vec3& p) const {
  return summary(cutFor(p));
}

CutSummary CutInspector::summaryOfCell(const CellCoordinates& cell) const {
  return summary(cutFor(cell));
}

std::vector<ClusterInspection> CutInspector::clusters(const Cut& cut, const ShadingPoint& point) const {
  const std::size_t facing = facingOf(point.n);
  const FarChoice* kept = cut.farCount() > 0 ? cut.farChoice(facing) : nullptr;
  const std::vector<double> pmfs =
      kept ? clusterPmfs(cut, *kept, point) : clusterPmfs(cut, cut.makeFarChoice(facing), point);
  std::vector<ClusterInspection> clusters;
  clusters.reserve(cut.size());
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Cut::Member& m = cut.members()[i];
    const LightTreeNode& node = tree(m.distant).node(m.node);
    ClusterInspection c{.node = m.node,
                        .distant = m.distant,
                        .far = i < cut.farCount(),
                        .lightCount = node.leafCount(),
                        .box = {},
                        .directions = {},
                        .depth = depthOf(tree(m.distant), m.node),
                        .estimate = std::ldexp(static_cast<double>(m.estimate), strategy_.trees->exponent),
                        .probability = pmfs[i]};
    if (m.distant) {
      const Cone axes = node.axes();
      c.directions = {-axes.axis, axes.cosTheta, axes.sinTheta};
    } else {
      c.box = {node.lower(), node.upper()};
    }
    clusters.push_back(c);
  }
  return clusters;
}

CutInspection CutInspector::inspect(const ShadingPoint& point) const {
  CutInspection result;
  result.cell = cellOf(point.p, point.indirect);
  if (!result.cell) {
    result.clusters = clusters(cutFor(point.p), point);
    return result;
  }
  result.cellBox = strategy_.grid->box(*result.cell);
  if (const Cut* cut = find(*result.cell)) {
    result.kept = true;
    result.visits = cut->visits();
    result.clusters = clusters(*cut, point);
  } else {
    result.clusters = clusters(cutFor(*result.cell), point);
  }
  return result;
}

double CutInspector::mirroredShare(const ShadingPoint& point) const {
  return MirroredLights(*strategy_.trees, point).share();
}

std::vector<LightId> CutInspector::lights(const ClusterInspection& cluster) const {
  const LightTree& t = tree(cluster.distant);
  std::vector<LightId> lights(t.node(cluster.node).leafCount());
  for (std::uint32_t i = 0; i < lights.size(); ++i) lights[i] = t.light(t.firstLeaf(cluster.node) + i);
  return lights;
}

}  // namespace cellcut
