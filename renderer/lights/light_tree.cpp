#include "renderer/lights/light_tree.h"

#include "renderer/base/octahedral.h"
#include "renderer/base/rng.h"

#include <array>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

namespace cellcut {
namespace {

/// Cut planes tried per axis and node; Conty Estevez and Kulla use 12 buckets.
constexpr int kBuckets = 12;
/// Below this many lights a subtree is built by one thread: a task costs a few microseconds.
constexpr std::size_t kSerialLights = 4096;
/// From this depth on nodes are halved by count: 2³² lights need 32 more levels, so no path is longer than 96 nodes.
constexpr int kMaxCostDepth = 64;
static_assert(kMaxCostDepth + 32 < 1 << LightTreeNode::kTurnBits);

/// What the build moves about: a light's bounds in brief.
struct BuildLight {
  Vec3 lower, upper;
  Vec3 axis;  ///< times (1 + cosθo) / 2: none for a light that shines everywhere
  float intensity;
  std::uint32_t index;
  Vec3 middle() const { return 0.5f * lower + 0.5f * upper; }
};

/// Sums over one bucket.
struct Bucket {
  Bounds box;
  Vec3 axis{0.0f};
  float intensity = 0;
  std::uint32_t count = 0;

  void add(const BuildLight& light) {
    box.add({light.lower, light.upper});
    axis += light.axis;
    intensity += light.intensity;
    ++count;
  }
  void add(const Bucket& other) {
    box.add(other.box);
    axis += other.axis;
    intensity += other.intensity;
    count += other.count;
  }
  /// Intensity × size × orientation. Size is the squared diagonal and not the surface: the area of collinear lights is
  /// zero. Orientation runs from 1 (all axes alike) to 4 (everywhere), the ratio of Conty Estevez and Kulla's measure,
  /// by the length of the mean axis: a sum, where their cone would need a union per light.
  float cost() const {
    if (count == 0) return 0;
    const Vec3 diagonal = box.upper - box.lower;
    const float alike = glm::length(axis) / static_cast<float>(count);
    return intensity * glm::dot(diagonal, diagonal) * (4 - 3 * std::min(alike, 1.0f));
  }
};

struct Split {
  int axis = -1;   ///< −1: none is better than another
  int bucket = 0;  ///< last bucket of the left side
  float cost = kInfinity;
};

/// Even buckets along one axis. In double: among floats an extent may overflow, and so may the quotient by an extent
/// that is denormal.
struct Buckets {
  double lower, extent;

  Buckets(const Bounds& middles, int axis)
      : lower(static_cast<double>(middles.lower[axis])), extent(static_cast<double>(middles.upper[axis]) - lower) {}
  bool flat() const { return !(extent > 0); }
  /// 0 … kBuckets − 1. \pre not flat
  int of(float middle) const {
    const double position = (static_cast<double>(middle) - lower) * (kBuckets / extent);
    return position > 0 ? static_cast<int>(std::min(position, double{kBuckets - 1})) : 0;
  }
};

Split bestSplit(std::span<const BuildLight> lights, const Bounds& middles) {
  const std::array axes{Buckets(middles, 0), Buckets(middles, 1), Buckets(middles, 2)};
  const double longest = std::max({axes[0].extent, axes[1].extent, axes[2].extent});
  std::array<std::array<Bucket, kBuckets>, 3> buckets;
  for (const BuildLight& light : lights) {
    const Vec3 middle = light.middle();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!axes[axis].flat()) {
        buckets[axis][static_cast<std::size_t>(axes[axis].of(middle[static_cast<int>(axis)]))].add(light);
      }
    }
  }
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const Buckets& along = axes[static_cast<std::size_t>(axis)];
    if (along.flat()) continue;
    const auto& row = buckets[static_cast<std::size_t>(axis)];
    std::array<float, kBuckets> right{};  // cost of all buckets after
    Bucket sum;
    for (std::size_t b = kBuckets - 1; b > 0; --b) {
      sum.add(row[b]);
      right[b - 1] = sum.count > 0 ? sum.cost() : kInfinity;
    }
    sum = Bucket{};
    for (std::size_t b = 0; b + 1 < kBuckets; ++b) {
      sum.add(row[b]);
      if (sum.count == 0) continue;
      // Thin boxes are discouraged: Conty Estevez and Kulla's regularisation.
      const float cost = (sum.cost() + right[b]) * static_cast<float>(longest / along.extent);
      if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
    }
  }
  return best;
}

