#include "renderer/sampling/cluster.h"

#include <algorithm>
#include <limits>

namespace cellcut {
namespace {

/// A light of a cluster is taken to be no nearer than this share of the cluster's radius.
constexpr float kLeastShare = 0.05f;

}  // namespace

std::optional<Cluster> localCluster(const LightTree& tree, NodeId id, const Region& region) {
  const LightTreeNode& node = tree.node(id);
  const Vec3 centre = centreOf(node);
  const float clusterRadius = radiusOf(node, centre);
  const Vec3 toCluster = centre - region.centre;
  const float distance = glm::length(toCluster);
  const float reach = (region.radius + clusterRadius) * kReachMargin;

  Cluster cluster{id, false, 0, 0, 0, Vec3(0, 0, 1), -1, 0};
  float cosine = 1;
  if (reach < distance) {
    const float perDistance = 1 / distance;
    cluster.direction = toCluster * perDistance;
    cluster.sinThetaU = reach * perDistance;
    cluster.cosThetaU = safeSqrt(1 - cluster.sinThetaU * cluster.sinThetaU);
    const Cone axes = node.axes();
    float cosTheta = -glm::dot(axes.axis, cluster.direction);
    if (node.twoSided()) cosTheta = std::abs(cosTheta);
    const float sinTheta = sineAbove(cosTheta);
    const float cosPastAxes = cosSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    const float sinPastAxes = sinSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    cosine = cosSubClamped(cosPastAxes, sinPastAxes, cluster.cosThetaU, cluster.sinThetaU);
    if (cosine < node.cosThetaE() - kCosineMargin) return std::nullopt;
    cosine = std::max(cosine, kCosineMargin);
  }
  const float rho =
      region.radius == 0 ? clusterRadius : std::sqrt(region.radius * region.radius + clusterRadius * clusterRadius);
  const float mean = meanDistance(distance, rho);
  cluster.meanDistance = mean;
  cluster.leastDistance = std::max({distance - clusterRadius, region.radius, kLeastShare * clusterRadius});
  // A point light at the point itself has no finite estimate: it is kept, and found to send nothing when it is sampled.
  cluster.estimate = mean > 0 ? std::min(node.intensity() * cosine / mean / mean, kMaxWeight) : node.intensity();
  // Too faint or too far for a float to hold: 0 would say that it cannot reach the region.
  if (!(cluster.estimate > 0)) cluster.estimate = std::numeric_limits<float>::min();
  return cluster;
}

Cluster distantCluster(const LightTree& tree, NodeId id) {
  const LightTreeNode& node = tree.node(id);
  const Cone axes = node.axes();
  return {id, true, node.intensity(), kInfinity, kInfinity, -axes.axis, axes.cosTheta, axes.sinTheta};
}

}  // namespace cellcut
