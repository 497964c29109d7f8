#include "renderer/sampling/cut.h"

#include <algorithm>

namespace cellcut {
namespace {

/// A smooth mean distance between two spheres whose centres are D apart: 0.75 ρ at D = 0, D far away.
/// \param rho  √(r² + r_C²)
float meanDistance(float distance, float rho) {
  if (rho == 0) return distance;
  const float q = rho / (distance + 1.1547f * rho);
  return distance + rho * q * q;
}

}  // namespace

LightTrees::LightTrees(const Lights& lights)
    : LightTrees(lights, intensityExponent(lights), std::chrono::steady_clock::now()) {}

LightTrees::LightTrees(const Lights& lights, int exponent, std::chrono::steady_clock::time_point start)
    : local(localBounds(lights, exponent), LightId{0}, false),
      distant(distantBounds(lights, exponent), lights.idOf(LightKind::kDirectional, 0), true),
      firstDistant(lights.idOf(LightKind::kDirectional, 0)),
      buildSeconds_(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()) {}

TreeStatistics LightTrees::statistics() const {
  return {local.nodes().size() + distant.nodes().size(), std::max(local.depth(), distant.depth()), buildSeconds_,
          bytes()};
}

std::optional<Cluster> localCluster(const LightTree& tree, NodeId id, const Region& region) {
  const LightTreeNode& node = tree.node(id);
  const Vec3 halfDiagonal = 0.5f * node.upper() - 0.5f * node.lower();
  const float clusterRadius = glm::length(halfDiagonal);
  const Vec3 toCluster = (0.5f * node.upper() + 0.5f * node.lower()) - region.centre;
  const float distance = glm::length(toCluster);
  const float reach = region.radius + clusterRadius;

  Cluster cluster{id, false, 0, Vec3(0, 0, 1), -1, 0};
  float cosine = 1;
  if (reach < distance) {
    cluster.direction = toCluster / distance;
    cluster.sinThetaU = reach / distance;
    cluster.cosThetaU = safeSqrt(1 - cluster.sinThetaU * cluster.sinThetaU);
    const Cone axes = node.axes();
    float cosTheta = -glm::dot(axes.axis, cluster.direction);
    if (node.twoSided()) cosTheta = std::abs(cosTheta);
    const float sinTheta = safeSqrt(1 - cosTheta * cosTheta);
    const float cosPastAxes = cosSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    const float sinPastAxes = sinSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    cosine = cosSubClamped(cosPastAxes, sinPastAxes, cluster.cosThetaU, cluster.sinThetaU);
    if (cosine < node.cosThetaE() - kCosineMargin) return std::nullopt;
    cosine = std::max(cosine, kCosineMargin);
  }
  const float rho = std::sqrt(region.radius * region.radius + clusterRadius * clusterRadius);
  const float mean = meanDistance(distance, rho);
  // A point light at the point itself has no finite estimate: it is kept, and found to send nothing when it is sampled.
  cluster.estimate = mean > 0 ? std::min(node.intensity() * cosine / mean / mean, std::numeric_limits<float>::max())
                              : node.intensity();
  if (!(cluster.estimate > 0)) cluster.estimate = std::numeric_limits<float>::min();
  return cluster;
}

Cluster distantCluster(const LightTree& tree, NodeId id) {
  const LightTreeNode& node = tree.node(id);
  const Cone axes = node.axes();
  return {id, true, node.intensity(), -axes.axis, axes.cosTheta, axes.sinTheta};
}

namespace {

/// The search's state: all clusters seen so far, a heap of those that may still be split, and those that are lights.
class CutSearch {
 public:
  CutSearch(const LightTrees& trees, const Region& region, const CutSettings& settings)
      : trees_(trees), region_(region), settings_(settings) {
    const auto most = 2 * static_cast<std::size_t>(settings.maxSize);
    seen_.reserve(most);
    open_.reserve(most);
    if (!trees.local.empty()) add(false, trees.local.root());
    if (!trees.distant.empty()) add(true, trees.distant.root());
  }

