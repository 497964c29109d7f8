#include "renderer/base/rng.h"
#include "renderer/sampling/cell_grid.h"
#include "renderer/sampling/cut_choice.h"
#include "renderer/trace/renderer.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

#include <array>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Lights of all kinds in a room of about two metres.
struct ManyLights {
  Scene scene = stage(LightMix::kAll, 1000, 3);
  Lights lights{scene};
  LightTrees trees{lights};
};

Vec3 randomUnit(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 2 * kPi), r = safeSqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

void expectNodeHoldsItsChildren(const LightTree& tree, NodeId id, bool distant) {
  const LightTreeNode& node = tree.node(id);
  if (tree.isLeaf(id)) return;
  const LightTreeNode& left = tree.node(tree.left(id));
  const LightTreeNode& right = tree.node(tree.right(id));
  ASSERT_EQ(left.firstLeaf(), node.firstLeaf());
  ASSERT_EQ(right.firstLeaf(), left.firstLeaf() + left.leafCount());
  ASSERT_EQ(left.leafCount() + right.leafCount(), node.leafCount());
  // One rounding of a float sum.
  ASSERT_FLOAT_EQ(node.intensity(), left.intensity() + right.intensity());
  for (const LightTreeNode* child : {&left, &right}) {
    if (!distant) {
      ASSERT_EQ(glm::min(node.lower(), child->lower()), node.lower());
      ASSERT_EQ(glm::max(node.upper(), child->upper()), node.upper());
    }
    // The child's cone lies in the parent's, but for the 16 bits of the child's own code.
    const float between = std::acos(std::clamp(glm::dot(node.axes().axis, child->axes().axis), -1.0f, 1.0f));
    const float widest = std::acos(node.axes().cosTheta), own = std::acos(child->axes().cosTheta);
    ASSERT_LE(std::min(between + own, kPi), widest + 2e-3f);
    ASSERT_LE(node.cosThetaE(), child->cosThetaE());
  }
  expectNodeHoldsItsChildren(tree, tree.left(id), distant);
  expectNodeHoldsItsChildren(tree, tree.right(id), distant);
}

TEST(LightTree, NodesHoldTheirChildren) {
  const ManyLights many;
  expectNodeHoldsItsChildren(many.trees.local, many.trees.local.root(), false);
  expectNodeHoldsItsChildren(many.trees.distant, many.trees.distant.root(), true);
}

TEST(LightTree, HasEachLightInOneLeaf) {
  const ManyLights many;
  std::set<std::uint32_t> seen;
  for (const LightTree* tree : {&many.trees.local, &many.trees.distant}) {
    for (std::uint32_t leaf = 0; leaf < tree->leafCount(); ++leaf) {
      EXPECT_EQ(tree->leafOf(tree->light(leaf)), leaf);
      EXPECT_TRUE(seen.insert(static_cast<std::uint32_t>(tree->light(leaf))).second);
    }
  }
  EXPECT_EQ(seen.size(), many.lights.size());
}

TEST(LightTree, CoincidentLightsMakeAShallowTree) {
  LightBounds bounds{.intensity = 1};
  bounds.box.add(Vec3(1, 2, 3));
  const LightTree tree(std::vector<LightBounds>(100'000, bounds), LightId{0}, false);
  // Halved by count: 17 levels and the root.
  EXPECT_EQ(tree.depth(), 18);
}

TEST(LightTree, LeavesOutLightsWithoutPower) {
  std::vector<LightBounds> bounds(3);
  for (LightBounds& b : bounds) b.box.add(Vec3(0));
  bounds[1].intensity = 2;
  const LightTree tree(bounds, LightId{10}, false);
  ASSERT_EQ(tree.leafCount(), 1u);
  EXPECT_EQ(tree.light(0), LightId{11});
  EXPECT_EQ(tree.leafOf(LightId{10}), LightTree::kNoLeaf);
}

TEST(LightTree, UnionOfOppositeConesIsAllDirections) {
  const Cone cone = coneUnion({{0, 0, 1}, 1, 0}, {{0, 0, -1}, 1, 0});
  EXPECT_EQ(cone.cosTheta, -1);
  EXPECT_TRUE(isFinite(cone.axis));
}

TEST(Cut, HoldsEachLightOnce) {
  const ManyLights many;
  std::vector<Cluster> clusters;
  const Region region{Vec3(0.1f), 0.2f};
  findCut(many.trees, region, {0, 64}, clusters);
  EXPECT_EQ(clusters.size(), 64u);
  const Cut cut(many.trees, region, clusters);
  for (const Cut::Member& m : cut.members()) {
    const LightTree& tree = m.distant ? many.trees.distant : many.trees.local;
    for (std::uint32_t i = 0; i < tree.node(m.node).leafCount(); ++i) {
      EXPECT_EQ(cut.memberOf(many.trees, m.firstLeaf + i), &m);
    }
    EXPECT_EQ(&cut.memberAt(m.slot), &m);
  }
}

TEST(Cut, SimdWeightsAreTheScalarOnes) {
  const ManyLights many;
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Region region{Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)), rng.uniform(0, 0.3f)};
    std::vector<Cluster> clusters;
    findCut(many.trees, region, {0.001f, 200}, clusters);
    const Cut cut(many.trees, region, clusters);
    const Vec3 p = region.centre + region.radius * rng.uniform() * randomUnit(rng), n = randomUnit(rng);
    alignas(64) std::array<float, 512> simd, scalar;
    std::array<float, 32> simdSums, scalarSums;
    const double sum = clusterWeights(cut.clusters(), p, n, simd.data(), simdSums.data());
    EXPECT_NEAR(sum, clusterWeightsScalar(cut.clusters(), p, n, scalar.data(), scalarSums.data()), 1e-5 * sum);
    for (std::size_t slot = 0; slot < cut.clusters().blocks() * kClusterBlock; ++slot) {
      // Fused and separate roundings of cosines differ by 2⁻²²; beside the margin of 10⁻⁵ at a horizon that is a few
      // per cent.
      const float smallest = std::min(simd[slot], scalar[slot]), largest = std::max(simd[slot], scalar[slot]);
      EXPECT_LE(largest - smallest, 1e-4f * largest + 1e-6f * static_cast<float>(sum)) << "slot " << slot;
    }
  }
}

