#include "renderer/sampling/cut.h"

#include "renderer/sampling/facing.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace cellcut {
namespace {

/// A cluster is near when the cell's radius is more than this share of their mean distance: then its distance and the
/// side that it shows vary over the cell.
constexpr float kNearShare = 0.3f;

/// All clusters of a cut that has no more are near: one block of them is weighed as fast as one cluster.
constexpr std::size_t kFewClusters = kClusterBlock;

}  // namespace

LightTrees::LightTrees(const Lights& ofLights) : LightTrees(ofLights, intensityExponent(ofLights), Stopwatch()) {}

LightTrees::LightTrees(const Lights& ofLights, int exponentOfUnit, const Stopwatch& build)
    : lights(ofLights),
      local(localBounds(lights, exponentOfUnit), LightId{0}, false),
      distant(distantBounds(lights, exponentOfUnit), lights.idOf(LightKind::kDirectional, 0), true),
      firstDistant(lights.idOf(LightKind::kDirectional, 0)),
      exponent(exponentOfUnit),
      buildSeconds_(build.seconds()) {}

TreeStatistics LightTrees::statistics() const {
  return {local.nodes().size() + distant.nodes().size(), std::max(local.depth(), distant.depth()), buildSeconds_,
          bytes()};
}

namespace {

/// The search's state: all clusters seen so far, for each tree a heap of those that may still be split, and those that
/// are lights.
class CutSearch {
 public:
  CutSearch(const LightTrees& trees, const Region& region, const CutSettings& settings)
      : trees_(trees), region_(region), settings_(settings) {
    const auto most = 2 * static_cast<std::size_t>(settings.maxSize);
    seen_.reserve(most);
    if (!trees.local.empty()) add(false, trees.local.root());
    if (!trees.distant.empty()) add(true, trees.distant.root());
  }

  void refine() {
    const auto maxSize = static_cast<std::size_t>(settings_.maxSize);
    while (local_.open.size() + distant_.open.size() + leaves_.size() < maxSize) {
      Side* side = largestShare();
      if (!side) return;
      std::pop_heap(side->open.begin(), side->open.end());
      const Cluster parent = seen_[side->open.back().cluster];
      side->open.pop_back();
      side->sum -= static_cast<double>(parent.estimate);
      const LightTree& tree = trees_.of(parent.distant);
      add(parent.distant, tree.left(parent.node));
      add(parent.distant, tree.right(parent.node));
    }
  }

  void take(std::vector<Cluster>& cut) const {
    cut.clear();
    for (const Side* side : {&local_, &distant_}) {
      for (const Candidate& c : side->open) cut.push_back(seen_[c.cluster]);
    }
    for (const std::uint32_t leaf : leaves_) cut.push_back(seen_[leaf]);
    std::sort(cut.begin(), cut.end(), [](const Cluster& a, const Cluster& b) {
      // Nodes are numbered in depth-first order, and no node of a cut is inside another.
      return std::pair(a.distant, a.node) < std::pair(b.distant, b.node);
    });
  }

 private:
  struct Candidate {
    float priority;
    std::uint32_t cluster;
    /// Equal priorities are told apart, so that the cut does not depend on how a heap is built.
    bool operator<(const Candidate& other) const {
      return priority != other.priority ? priority < other.priority : cluster > other.cluster;
    }
  };

  /// A tree's part of the cut.
  struct Side {
    std::vector<Candidate> open;
    double sum = 0;  ///< of the estimates of all its clusters
  };

  /// The side whose first candidate may have the largest share of the choice; none if that is below the threshold.
  Side* largestShare() {
    const double toDistant = local_.sum + distant_.sum > 0 ? distantShare(local_.sum, distant_.sum) : 0;
    const auto shareOf = [](const Side& side, double toSide) {
      if (side.open.empty()) return 0.0;
      // What is left of a sum by rounding is no reason to stop.
      return side.sum > 0 ? static_cast<double>(side.open.front().priority) / side.sum * toSide
                          : std::numeric_limits<double>::infinity();
    };
    const double local = shareOf(local_, 1 - toDistant), distant = shareOf(distant_, toDistant);
    if (!(std::max(local, distant) > static_cast<double>(settings_.threshold))) return nullptr;
    return local >= distant ? &local_ : &distant_;
  }

  /// The estimate, had the cluster all its light where it is nearest: the mean distance underrates a large box with
  /// bright lamps beside the cell, and it must not stay in one piece for that.
  static float priority(const Cluster& cluster) {
    const float ratio = cluster.meanDistance / cluster.leastDistance;
    // Not so for distant clusters and for coincident lights at the point, where the ratio is no number.
    if (!(ratio > 1)) return cluster.estimate;
    return std::min(cluster.estimate * ratio * ratio, std::numeric_limits<float>::max());
  }