  void refine() {
    const auto maxSize = static_cast<std::size_t>(settings_.maxSize);
    while (!open_.empty() && open_.size() + leaves_.size() < maxSize &&
           static_cast<double>(open_.front().estimate) > static_cast<double>(settings_.threshold) * sum_) {
      std::pop_heap(open_.begin(), open_.end());
      const Cluster parent = seen_[open_.back().cluster];
      open_.pop_back();
      sum_ -= static_cast<double>(parent.estimate);
      const LightTree& tree = parent.distant ? trees_.distant : trees_.local;
      add(parent.distant, tree.left(parent.node));
      add(parent.distant, tree.right(parent.node));
    }
  }

  void take(std::vector<Cluster>& cut) const {
    cut.clear();
    for (const Candidate& c : open_) cut.push_back(seen_[c.cluster]);
    for (const std::uint32_t leaf : leaves_) cut.push_back(seen_[leaf]);
    std::sort(cut.begin(), cut.end(), [](const Cluster& a, const Cluster& b) {
      // Nodes are numbered in depth-first order, and no node of a cut is inside another.
      return std::pair(a.distant, a.node) < std::pair(b.distant, b.node);
    });
  }

 private:
  struct Candidate {
    float estimate;
    std::uint32_t cluster;
    /// Equal estimates are told apart, so that the cut does not depend on how a heap is built.
    bool operator<(const Candidate& other) const {
      return estimate != other.estimate ? estimate < other.estimate : cluster > other.cluster;
    }
  };

  void add(bool distant, NodeId node) {
    const LightTree& tree = distant ? trees_.distant : trees_.local;
    const std::optional<Cluster> cluster =
        distant ? std::optional(distantCluster(tree, node)) : localCluster(tree, node, region_);
    if (!cluster) return;
    const auto index = static_cast<std::uint32_t>(seen_.size());
    seen_.push_back(*cluster);
    sum_ += static_cast<double>(cluster->estimate);
    if (tree.isLeaf(node)) {
      leaves_.push_back(index);
    } else {
      open_.push_back({cluster->estimate, index});
      std::push_heap(open_.begin(), open_.end());
    }
  }

  const LightTrees& trees_;
  const Region& region_;
  const CutSettings& settings_;
  std::vector<Cluster> seen_;
  std::vector<Candidate> open_;
  std::vector<std::uint32_t> leaves_;
  double sum_ = 0;
};

}  // namespace

void findCut(const LightTrees& trees, const Region& region, const CutSettings& settings, std::vector<Cluster>& cut) {
  CutSearch search(trees, region, settings);
  search.refine();
  search.take(cut);
}

Cut::Cut(const LightTrees& trees, const std::vector<Cluster>& clusters) : clusters_(clusters.size()) {
  nodes_.reserve(clusters.size());
  firstLeaf_.reserve(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Cluster& c = clusters[i];
    clusters_.field(ClusterArrays::kEstimate)[i] = c.estimate;
    clusters_.field(ClusterArrays::kDirectionX)[i] = c.direction.x;
    clusters_.field(ClusterArrays::kDirectionY)[i] = c.direction.y;
    clusters_.field(ClusterArrays::kDirectionZ)[i] = c.direction.z;
    clusters_.field(ClusterArrays::kCosThetaU)[i] = c.cosThetaU;
    clusters_.field(ClusterArrays::kSinThetaU)[i] = c.sinThetaU;
    nodes_.push_back(c.node);
    const auto localLeaves = static_cast<std::uint32_t>(trees.local.leafCount());
    firstLeaf_.push_back(c.distant ? localLeaves + trees.distant.node(c.node).firstLeaf()
                                   : trees.local.node(c.node).firstLeaf());
    if (!c.distant) ++localCount_;
  }
}

std::optional<std::size_t> Cut::clusterOf(const LightTrees& trees, std::uint32_t leaf) const {
  const auto after = std::upper_bound(firstLeaf_.begin(), firstLeaf_.end(), leaf);
  if (after == firstLeaf_.begin()) return std::nullopt;
  const auto cluster = static_cast<std::size_t>(after - firstLeaf_.begin()) - 1;
  const LightTree& tree = isDistant(cluster) ? trees.distant : trees.local;
  if (leaf - firstLeaf_[cluster] >= tree.node(nodes_[cluster]).leafCount()) return std::nullopt;
  return cluster;
}

std::size_t Cut::bytes() const {
  return sizeof(Cut) + clusters_.bytes() + nodes_.capacity() * sizeof(NodeId) +
         firstLeaf_.capacity() * sizeof(std::uint32_t);
}

}  // namespace cellcut
