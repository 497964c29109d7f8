/// \file descent.h
/// One light by a random walk down a light tree, child by child in proportion to an importance, and its exact
/// probability.
///
/// Source: Conty Estevez and Kulla 2018, section 5, without their splitting. An importance is a function of (tree,
/// distant, node), ≥ 0, in the trees' unit.
#pragma once

#include "renderer/sampling/cut.h"
#include "renderer/sampling/light_sampler.h"

namespace cellcut {

inline constexpr double kAlmostOne = 1 - 0x1p-53;

/// A leaf below `node`; nothing where no light can contribute.
template <class Importance>
std::optional<SampledLeaf> sampleByDescent(const LightTree& tree, bool distant, NodeId node,
                                           const Importance& importance, double u) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const double left = importance(tree, distant, tree.left(node)), right = importance(tree, distant, tree.right(node));
    if (!(left + right > 0)) return std::nullopt;
    const double toLeft = left / (left + right);
    if (u < toLeft) {
      u = std::min(u / toLeft, kAlmostOne);
      pmf *= toLeft;
      node = tree.left(node);
    } else {
      const double toRight = right / (left + right);
      u = std::min((u - toLeft) / toRight, kAlmostOne);
      pmf *= toRight;
      node = tree.right(node);
    }
  }
  return SampledLeaf{tree.node(node).firstLeaf(), pmf};
}

/// Probability of that walk to end at a leaf. \pre it is below the node
template <class Importance>
double pmfByDescent(const LightTree& tree, bool distant, NodeId node, const Importance& importance,
                    std::uint32_t leaf) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const double left = importance(tree, distant, tree.left(node)), right = importance(tree, distant, tree.right(node));
    if (!(left + right > 0)) return 0;
    const bool toLeft = leaf < tree.node(tree.right(node)).firstLeaf();
    pmf *= (toLeft ? left : right) / (left + right);
    node = toLeft ? tree.left(node) : tree.right(node);
  }
  return pmf;
}

/// The choice of one light of both trees at a point, from their roots.
template <class Importance>
class TreesDescent {
 public:
  TreesDescent(const LightTrees& trees, const Importance& importance) : trees_(trees), importance_(importance) {
    if (!trees.local.empty()) local_ = importance(trees.local, false, trees.local.root());
    if (kCanHaveDistantLights && !trees.distant.empty())
      distant_ = importance(trees.distant, true, trees.distant.root());
  }

  /// Importance of both roots; 0: no light can contribute.
  double sum() const { return local_ + distant_; }

  /// \pre sum() > 0
  std::optional<SampledLight> sample(double u) const {
    const double toLocal = local_ / sum();
    const bool distant = !(u < toLocal);
    const double share = distant ? distant_ / sum() : toLocal;
    const LightTree& tree = trees_.of(distant);
    const double rest = std::min((distant ? u - toLocal : u) / share, kAlmostOne);
    const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, tree.root(), importance_, rest);
    if (!leaf) return std::nullopt;
    return sampledLight(tree.light(leaf->leaf), share * leaf->pmf);
  }

  /// \pre sum() > 0
  double pmf(bool distant, std::uint32_t leaf) const {
    const LightTree& tree = trees_.of(distant);
    return (distant ? distant_ : local_) / sum() * pmfByDescent(tree, distant, tree.root(), importance_, leaf);
  }

 private:
  const LightTrees& trees_;
  Importance importance_;
  double local_ = 0, distant_ = 0;
};

/// Importance for a surface that scatters evenly.
struct DiffuseImportance {
  const ShadingPoint& point;
  double operator()(const LightTree& tree, bool distant, NodeId node) const {
    return static_cast<double>(nodeImportance(tree, distant, node, point.p, point.n));
  }
};

}  // namespace cellcut
