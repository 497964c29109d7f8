/// \file cut.h
/// A cut through the light trees for a region: the clusters that one light is chosen from there.
///
/// Source: Vévoda and Křivánek 2016 (estimates milder than bounds, relative threshold); the search: Walter et al. 2005,
/// section 3.
#pragma once

#include "renderer/base/capabilities.h"
#include "renderer/base/stopwatch.h"
#include "renderer/sampling/cluster.h"
#include "renderer/sampling/discrete_cdf.h"
#include "renderer/sampling/sampler_settings.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cellcut {

/// The light trees of a scene; either may be empty. Leaves are numbered through: local first, then distant.
struct LightTrees {
  /// \param lights  outlive the trees
  explicit LightTrees(const Lights& lights);

  const Lights& lights;
  LightTree local;
  LightTree distant;
  LightId firstDistant;  ///< lights from this number on are distant
  int exponent;          ///< intensities and estimates are in units of 2^exponent W/sr and W/m²

  const LightTree& of(bool isDistant) const { return kCanHaveDistantLights && isDistant ? distant : local; }
  TreeStatistics statistics() const;
  std::size_t bytes() const { return local.bytes() + distant.bytes(); }

 private:
  LightTrees(const Lights& ofLights, int exponentOfUnit, const Stopwatch& build);
  double buildSeconds_;
};

/// Most of a choice that goes to distant lights where local ones can contribute, too. No estimate without visibility
/// knows of walls: in a closed room nearly all samples would go to the sun outside.
inline constexpr double kMostDistant = 7.0 / 8;

/// Probability that a choice among both trees goes to a distant light. \pre weights ≥ 0, not both 0
inline double distantShare(double local, double distant) {
  const double share = distant / (local + distant);
  return local > 0 ? std::min(share, kMostDistant) : share;
}

struct CutSettings {
  float threshold;  ///< no cluster's estimate is above this share of the choice, if maxSize allows; [0, 1]
  int maxSize;      ///< most clusters in a cut, ≥ 2
};

/// Refines first, from the roots, what may have the largest estimate if all its light is where it is nearest. The
/// result is ordered by leaves, local clusters first, and is a function of its arguments alone.
void findCut(const LightTrees& trees, const Region& region, const CutSettings& settings, std::vector<Cluster>& cut);

/// The far clusters of a cut as surfaces of one facing ask them: a choice that costs about the same for any number of
/// clusters.
class FarChoice {
 public:
  FarChoice() : FarChoice({}, {}) {}
  FarChoice(std::span<const double> distantWeights, std::span<const double> localWeights);

  /// Of one tree's far clusters.
  struct OfTree {
    DiscreteCdf cdf;
    double sum;  ///< of the weights
    explicit OfTree(std::span<const double> weights);
  };
  const OfTree& distant() const { return distant_; }
  const OfTree& local() const { return local_; }
  std::size_t bytes() const { return sizeof(FarChoice) + distant_.cdf.bytes() + local_.cdf.bytes(); }

 private:
  OfTree distant_, local_;
};

/// Counts from many threads. A copy starts at the same count: a cut is moved only before it is shared.
class VisitCount {
 public:
  VisitCount() = default;
  VisitCount(VisitCount&& other) noexcept : count_(other.get()) {}
  void add() { count_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t get() const { return count_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> count_{0};
};

/// A cut in the form in which it is evaluated. Far clusters have one estimate for all of the region, and one weight for
/// all of its surfaces of one facing; near ones are evaluated at the point, and large lights among them exactly.
class Cut {
 public:
  Cut() = default;
  /// \param region  that the clusters were found for; the local ones of a region that is a point are all near
  Cut(const LightTrees& trees, const Region& region, const std::vector<Cluster>& clusters);
  ~Cut();
  Cut(Cut&& other) noexcept;
  Cut& operator=(Cut&&) = delete;

  std::size_t size() const { return members_.size(); }
  std::size_t farCount() const { return far_.size(); }
  std::size_t distantCount() const { return distantCount_; }  ///< of the far ones
  const BlockedFloats& near() const { return near_; }
  /// A light so large for its distance that the bounds of its cluster say little: a few of them. Its row of near() has no
  /// weight.
  struct LargeLight {
    std::uint32_t near;       ///< its row
    TriangleEmitter emitter;  ///< in the trees' unit: only triangles have a size
  };
  const std::vector<LargeLight>& largeLights() const { return largeLights_; }

  /// A cluster of the cut.
  struct Member {
    NodeId node;
    bool distant : 1;
    std::uint32_t leafCount : 31;
    std::uint32_t firstLeaf;  ///< numbered through both trees
    float estimate;           ///< for the region
  };
  /// Distant ones first, then local far ones, each by falling estimate; then the near ones in the order of near(), which is
  /// that of their leaves.
  const std::vector<Member>& members() const { return members_; }
  /// Index of the cluster that holds a leaf (numbered through both trees); nothing when the leaf was dropped.
  std::optional<std::size_t> memberOf(std::uint32_t leaf) const;

  /// The weights of the far clusters for surfaces of one facing.
  FarChoice makeFarChoice(std::size_t facing) const;
  /// The choice that was kept for a facing, if any.
  const FarChoice* farChoice(std::size_t facing) const {
    return choices_ ? choices_[facing].load(std::memory_order_acquire) : nullptr;
  }
  struct Kept {
    const FarChoice* choice;
    bool isNew;  ///< the one that was given
  };
  /// Keeps a choice, unless another thread was first. \pre farCount() > 0
  Kept keep(std::size_t facing, FarChoice choice) const;

  /// Lights that were asked for from this cut, where SamplerSettings::countVisits wants them counted.
  std::uint64_t visits() const { return visits_.get(); }
  void countVisit() const { visits_.add(); }

  std::size_t bytes() const;

 private:
  /// What the weight of a far cluster is made of.
  struct Far {
    float estimate;
    Vec3 meanDirection;  ///< of the directions within θu: shorter than 1, and 0 for a cluster all around the cell
    float cosThetaU, sinThetaU;
  };
  void addNear(const LightTreeNode& node, std::size_t i);

  std::vector<Far> far_;
  std::size_t distantCount_ = 0;
  BlockedFloats near_;
  std::vector<LargeLight> largeLights_;
  std::vector<Member> members_;
  std::vector<std::uint16_t> farByLeaf_;  ///< members in the order of their leaves
  /// One per facing, made when a surface of that facing asks: a cache of a deterministic function.
  std::unique_ptr<std::atomic<const FarChoice*>[]> choices_;
  mutable VisitCount visits_;
};

/// The cut that findCut finds for a region, ready to be evaluated.
Cut makeCut(const LightTrees& trees, const Region& region, const CutSettings& settings);

}  // namespace cellcut