  void add(bool distant, NodeId node) {
    const LightTree& tree = trees_.of(distant);
    const std::optional<Cluster> cluster =
        distant ? std::optional(distantCluster(tree, node)) : localCluster(tree, node, region_);
    if (!cluster) return;
    const auto index = static_cast<std::uint32_t>(seen_.size());
    seen_.push_back(*cluster);
    Side& side = distant ? distant_ : local_;
    side.sum += static_cast<double>(cluster->estimate);
    if (tree.isLeaf(node)) {
      leaves_.push_back(index);
    } else {
      side.open.push_back({priority(*cluster), index});
      std::push_heap(side.open.begin(), side.open.end());
    }
  }

  const LightTrees& trees_;
  const Region& region_;
  const CutSettings& settings_;
  std::vector<Cluster> seen_;
  Side local_, distant_;
  std::vector<std::uint32_t> leaves_;
};

}  // namespace

void findCut(const LightTrees& trees, const Region& region, const CutSettings& settings, std::vector<Cluster>& cut) {
  CutSearch search(trees, region, settings);
  search.refine();
  search.take(cut);
}

namespace {

/// Most lights of a cut that are weighed exactly, at every point: a thousand of them took 26 to 56 µs per ray.
constexpr std::size_t kMaxLargeLights = 16;

/// Which clusters are single lights as large for their distance as a near cell, like a window or a long lamp: those of
/// the largest estimates, if there are many.
std::vector<bool> areLargeLights(const LightTree& local, const std::vector<Cluster>& clusters) {
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Cluster& c = clusters[i];
    if (c.distant || !local.isLeaf(c.node)) continue;
    const LightTreeNode& node = local.node(c.node);
    if (radiusOf(node, centreOf(node)) > kNearShare * c.meanDistance) large.push_back(i);
  }
  if (large.size() > kMaxLargeLights) {
    std::nth_element(large.begin(), large.begin() + kMaxLargeLights, large.end(), [&](std::size_t a, std::size_t b) {
      return clusters[a].estimate != clusters[b].estimate ? clusters[a].estimate > clusters[b].estimate : a < b;
    });
    large.resize(kMaxLargeLights);
  }
  std::vector<bool> isLarge(clusters.size(), false);
  for (const std::size_t i : large) isLarge[i] = true;
  return isLarge;
}

/// Mean of max(0, c) over cosines c spread evenly over [cosTheta − spread, cosTheta + spread]: milder than a bound, and
/// 0 only where the largest of them is below the horizon.
double meanClampedCosine(float cosTheta, float spread) {
  const double c = static_cast<double>(cosTheta + kCosineMargin), s = static_cast<double>(spread);
  if (c >= s) return c;
  return c > -s ? (c + s) * (c + s) / (4 * s) : 0.0;
}

}  // namespace

FarChoice::OfTree::OfTree(std::span<const double> weights)
    : cdf(weights), sum(std::accumulate(weights.begin(), weights.end(), 0.0)) {}

FarChoice::FarChoice(std::span<const double> distantWeights, std::span<const double> localWeights)
    : distant_(distantWeights), local_(localWeights) {}

Cut::Cut(const LightTrees& trees, const Region& region, const std::vector<Cluster>& clusters) {
  const bool few = clusters.size() <= kFewClusters;
  const std::vector<bool> isLarge = areLargeLights(trees.local, clusters);
  const auto isNear = [&](std::size_t i) {
    const Cluster& c = clusters[i];
    return !c.distant && (few || region.radius == 0 || region.radius > kNearShare * c.meanDistance || isLarge[i]);
  };
  const auto localLeaves = static_cast<std::uint32_t>(trees.local.leafCount());
  const auto addMember = [&](const Cluster& c) {
    const LightTree& tree = trees.of(c.distant);
    // The mask says to the compiler that it fits.
    members_.push_back({c.node, c.distant, tree.node(c.node).leafCount() & 0x7fffffffu,
                        tree.firstLeaf(c.node) + (c.distant ? localLeaves : 0), c.estimate});
  };
  members_.reserve(clusters.size());
  std::vector<std::uint16_t> far;         // by leaf
  std::vector<std::uint64_t> byEstimate;  // the bits of a positive float are in its order; then the place in `far`
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (isNear(i)) continue;
    byEstimate.push_back(std::uint64_t{~std::bit_cast<std::uint32_t>(clusters[i].estimate)} << 32 | far.size());
    far.push_back(static_cast<std::uint16_t>(i));
  }
  distantCount_ = static_cast<std::size_t>(
      std::count_if(clusters.begin(), clusters.end(), [](const Cluster& c) { return c.distant; }));
  std::sort(byEstimate.begin(), byEstimate.end());
  std::stable_partition(byEstimate.begin(), byEstimate.end(),
                        [&](std::uint64_t key) { return clusters[far[static_cast<std::uint16_t>(key)]].distant; });
  farByLeaf_.resize(far.size());
  for (const std::uint64_t key : byEstimate) {
    const auto position = static_cast<std::uint16_t>(key);
    const Cluster& c = clusters[far[position]];
    farByLeaf_[position] = static_cast<std::uint16_t>(far_.size());
    // The mean of the directions in a cone; all of the weight would otherwise be where the cone's axis happens to
    // point.
    far_.push_back({c.estimate, c.direction * (0.5f + 0.5f * c.cosThetaU), c.cosThetaU, c.sinThetaU});
    addMember(c);
  }
  near_ = BlockedFloats(clusters.size() - far_.size(), kNearFields);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (!isNear(i)) continue;
    const Cluster& c = clusters[i];
    const std::size_t row = members_.size() - far_.size();
    addNear(trees.local.node(c.node), row);
    if (isLarge[i]) {
      near_.field(kIntensity)[row] = 0;
      TriangleEmitter emitter = trees.lights.triangleEmitter(trees.local.light(trees.local.firstLeaf(c.node)));
      emitter.meanRadiance = std::ldexp(emitter.meanRadiance, -trees.exponent);
      largeLights_.push_back({static_cast<std::uint32_t>(row), emitter});
    }
    addMember(c);
  }
  if (!far_.empty()) choices_ = std::make_unique<std::atomic<const FarChoice*>[]>(kFacings);
}

