#include "renderer/sampling/cut_choice.h"

#include <array>
#include <cassert>

namespace cellcut {
namespace {

constexpr double kAlmostOne = 1 - 0x1p-53;

/// Weights of the near clusters at a point; on the stack, no allocation.
struct NearWeights {
  alignas(64) std::array<float, static_cast<std::size_t>(kMaxCutSize) + kClusterBlock> weight;
  std::array<float, static_cast<std::size_t>(kMaxCutSize) / kClusterBlock + 1> blockSum;
  double sum = 0;

  NearWeights(const Cut& cut, const ShadingPoint& point) {
    assert(cut.near().size() <= static_cast<std::size_t>(kMaxCutSize));
    if (cut.near().size() > 0) sum = nearWeights(cut.near(), point.p, point.n, weight.data(), blockSum.data());
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
/// \param u  in [0, 1); becomes the uniform number that is left
std::size_t chooseNear(const NearWeights& w, std::size_t blocks, double& u) {
  u *= w.sum;
  const std::size_t block = choose({w.blockSum.data(), blocks}, u);
  const std::span<const float> inBlock(w.weight.data() + block * kClusterBlock, kClusterBlock);
  double sum = 0;
  for (const float weight : inBlock) sum += static_cast<double>(weight);
  u *= sum;
  return block * kClusterBlock + choose(inBlock, u);
}

/// The weights of all clusters of a cut at a point.
struct CutWeights {
  NearWeights near;
  double sum;
  double toFar;  ///< probability of the far clusters together

  CutWeights(const Cut& cut, const FarChoice& far, const ShadingPoint& point)
      : near(cut, point), sum(far.sum() + near.sum), toFar(sum > 0 ? far.sum() / sum : 0) {}
  double farPmf(const FarChoice& far, std::size_t i) const { return static_cast<double>(far.table().pmf(i)) * toFar; }
  double nearPmf(std::size_t i) const { return static_cast<double>(near.weight[i]) / sum; }
  /// Probability of a member. \pre sum > 0
  double pmf(const Cut& cut, const FarChoice& far, std::size_t member) const {
    return member < cut.farCount() ? farPmf(far, member) : nearPmf(member - cut.farCount());
  }
};

const LightTree& treeOf(const LightTrees& trees, bool distant) {
  return distant ? trees.distant : trees.local;
}

/// Most lights of a cluster that is descended into. The nodes of larger ones are seldom in a cache: with 10⁶ lights
/// choosing by intensity gives 14 % more noise in two thirds of the time.
constexpr std::uint32_t kMaxDescentLights = 64;

bool descends(InCluster inCluster, const LightTree& tree, NodeId node) {
  return inCluster == InCluster::kDescent && tree.node(node).leafCount() <= kMaxDescentLights;
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

std::optional<SampledLight> sampleCut(const LightTrees& trees, const Cut& cut, const FarChoice& far,
                                      InCluster inCluster, const ShadingPoint& point, double u) {
  const CutWeights w(cut, far, point);
  if (!(w.sum > 0)) return std::nullopt;
  std::size_t chosen;
  double pmf;
  if (u < w.toFar) {
    const AliasTable::Sample sample = far.table().sample(std::min(u / w.toFar, kAlmostOne));
    chosen = sample.index;
    u = sample.rest;
    pmf = w.farPmf(far, chosen);
  } else {
    u = std::min((u - w.toFar) / (w.near.sum / w.sum), kAlmostOne);
    const std::size_t i = chooseNear(w.near, cut.near().blocks(), u);
    chosen = cut.farCount() + i;
    pmf = w.nearPmf(i);
  }
  const auto [node, distant, firstLeaf, estimate] = cut.members()[chosen];
  const LightTree& tree = treeOf(trees, distant);
  if (descends(inCluster, tree, node)) {
    const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, node, point, u);
    if (!leaf) return std::nullopt;
    return SampledLight{tree.light(leaf->leaf), static_cast<float>(pmf * leaf->pmf)};
  }
  const SampledLeaf leaf = tree.sampleByIntensity(node, u);
  return SampledLight{tree.light(leaf.leaf), static_cast<float>(pmf * leaf.pmf)};
}

float pmfInCut(const LightTrees& trees, const Cut& cut, const FarChoice& far, InCluster inCluster,
               const ShadingPoint& point, LightId light) {
  const bool distant = static_cast<std::uint32_t>(light) >= static_cast<std::uint32_t>(trees.firstDistant);
  const LightTree& tree = treeOf(trees, distant);
  const std::uint32_t leaf = tree.leafOf(light);
  if (leaf == LightTree::kNoLeaf) return 0;
  const auto offset = distant ? static_cast<std::uint32_t>(trees.local.leafCount()) : 0u;
  const std::optional<std::size_t> member = cut.memberOf(trees, leaf + offset);
  if (!member) return 0;
  const CutWeights w(cut, far, point);
  if (!(w.sum > 0)) return 0;
  const double pmf = w.pmf(cut, far, *member);
  const NodeId node = cut.members()[*member].node;
  const double inside = descends(inCluster, tree, node) ? pmfByDescent(tree, distant, node, point, leaf)
                                                        : tree.pmfByIntensity(node, leaf);
  return static_cast<float>(pmf * inside);
}

std::vector<double> clusterPmfs(const Cut& cut, const FarChoice& far, const ShadingPoint& point) {
  std::vector<double> pmfs(cut.size());
  const CutWeights w(cut, far, point);
  if (!(w.sum > 0)) return pmfs;
  for (std::size_t i = 0; i < pmfs.size(); ++i) pmfs[i] = w.pmf(cut, far, i);
  return pmfs;
}

}  // namespace cellcut
