/// \file descent.h
/// One light by a random walk down a light tree in proportion to an importance, and its exact probability.
///
/// Source: Conty Estevez and Kulla 2018, section 5, without their splitting. A step goes down two levels: the up to
/// four nodes there are weighed together, with SIMD, and against each other, which takes less time and is a better
/// choice than child by child.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/sampling/cut.h"
#include "renderer/sampling/light_sampler.h"

namespace cellcut {

/// The importance of nodes at a point: their estimate there × receiverCosine, or where a lobe is given × how much of it
/// reflects, which has the cosine in it. 0 only if no light of the node can contribute.
struct NodeImportance {
  Vec3 p;  ///< metres
  Vec3 n;  ///< unit
  /// A GGX reflection: × π D(h) of the half vector h of wo and the direction to the node, with a lobe that is widened
  /// by what the node's extent turns h.
  struct Lobe {
    Vec3 wo;  ///< unit, world space
    float alpha2;
    float perSpread;  ///< a node that is seen within θu adds this × (1 − cos θu) to α²
  };
  std::optional<Lobe> lobe{};
};

/// In the trees' unit; not negative, and finite.
double importanceOf(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance);

/// A leaf below `node`; nothing where no light can contribute.
std::optional<SampledLeaf> sampleByDescent(const LightTree& tree, bool distant, NodeId node,
                                           const NodeImportance& importance, double u);

/// Probability of that walk to end at a leaf. \pre it is below the node
double pmfByDescent(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance,
                    std::uint32_t leaf);

/// The choice of one light of both trees at a point, from their roots.
class TreesDescent {
 public:
  TreesDescent(const LightTrees& trees, const NodeImportance& importance);

  /// Importance of both roots; 0: no light can contribute.
  double sum() const { return local_ + distant_; }
  /// \pre sum() > 0
  std::optional<SampledLight> sample(double u) const;
  /// \pre sum() > 0
  double pmf(bool distant, std::uint32_t leaf) const;

 private:
  const LightTrees& trees_;
  NodeImportance importance_;
  double local_ = 0, distant_ = 0;
};

}  // namespace cellcut