Cut makeCut(const LightTrees& trees, const Region& region, const CutSettings& settings) {
  std::vector<Cluster> clusters;
  findCut(trees, region, settings, clusters);
  return Cut(trees, region, clusters);
}

Cut::Cut(Cut&& other) noexcept = default;

Cut::~Cut() {
  if (!choices_) return;
  for (std::size_t i = 0; i < kFacings; ++i) delete choices_[i].load(std::memory_order_relaxed);
}

void Cut::addNear(const LightTreeNode& node, std::size_t i) {
  const auto set = [&](NearField field, float value) { near_.field(field)[i] = value; };
  const Vec3 centre = centreOf(node);
  const Cone axes = node.axes();
  set(kCentreX, centre.x);
  set(kCentreY, centre.y);
  set(kCentreZ, centre.z);
  set(kRadius, radiusOf(node, centre));
  set(kIntensity, node.intensity());
  set(kAxisX, axes.axis.x);
  set(kAxisY, axes.axis.y);
  set(kAxisZ, axes.axis.z);
  set(kCosThetaO, axes.cosTheta);
  set(kSinThetaO, axes.sinTheta);
  set(kCosThetaE, node.cosThetaE());
  set(kTwoSided, node.twoSided() ? 1.0f : 0.0f);
}

FarChoice Cut::makeFarChoice(std::size_t facingIndex) const {
  const Facing normals = facing(facingIndex);
  std::vector<double> weights;
  weights.reserve(far_.size());
  for (const Far& c : far_) {
    // The cosine at the receiver varies by the spread of the directions and by that of the normals.
    const float cosSpread = c.cosThetaU * normals.cosSpread - c.sinThetaU * normals.sinSpread;
    const float sinSpread = c.sinThetaU * normals.cosSpread + c.cosThetaU * normals.sinSpread;
    const float cosTheta = glm::dot(c.meanDirection, normals.axis);
    weights.push_back(static_cast<double>(c.estimate) * meanClampedCosine(cosTheta, cosSpread > 0 ? sinSpread : 1.0f));
  }
  const std::span<const double> all(weights);
  return FarChoice(all.first(distantCount_), all.subspan(distantCount_));
}

Cut::Kept Cut::keep(std::size_t facingIndex, FarChoice choice) const {
  auto mine = std::make_unique<const FarChoice>(std::move(choice));
  const FarChoice* kept = nullptr;
  if (!choices_[facingIndex].compare_exchange_strong(kept, mine.get(), std::memory_order_acq_rel)) {
    return {kept, false};
  }
  return {mine.release(), true};
}

std::optional<std::size_t> Cut::memberOf(std::uint32_t leaf) const {
  // The last member, in the order of leaves, that does not begin after the leaf. By hand: clang 14 cannot compile the
  // views of GCC 12.
  const auto find = [&](std::size_t count, const auto& memberAt) -> std::optional<std::size_t> {
    std::size_t after = 0;
    for (std::size_t end = count; after < end;) {
      const std::size_t middle = (after + end) / 2;
      if (members_[memberAt(middle)].firstLeaf <= leaf) {
        after = middle + 1;
      } else {
        end = middle;
      }
    }
    if (after == 0) return std::nullopt;
    const std::size_t found = memberAt(after - 1);
    const Member& member = members_[found];
    if (leaf - member.firstLeaf >= member.leafCount) return std::nullopt;
    return found;
  };
  const auto far = find(far_.size(), [&](std::size_t i) { return std::size_t{farByLeaf_[i]}; });
  return far ? far : find(near_.size(), [&](std::size_t i) { return far_.size() + i; });
}

std::size_t Cut::bytes() const {
  std::size_t sum = sizeof(Cut) + far_.capacity() * sizeof(Far) + near_.bytes() +
                    largeLights_.capacity() * sizeof(LargeLight) + members_.capacity() * sizeof(Member) +
                    farByLeaf_.capacity() * sizeof(std::uint16_t);
  if (!choices_) return sum;
  sum += kFacings * sizeof(choices_[0]);
  for (std::size_t i = 0; i < kFacings; ++i) {
    if (const FarChoice* choice = farChoice(i)) sum += choice->bytes();
  }
  return sum;
}

}  // namespace cellcut