class Builder {
 public:
  Builder(std::span<const LightBounds> bounds, std::span<BuildLight> lights, LightTreeNode* nodes)
      : bounds_(bounds), lights_(lights), nodes_(nodes) {}

  /// Builds the subtree over lights [first, last) at `node` and returns its bounds.
  LightBounds build(std::size_t first, std::size_t last, std::size_t node, int depth) {
    const std::size_t count = last - first;
    LightBounds bounds;
    if (count == 1) {
      bounds = bounds_[lights_[first].index];
    } else {
      const std::size_t middle = split(first, last, depth);
      const std::size_t right = node + 2 * (middle - first);
      LightBounds a, b;
      const auto buildLeft = [&] { a = build(first, middle, node + 1, depth + 1); };
      const auto buildRight = [&] { b = build(middle, last, right, depth + 1); };
      if (count > kSerialLights) {
        tbb::parallel_invoke(buildLeft, buildRight);
      } else {
        buildLeft();
        buildRight();
      }
      bounds = merge(a, b);
    }
    nodes_[node] =
        LightTreeNode(bounds, static_cast<std::uint32_t>(node - 2 * first), static_cast<std::uint32_t>(count));
    return bounds;
  }

 private:
  /// Reorders [first, last) and returns where the right side begins, both sides non-empty.
  std::size_t split(std::size_t first, std::size_t last, int depth) {
    const std::span<BuildLight> range = lights_.subspan(first, last - first);
    if (range.size() == 2) return first + 1;
    Bounds middles;
    for (const BuildLight& light : range) middles.add(light.middle());
    const Split best = depth < kMaxCostDepth ? bestSplit(range, middles) : Split{};
    if (best.axis >= 0) {
      const Buckets along(middles, best.axis);
      const auto middle = std::partition(range.begin(), range.end(), [&](const BuildLight& light) {
        return along.of(light.middle()[best.axis]) <= best.bucket;
      });
      if (middle != range.begin() && middle != range.end()) {
        return first + static_cast<std::size_t>(middle - range.begin());
      }
    }
    // Coincident lights, or no finite cost: halve by count.
    return first + range.size() / 2;
  }

  std::span<const LightBounds> bounds_;
  std::span<BuildLight> lights_;
  LightTreeNode* nodes_;
};

/// Leaves of the largest subtrees that are blocks of LeafSums: at 10⁶ lights a cluster of a cut has some 1000, and is
/// one.
constexpr std::uint32_t kBlock = 1024;

std::int16_t toSigned16(float x) {
  return static_cast<std::int16_t>(std::lround(x * 32767));
}

/// sin(θ/2) in units of 1/steps, rounded up.
std::uint16_t sinHalf(float theta, float steps) {
  return static_cast<std::uint16_t>(std::min(steps, std::ceil(std::sin(0.5f * std::min(kPi, theta)) * steps)));
}

/// Largest angle between an axis and its 2 × 16-bit code: half a step in the octahedron's plane, stretched by at most
/// √3 · √2.
constexpr float kAxisError = 4e-5f * 2;

}  // namespace

LightTreeNode::LightTreeNode(const LightBounds& bounds, std::uint32_t leftTurns, std::uint32_t leafCount)
    : lower_(bounds.box.lower),
      upper_(bounds.box.upper),
      intensity_(bounds.intensity),
      axisX_(toSigned16(octahedral(bounds.axes.axis).x)),
      axisY_(toSigned16(octahedral(bounds.axes.axis).y)),
      sinHalfO_(sinHalf(std::atan2(bounds.axes.sinTheta, bounds.axes.cosTheta) + kAxisError, 65535)),
      sinHalfEAndTurns_(static_cast<std::uint16_t>(
          std::uint32_t{sinHalf(std::acos(std::clamp(bounds.cosThetaE, -1.0f, 1.0f)), kStepsE)} << kTurnBits |
          leftTurns)),
      leafCountAndSides_(leafCount | (bounds.twoSided ? kTwoSided : 0)) {}

