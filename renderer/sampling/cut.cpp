#include "renderer/sampling/cut.h"

#include <algorithm>

namespace cellcut {
namespace {

/// A cluster is near when the cell's radius is more than this share of their mean distance: then its distance and the
/// side that it shows vary over the cell.
constexpr float kNearShare = 0.3f;

/// A region that is one point, known to be one when the code is compiled: the inner loop of every descent.
struct PointRegion {
  const Vec3& centre;
  static constexpr float radius = 0;
};

/// localCluster() into `cluster`, of which only the node is set so far; false: nothing.
template <class AnyRegion>
inline bool estimateLocal(const LightTreeNode& node, const AnyRegion& region, Cluster& cluster) {
  const Vec3 halfDiagonal = 0.5f * node.upper() - 0.5f * node.lower();
  const float clusterRadius = glm::length(halfDiagonal);
  const Vec3 toCluster = (0.5f * node.upper() + 0.5f * node.lower()) - region.centre;
  const float distance = glm::length(toCluster);
  const float reach = region.radius + clusterRadius;

  float cosine = 1;
  if (reach < distance) {
    const float perDistance = 1 / distance;
    cluster.direction = toCluster * perDistance;
    cluster.sinThetaU = reach * perDistance;
    cluster.cosThetaU = safeSqrt(1 - cluster.sinThetaU * cluster.sinThetaU);
    const Cone axes = node.axes();
    float cosTheta = -glm::dot(axes.axis, cluster.direction);
    if (node.twoSided()) cosTheta = std::abs(cosTheta);
    const float sinTheta = safeSqrt(1 - cosTheta * cosTheta);
    const float cosPastAxes = cosSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    const float sinPastAxes = sinSubClamped(cosTheta, sinTheta, axes.cosTheta, axes.sinTheta);
    cosine = cosSubClamped(cosPastAxes, sinPastAxes, cluster.cosThetaU, cluster.sinThetaU);
    if (cosine < node.cosThetaE() - kCosineMargin) return false;
    cosine = std::max(cosine, kCosineMargin);
  }
  const float rho =
      region.radius == 0 ? clusterRadius : std::sqrt(region.radius * region.radius + clusterRadius * clusterRadius);
  const float mean = meanDistance(distance, rho);
  cluster.meanDistance = mean;
  // A point light at the point itself has no finite estimate: it is kept, and found to send nothing when it is sampled.
  cluster.estimate = mean > 0 ? std::min(node.intensity() * cosine / mean / mean, std::numeric_limits<float>::max())
                              : node.intensity();
  if (!(cluster.estimate > 0)) cluster.estimate = std::numeric_limits<float>::min();
  return true;
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
  Cluster cluster{id, false, 0, 0, Vec3(0, 0, 1), -1, 0};
  if (!estimateLocal(tree.node(id), region, cluster)) return std::nullopt;
  return cluster;
}

Cluster distantCluster(const LightTree& tree, NodeId id) {
  const LightTreeNode& node = tree.node(id);
  const Cone axes = node.axes();
  return {id, true, node.intensity(), kInfinity, -axes.axis, axes.cosTheta, axes.sinTheta};
}

float nodeImportance(const LightTree& tree, bool distant, NodeId id, const Vec3& p, const Vec3& n) {
  Cluster cluster{id, false, 0, 0, Vec3(0, 0, 1), -1, 0};
  if (distant) {
    cluster = distantCluster(tree, id);
  } else if (!estimateLocal(tree.node(id), PointRegion{p}, cluster)) {
    return 0;
  }
  return cluster.estimate * receiverCosine(glm::dot(n, cluster.direction), cluster.cosThetaU, cluster.sinThetaU);
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

Cut::Cut(const LightTrees& trees, const Region& region, const std::vector<Cluster>& clusters) {
  const auto isNear = [&](const Cluster& c) { return !c.distant && region.radius > kNearShare * c.meanDistance; };
  const auto nearCount = static_cast<std::size_t>(std::count_if(clusters.begin(), clusters.end(), isNear));
  clusters_.far = BlockedFloats(clusters.size() - nearCount, ClusterArrays::kFarFields);
  clusters_.near = BlockedFloats(nearCount, ClusterArrays::kNearFields);
  members_.reserve(clusters.size());
  memberOfSlot_.resize(clusters_.blocks() * kClusterBlock);
  const auto localLeaves = static_cast<std::uint32_t>(trees.local.leafCount());
  std::size_t far = 0, near = 0;
  for (const Cluster& c : clusters) {
    const LightTreeNode& node = (c.distant ? trees.distant : trees.local).node(c.node);
    std::size_t slot;
    if (isNear(c)) {
      slot = clusters_.nearSlot(near);
      cacheNear(node, near++);
    } else {
      slot = far;
      cacheFar(c, far++);
    }
    memberOfSlot_[slot] = static_cast<std::uint16_t>(members_.size());
    members_.push_back(
        {c.node, c.distant, node.firstLeaf() + (c.distant ? localLeaves : 0), static_cast<std::uint32_t>(slot)});
  }
}

void Cut::cacheFar(const Cluster& c, std::size_t i) {
  const auto set = [&](ClusterArrays::FarField field, float value) { clusters_.far.field(field)[i] = value; };
  set(ClusterArrays::kEstimate, c.estimate);
  set(ClusterArrays::kDirectionX, c.direction.x);
  set(ClusterArrays::kDirectionY, c.direction.y);
  set(ClusterArrays::kDirectionZ, c.direction.z);
  set(ClusterArrays::kCosThetaU, c.cosThetaU);
  set(ClusterArrays::kSinThetaU, c.sinThetaU);
}

void Cut::cacheNear(const LightTreeNode& node, std::size_t i) {
  const auto set = [&](ClusterArrays::NearField field, float value) { clusters_.near.field(field)[i] = value; };
  const Vec3 centre = 0.5f * node.upper() + 0.5f * node.lower();
  const Cone axes = node.axes();
  set(ClusterArrays::kCentreX, centre.x);
  set(ClusterArrays::kCentreY, centre.y);
  set(ClusterArrays::kCentreZ, centre.z);
  set(ClusterArrays::kRadius, glm::length(0.5f * node.upper() - 0.5f * node.lower()));
  set(ClusterArrays::kIntensity, node.intensity());
  set(ClusterArrays::kAxisX, axes.axis.x);
  set(ClusterArrays::kAxisY, axes.axis.y);
  set(ClusterArrays::kAxisZ, axes.axis.z);
  set(ClusterArrays::kCosThetaO, axes.cosTheta);
  set(ClusterArrays::kSinThetaO, axes.sinTheta);
  set(ClusterArrays::kCosThetaE, node.cosThetaE());
  set(ClusterArrays::kTwoSided, node.twoSided() ? 1.0f : 0.0f);
}

const Cut::Member* Cut::memberOf(const LightTrees& trees, std::uint32_t leaf) const {
  const auto after = std::upper_bound(members_.begin(), members_.end(), leaf,
                                      [](std::uint32_t l, const Member& m) { return l < m.firstLeaf; });
  if (after == members_.begin()) return nullptr;
  const Member& member = *(after - 1);
  const LightTree& tree = member.distant ? trees.distant : trees.local;
  return leaf - member.firstLeaf < tree.node(member.node).leafCount() ? &member : nullptr;
}

std::size_t Cut::bytes() const {
  return sizeof(Cut) + clusters_.far.bytes() + clusters_.near.bytes() + members_.capacity() * sizeof(Member) +
         memberOfSlot_.capacity() * sizeof(std::uint16_t);
}

}  // namespace cellcut
