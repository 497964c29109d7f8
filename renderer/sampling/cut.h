/// \file cut.h
/// A cut through the light trees for a region: the clusters that one light is chosen from there.
///
/// Source: Vévoda and Křivánek 2016 (estimates milder than bounds, relative threshold); the search: Walter et al. 2005,
/// section 3.
#pragma once

#include "renderer/lights/light_tree.h"
#include "renderer/sampling/cut_weights.h"
#include "renderer/sampling/sampler_settings.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace cellcut {

/// The light trees of a scene; either may be empty. Leaves are numbered through: local first, then distant.
struct LightTrees {
  explicit LightTrees(const Lights& lights);

  LightTree local;
  LightTree distant;
  LightId firstDistant;  ///< lights from this number on are distant

  TreeStatistics statistics() const;
  std::uint32_t leafCount() const { return static_cast<std::uint32_t>(local.leafCount() + distant.leafCount()); }
  std::size_t bytes() const { return local.bytes() + distant.bytes(); }

 private:
  LightTrees(const Lights& lights, int exponent, std::chrono::steady_clock::time_point start);
  double buildSeconds_;
};

struct CutSettings {
  float threshold;  ///< no cluster's estimate is above this share of the sum, if maxSize allows; [0, 1]
  int maxSize;      ///< most clusters in a cut, ≥ 2
};

/// A sphere that holds all points of a cell, or a single point.
struct Region {
  Vec3 centre;
  float radius;
};

/// One cluster as seen from a region.
struct Cluster {
  NodeId node;
  bool distant;                ///< of the distant tree
  float estimate;              ///< of the irradiance of a surface that faces it, in the trees' unit per m²; > 0
  float meanDistance;          ///< metres; infinite for distant clusters
  Vec3 direction;              ///< unit, from the region to the cluster
  float cosThetaU, sinThetaU;  ///< all directions from the region to the cluster are within θu of `direction`
};

/// Whether and how much a node can send to a region: estimate J · cos θ' / d̄², θ' the least angle to an emission axis,
/// d̄ a mean distance. Nothing only if no light of the node can reach any point of the region.
std::optional<Cluster> localCluster(const LightTree& tree, NodeId id, const Region& region);
Cluster distantCluster(const LightTree& tree, NodeId id);

/// Importance of a node at a point with unit normal n: its estimate there × receiverCosine. 0 only if no light of it can
/// contribute.
float nodeImportance(const LightTree& tree, bool distant, NodeId id, const Vec3& p, const Vec3& n);

/// Refines the largest estimate first, from the roots. The result is ordered by leaves, local clusters first, and is a
/// function of its arguments alone.
void findCut(const LightTrees& trees, const Region& region, const CutSettings& settings, std::vector<Cluster>& cut);

/// A cut in the form in which it is evaluated.
class Cut {
 public:
  Cut() = default;
  /// \param region  that the clusters were found for
  Cut(const LightTrees& trees, const Region& region, const std::vector<Cluster>& clusters);

  std::size_t size() const { return members_.size(); }
  const ClusterArrays& clusters() const { return clusters_; }

  /// A cluster of the cut, in the order of its leaves.
  struct Member {
    NodeId node;
    bool distant;
    std::uint32_t firstLeaf;  ///< numbered through both trees
    std::uint32_t slot;       ///< of its weight
  };
  const std::vector<Member>& members() const { return members_; }
  /// \pre the slot is one of a cluster and not of padding
  const Member& memberAt(std::size_t slot) const { return members_[memberOfSlot_[slot]]; }
  /// The cluster that holds a leaf (numbered through both trees); nothing when the leaf was dropped.
  const Member* memberOf(const LightTrees& trees, std::uint32_t leaf) const;
  std::size_t bytes() const;

 private:
  void cacheFar(const Cluster& cluster, std::size_t i);
  void cacheNear(const LightTreeNode& node, std::size_t i);

  ClusterArrays clusters_;
  std::vector<Member> members_;
  std::vector<std::uint16_t> memberOfSlot_;
};

}  // namespace cellcut