TEST(Cut, WeightOfAPointsOwnRegionIsTheImportance) {
  const ManyLights many;
  const Region far{Vec3(0), 1};
  std::vector<Cluster> clusters;
  findCut(many.trees, far, {0, 128}, clusters);
  const Cut cut(many.trees, far, clusters);
  ASSERT_GT(cut.clusters().near.size(), 0u);
  const ShadingPoint point{Vec3(0.3f, 0.2f, -0.1f), glm::normalize(Vec3(1, 2, 3))};
  alignas(64) std::array<float, 512> weights;
  std::array<float, 32> sums;
  const double sum = clusterWeights(cut.clusters(), point.p, point.n, weights.data(), sums.data());
  for (const Cut::Member& m : cut.members()) {
    if (m.slot < cut.clusters().nearSlot(0)) continue;
    EXPECT_NEAR(weights[m.slot], nodeImportance(many.trees.local, false, m.node, point.p, point.n), 1e-5 * sum);
  }
}

// The proofs of all strategies have fewer lights than a cut has clusters, but for one: here clusters hold about a hundred.
TEST(Cut, ChoosesInsideClustersWithTheProbabilityThatItReports) {
  const ManyLights many;
  const Region region{Vec3(0.1f), 0.3f};
  std::vector<Cluster> clusters;
  findCut(many.trees, region, {0, 8}, clusters);
  const Cut cut(many.trees, region, clusters);
  const ShadingPoint point{Vec3(0.2f, 0.1f, 0), glm::normalize(Vec3(1, 2, -1))};
  for (const InCluster inCluster : {InCluster::kIntensity, InCluster::kDescent}) {
    std::vector<double> outcomes;
    for (std::size_t i = 0; i < many.lights.size(); ++i) {
      outcomes.push_back(static_cast<double>(pmfInCut(many.trees, cut, inCluster, point, static_cast<LightId>(i))));
    }
    // The last outcome is none: a descent can end there.
    outcomes.push_back(std::max(0.0, 1 - std::accumulate(outcomes.begin(), outcomes.end(), 0.0)));
    std::vector<std::uint64_t> counts(outcomes.size());
    Rng rng(9);
    for (int i = 0; i < 300'000; ++i) {
      const auto sample = sampleCut(many.trees, cut, inCluster, point, rng.uniformDouble());
      ++counts[sample ? static_cast<std::size_t>(sample->light) : many.lights.size()];
      if (!sample) continue;
      // Roundings of a product and a quotient in another order.
      ASSERT_NEAR(static_cast<double>(sample->pmf) / outcomes[static_cast<std::size_t>(sample->light)], 1, 1e-5);
    }
    const ChiSquare test = chiSquareTest(counts, outcomes);
    EXPECT_EQ(test.impossible, 0u);
    EXPECT_GT(test.p, sidak(0.01, 2));
  }
}

TEST(CellCut, PictureIsTheSameWithoutMemoryForCells) {
  const Scene scene = stage(LightMix::kAll, 100, 5);
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.maxDepth = 3;
  const std::atomic<bool> never{false};
  Renderer kept(scene, settings);
  settings.sampler.cellMemory = 0;
  Renderer forgotten(scene, settings);
  for (Renderer* renderer : {&kept, &forgotten}) renderer->renderPass(never);
  EXPECT_GT(kept.samplerStatistics().grid->touched, 0u);
  EXPECT_EQ(forgotten.samplerStatistics().grid->touched, 0u);
  const ImageRgb a = kept.film().mean(), b = forgotten.film().mean();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], b[i]);
}

TEST(GridGeometry, CellsHoldTheirPointsAndFlatBoxesAreOneCellThick) {
  Bounds box;
  box.add(Vec3(-3, 1, 2));
  box.add(Vec3(5, 1, 4));
  const GridGeometry grid(box, 32);
  EXPECT_EQ(grid.resolution(), glm::ivec3(32, 1, 8));
  Rng rng(2);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 p(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(-100, 100));
    const auto cell = grid.cellOf(p);
    ASSERT_TRUE(cell);
    const Region region = grid.region(*cell);
    EXPECT_LE(glm::length(glm::dvec3(p) - glm::dvec3(region.centre)), static_cast<double>(region.radius));
  }
  EXPECT_FALSE(grid.cellOf(Vec3(1e30f, 0, 0)));
  EXPECT_FALSE(grid.cellOf(Vec3(std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace cellcut::test