LightTree::LightTree(std::span<const LightBounds> bounds, LightId firstId, bool distant)
    : leafOfLight_(bounds.size(), kNoLeaf), firstId_(firstId) {
  std::vector<std::uint32_t> shining;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (bounds[i].intensity > 0) shining.push_back(static_cast<std::uint32_t>(i));
  if (shining.empty()) return;
  const auto memory = std::make_unique_for_overwrite<BuildLight[]>(shining.size());
  const std::span lights(memory.get(), shining.size());
  tbb::parallel_for(std::size_t{0}, lights.size(), [&](std::size_t i) {
    const LightBounds& b = bounds[shining[i]];
    const Vec3 lower = distant ? b.axes.axis : b.box.lower, upper = distant ? b.axes.axis : b.box.upper;
    lights[i] = {lower, upper, b.axes.axis * (0.5f + 0.5f * b.axes.cosTheta), b.intensity, shining[i]};
  });
  nodes_ = std::make_unique_for_overwrite<LightTreeNode[]>(2 * lights.size() - 1);
  Builder(bounds, lights, nodes_.get()).build(0, lights.size(), 0, 0);

  const auto addSums = [&] {
    std::vector<float> intensities;
    intensities.reserve(lights.size());
    for (const BuildLight& light : lights) intensities.push_back(light.intensity);
    sums_.reserve(intensities.size());
    addBlocks(root(), intensities);
  };
  const auto addLeaves = [&] {
    leaves_.reserve(lights.size());
    for (const BuildLight& light : lights) {
      leafOfLight_[light.index] = static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back(static_cast<LightId>(static_cast<std::uint32_t>(firstId) + light.index));
    }
  };
  tbb::parallel_invoke(addSums, addLeaves);
}

bool LightTree::isInBlock(NodeId id) const {
  return node(id).leafCount() <= kBlock;
}

void LightTree::addBlocks(NodeId id, std::span<const float> intensities) {
  if (isInBlock(id)) {
    sums_.addBlock(intensities.subspan(firstLeaf(id), node(id).leafCount()));
  } else {
    addBlocks(left(id), intensities);
    addBlocks(right(id), intensities);
  }
}

LightTree::Shares LightTree::intensityShares(NodeId id) const {
  const auto l = static_cast<double>(node(left(id)).intensity()), r = static_cast<double>(node(right(id)).intensity());
  // Not 1 − left: what is 10⁻¹⁷ of its sibling has a probability, too.
  return {l / (l + r), r / (l + r)};
}

SampledLeaf LightTree::sampleByIntensity(NodeId id, std::uint32_t first, std::uint32_t count, double u) const {
  double pmf = 1;
  while (count > kBlock) {
    const auto [toLeft, toRight] = intensityShares(id);
    const std::uint32_t leftCount = node(left(id)).leafCount();
    if (u < toLeft) {
      u = std::min(u / toLeft, kAlmostOne);
      pmf *= toLeft;
      id = left(id);
      count = leftCount;
    } else {
      u = std::min((u - toLeft) / toRight, kAlmostOne);
      pmf *= toRight;
      id = right(id);
      first += leftCount;
      count -= leftCount;
    }
  }
  // The light is looked up next, and most often beside the proportional guess: both waits for memory begin at once.
  __builtin_prefetch(&leaves_[first + static_cast<std::uint32_t>(u * count)]);
  const SampledLeaf inBlock = sums_.sample(first, first + count, u);
  return {inBlock.leaf, pmf * inBlock.pmf};
}

double LightTree::pmfByIntensity(NodeId id, std::uint32_t leaf) const {
  double pmf = 1;
  while (!isInBlock(id)) {
    const auto [toLeft, toRight] = intensityShares(id);
    const bool isLeft = leaf < firstLeaf(right(id));
    pmf *= isLeft ? toLeft : toRight;
    id = isLeft ? left(id) : right(id);
  }
  return pmf * sums_.pmf(firstLeaf(id), endOf(id), leaf);
}

int LightTree::depth() const {
  // Depth-first order: a stack of the ends of the open nodes is as high as the node is deep.
  int deepest = 0;
  std::vector<std::uint32_t> ends;
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const auto id = static_cast<NodeId>(i);
    while (!ends.empty() && firstLeaf(id) >= ends.back()) ends.pop_back();
    ends.push_back(endOf(id));
    deepest = std::max(deepest, static_cast<int>(ends.size()));
  }
  return deepest;
}

std::size_t LightTree::bytes() const {
  return nodes().size_bytes() + leaves_.capacity() * sizeof(LightId) + leafOfLight_.capacity() * sizeof(std::uint32_t) +
         sums_.bytes();
}

}  // namespace cellcut
