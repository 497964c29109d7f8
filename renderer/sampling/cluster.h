/// \file cluster.h
/// What a node of a light tree can send to a region or a point: the estimates that cuts and descents are made by.
///
/// In a header, because the descents' inner loop is made of it. Source of the estimate: Vévoda and Křivánek 2016; of the
/// angles: Conty Estevez and Kulla 2018, section 5.
#pragma once

#include "renderer/base/capabilities.h"
#include "renderer/lights/light_tree.h"
#include "renderer/sampling/cut_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cellcut {

/// A sphere that holds all points of a cell, or a single point.
struct Region {
  Vec3 centre;
  float radius;
};

/// One cluster as seen from a region.
struct Cluster {
  NodeId node;
  bool distant;         ///< of the distant tree
  float estimate;       ///< of the irradiance of a surface that faces it, in the trees' unit per m²; > 0
  float meanDistance;   ///< metres; infinite for distant clusters
  float leastDistance;  ///< about that of the nearest lights that it may hold, metres; infinite for distant clusters
  Vec3 direction;       ///< unit, from the region to the cluster
  float cosThetaU, sinThetaU;  ///< all directions from the region to the cluster are within θu of `direction`
};

/// A region that is one point, known to be one when the code is compiled.
struct PointRegion {
  const Vec3& centre;
  static constexpr float radius = 0;
};

inline Vec3 centreOf(const LightTreeNode& node) {
  return 0.5f * node.upper() + 0.5f * node.lower();
}

/// Radius around the centre as it was rounded: half the diagonal leaves out a corner by that rounding, which among
/// lights far from the origin is more than they are apart.
inline float radiusOf(const LightTreeNode& node, const Vec3& centre) {
  return glm::length(glm::max(node.upper() - centre, centre - node.lower()));
}

/// Whether and how much a node of the local tree can send to a region: estimate J · cos θ' / d̄², θ' the least angle to an
/// emission axis, d̄ a mean distance. Nothing only if no light of the node can reach any point of the region.
template <class AnyRegion>
std::optional<Cluster> localCluster(const LightTree& tree, NodeId id, const AnyRegion& region) {
  /// A light of a cluster is taken to be no nearer than this share of the cluster's radius.
  constexpr float kLeastShare = 0.05f;
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
  cluster.leastDistance =
      std::max({distance - clusterRadius, static_cast<float>(region.radius), kLeastShare * clusterRadius});
  // A point light at the point itself has no finite estimate: it is kept, and found to send nothing when it is sampled.
  cluster.estimate = mean > 0 ? std::min(node.intensity() * cosine / mean / mean, kMaxWeight) : node.intensity();
  if (!(cluster.estimate > 0)) cluster.estimate = std::numeric_limits<float>::min();
  return cluster;
}

inline Cluster distantCluster(const LightTree& tree, NodeId id) {
  const LightTreeNode& node = tree.node(id);
  const Cone axes = node.axes();
  return {id, true, node.intensity(), kInfinity, kInfinity, -axes.axis, axes.cosTheta, axes.sinTheta};
}

/// A node of either tree as seen from a point.
inline std::optional<Cluster> clusterAt(const LightTree& tree, bool distant, NodeId id, const Vec3& p) {
  if (kCanHaveDistantLights && distant) return distantCluster(tree, id);
  return localCluster(tree, id, PointRegion{p});
}

/// Importance of a node at a point with unit normal n: its estimate there × receiverCosine. 0 only if no light of it can
/// contribute.
inline float nodeImportance(const LightTree& tree, bool distant, NodeId id, const Vec3& p, const Vec3& n) {
  const std::optional<Cluster> cluster = clusterAt(tree, distant, id, p);
  if (!cluster) return 0;
  return cluster->estimate * receiverCosine(glm::dot(n, cluster->direction), cluster->cosThetaU, cluster->sinThetaU);
}

}  // namespace cellcut
