#include "renderer/sampling/cut_choice.h"

#include <array>
#include <cassert>

namespace cellcut {
namespace {

constexpr double kAlmostOne = 1 - 0x1p-53;

/// Weights of a cut at a point; on the stack, no allocation.
struct Weights {
  alignas(64) std::array<float, static_cast<std::size_t>(kMaxCutSize) + 2 * kClusterBlock> weight;
  std::array<float, static_cast<std::size_t>(kMaxCutSize) / kClusterBlock + 2> blockSum;
  double sum;

  Weights(const Cut& cut, const ShadingPoint& point)
      : sum(clusterWeights(cut.clusters(), point.p, point.n, weight.data(), blockSum.data())) {
    assert(cut.size() <= weight.size());
  }
};

/// Position of the element of `weights` that holds target ∈ [0, Σ); `target` becomes the uniform number that is left.
/// Elements of weight 0 are never returned. \pre Σ > 0
std::size_t choose(std::span<const float> weights, double& target) {
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto weight = static_cast<double>(weights[i]);
    if (!(weight > 0)) continue;
    chosen = i;
    if (target < weight) break;
    target -= weight;
  }
  target = std::min(target / static_cast<double>(weights[chosen]), kAlmostOne);
  return chosen;
}

/// Two steps: a block by the sums that SIMD gave, then a cluster by their exact sum, so that rounding loses none.
std::size_t chooseCluster(const Weights& w, std::size_t blocks, double& u) {
  u *= w.sum;
  const std::size_t block = choose({w.blockSum.data(), blocks}, u);
  const std::span<const float> inBlock(w.weight.data() + block * kClusterBlock, kClusterBlock);
  double sum = 0;
  for (const float weight : inBlock) sum += static_cast<double>(weight);
  u *= sum;
  return block * kClusterBlock + choose(inBlock, u);
}

const LightTree& treeOf(const LightTrees& trees, bool distant) {
  return distant ? trees.distant : trees.local;
}

}  // namespace

std::optional<SampledLeaf> sampleByDescent(const LightTree& tree, bool distant, NodeId node, const ShadingPoint& point,
                                           double u) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const auto left = static_cast<double>(nodeImportance(tree, distant, tree.left(node), point.p, point.n));
    const auto right = static_cast<double>(nodeImportance(tree, distant, tree.right(node), point.p, point.n));
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

double pmfByDescent(const LightTree& tree, bool distant, NodeId node, const ShadingPoint& point, std::uint32_t leaf) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const auto left = static_cast<double>(nodeImportance(tree, distant, tree.left(node), point.p, point.n));
    const auto right = static_cast<double>(nodeImportance(tree, distant, tree.right(node), point.p, point.n));
    if (!(left + right > 0)) return 0;
    const bool toLeft = leaf < tree.node(tree.right(node)).firstLeaf();
    pmf *= (toLeft ? left : right) / (left + right);
    node = toLeft ? tree.left(node) : tree.right(node);
  }
  return pmf;
}

std::optional<SampledLight> sampleCut(const LightTrees& trees, const Cut& cut, InCluster inCluster,
                                      const ShadingPoint& point, double u) {
  if (cut.size() == 0) return std::nullopt;
  const Weights w(cut, point);
  if (!(w.sum > 0)) return std::nullopt;
  const std::size_t slot = chooseCluster(w, cut.clusters().blocks(), u);
  const double pmf = static_cast<double>(w.weight[slot]) / w.sum;
  const Cut::Member& member = cut.memberAt(slot);
  const NodeId node = member.node;
  const bool distant = member.distant;
  const LightTree& tree = treeOf(trees, distant);
  if (inCluster == InCluster::kDescent) {
    const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, node, point, u);
    if (!leaf) return std::nullopt;
    return SampledLight{tree.light(leaf->leaf), static_cast<float>(pmf * leaf->pmf)};
  }
  if (tree.isLeaf(node)) return SampledLight{tree.light(tree.node(node).firstLeaf()), static_cast<float>(pmf)};
  const std::uint32_t leaf = tree.sampleByIntensity(node, u);
  return SampledLight{tree.light(leaf), static_cast<float>(pmf * tree.pmfByIntensity(node, leaf))};
}

float pmfInCut(const LightTrees& trees, const Cut& cut, InCluster inCluster, const ShadingPoint& point, LightId light) {
  const bool distant = static_cast<std::uint32_t>(light) >= static_cast<std::uint32_t>(trees.firstDistant);
  const LightTree& tree = treeOf(trees, distant);
  const std::uint32_t leaf = tree.leafOf(light);
  if (leaf == LightTree::kNoLeaf) return 0;
  const auto offset = distant ? static_cast<std::uint32_t>(trees.local.leafCount()) : 0u;
  const Cut::Member* member = cut.memberOf(trees, leaf + offset);
  if (!member) return 0;
  const Weights w(cut, point);
  if (!(w.sum > 0)) return 0;
  const double pmf = static_cast<double>(w.weight[member->slot]) / w.sum;
  const NodeId node = member->node;
  const double inside = inCluster == InCluster::kDescent ? pmfByDescent(tree, distant, node, point, leaf)
                                                         : tree.pmfByIntensity(node, leaf);
  return static_cast<float>(pmf * inside);
}

}  // namespace cellcut
