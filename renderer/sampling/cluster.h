/// \file cluster.h
/// What a node of a light tree can send to a region: the estimates that cuts are made by.
///
/// Source of the estimate: Vévoda and Křivánek 2016; of the angles: Conty Estevez and Kulla 2018, section 5.
#pragma once

#include "renderer/lights/light_tree.h"
#include "renderer/sampling/cut_weights.h"

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

inline Vec3 centreOf(const LightTreeNode& node) {
  return 0.5f * node.upper() + 0.5f * node.lower();
}

/// Radius around the centre as it was rounded: half the diagonal leaves out a corner by that rounding, which among
/// lights far from the origin is more than they are apart.
inline float radiusOf(const LightTreeNode& node, const Vec3& centre) {
  return glm::length(glm::max(node.upper() - centre, centre - node.lower()));
}

/// Whether and how much a node of the local tree can send to a region: estimate J · cos θ' / d̄², θ' the least angle to
/// an emission axis, d̄ a mean distance. Nothing only if no light of the node can reach any point of the region.
std::optional<Cluster> localCluster(const LightTree& tree, NodeId id, const Region& region);
/// A node of the distant tree: the same from everywhere.
Cluster distantCluster(const LightTree& tree, NodeId id);

}  // namespace cellcut
