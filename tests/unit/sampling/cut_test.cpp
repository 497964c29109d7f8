#include "renderer/base/rng.h"
#include "renderer/sampling/cell_grid.h"
#include "renderer/sampling/cut_choice.h"
#include "renderer/sampling/descent.h"
#include "renderer/sampling/facing.h"
#include "renderer/trace/renderer.h"
#include "tests/support/images.h"
#include "tests/support/near_weights_scalar.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/vectors.h"

#include <array>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// A thousand lights in a room of about two metres.
struct ManyLights {
  explicit ManyLights(LightMix mix = LightMix::kAll) : scene(stage(mix, 1000, 3)), lights(scene), trees(lights) {}
  Scene scene;
  Lights lights;
  LightTrees trees;
};

void expectNodeHoldsItsChildren(const LightTree& tree, NodeId id, bool distant) {
  const LightTreeNode& node = tree.node(id);
  if (tree.isLeaf(id)) return;
  const LightTreeNode& left = tree.node(tree.left(id));
  const LightTreeNode& right = tree.node(tree.right(id));
  ASSERT_EQ(tree.firstLeaf(tree.left(id)), tree.firstLeaf(id));
  ASSERT_EQ(tree.firstLeaf(tree.right(id)), tree.firstLeaf(id) + left.leafCount());
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
  EXPECT_GT(cut.farCount(), 0u);
  EXPECT_EQ(cut.farCount() + cut.near().size(), cut.size());
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Cut::Member& m = cut.members()[i];
    const LightTree& tree = m.distant ? many.trees.distant : many.trees.local;
    for (std::uint32_t leaf = 0; leaf < tree.node(m.node).leafCount(); ++leaf) {
      EXPECT_EQ(cut.memberOf(m.firstLeaf + leaf), i);
    }
  }
}

/// The cut of a point: all of its local clusters are near.
Cut cutOfPoint(const ManyLights& many, const Vec3& p, int maxSize) {
  std::vector<Cluster> clusters;
  findCut(many.trees, {p, 0}, {0.001f, maxSize}, clusters);
  return Cut(many.trees, {p, 0}, clusters);
}

TEST(Cut, SimdWeightsAreTheScalarOnes) {
  const ManyLights many;
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 centre(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    const Cut cut = cutOfPoint(many, centre, 200);
    const Vec3 p = centre + 0.3f * rng.uniform() * randomUnit(rng), n = randomUnit(rng);
    alignas(64) std::array<float, 512> simd, scalar;
    std::array<float, 32> simdSums, scalarSums;
    const double sum = nearWeights(cut.near(), p, n, simd.data(), simdSums.data());
    EXPECT_NEAR(sum, test::nearWeightsScalar(cut.near(), p, n, scalar.data(), scalarSums.data()), 1e-5 * sum);
    for (std::size_t slot = 0; slot < cut.near().blocks() * kClusterBlock; ++slot) {
      // Fused and separate roundings of cosines differ by 2⁻²²; beside the margin of 10⁻⁵ at a horizon that is a few
      // per cent.
      const float smallest = std::min(simd[slot], scalar[slot]), largest = std::max(simd[slot], scalar[slot]);
      EXPECT_LE(largest - smallest, 1e-4f * largest + 1e-6f * static_cast<float>(sum)) << "slot " << slot;
    }
  }
}

TEST(Cut, WeightOfAPointsOwnRegionIsTheImportance) {
  const ManyLights many;
  const ShadingPoint point{Vec3(0.3f, 0.2f, -0.1f), glm::normalize(Vec3(1, 2, 3))};
  const Cut cut = cutOfPoint(many, point.p, 128);
  ASSERT_GT(cut.near().size(), 0u);
  alignas(64) std::array<float, 512> weights;
  std::array<float, 32> sums;
  const double sum = nearWeights(cut.near(), point.p, point.n, weights.data(), sums.data());
  for (std::size_t i = 0; i < cut.near().size(); ++i) {
    const Cut::Member& m = cut.members()[cut.farCount() + i];
    ASSERT_FALSE(m.distant);
    EXPECT_NEAR(weights[i], importanceOf(many.trees.local, false, m.node, {point.p, point.n}), 1e-5 * sum);
  }
}

TEST(Facing, HoldsItsNormals) {
  Rng rng(4);
  std::set<std::size_t> seen;
  for (int i = 0; i < 200'000; ++i) {
    // Also normals on the borders of the map: axes, and directions with a coordinate that is all but 0.
    Vec3 n = randomUnit(rng);
    if (i % 4 == 0) n[i / 4 % 3] *= 1e-7f;
    if (i % 8 == 0) n[(i / 8 + 1) % 3] = 0;
    n = glm::normalize(n);
    const std::size_t index = facingOf(n);
    seen.insert(index);
    const Facing f = facing(index);
    const double chord = glm::length(glm::dvec3(n) - glm::dvec3(f.axis));
    ASSERT_LE(2 * std::asin(0.5 * chord), std::acos(static_cast<double>(f.cosSpread)) + 1e-6) << i;
    ASSERT_LT(std::acos(f.cosSpread), kPi / 12);  // facing.h promises 15°
  }
  EXPECT_EQ(seen.size(), kFacings);
}

TEST(Cut, FarWeightIsZeroOnlyWhereNoLightIsAboveTheHorizon) {
  const ManyLights many;
  Rng rng(5);
  const Region region{Vec3(0.2f), 0.1f};
  std::vector<Cluster> clusters;
  findCut(many.trees, region, {0, 64}, clusters);
  const Cut cut(many.trees, region, clusters);
  std::size_t zeros = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 n = randomUnit(rng);
    const FarChoice far = cut.makeFarChoice(facingOf(n));
    const Vec3 p = region.centre + region.radius * randomUnit(rng);
    for (std::size_t k = 0; k < cut.farCount(); ++k) {
      const double pmf =
          k < cut.distantCount() ? far.distant().cdf.pmf(k) : far.local().cdf.pmf(k - cut.distantCount());
      if (pmf > 0) continue;
      ++zeros;
      const Cut::Member& m = cut.members()[k];
      EXPECT_EQ(importanceOf(m.distant ? many.trees.distant : many.trees.local, m.distant, m.node, {p, n}), 0);
    }
  }
  EXPECT_GT(zeros, 1000u);
}

/// A hundred lamps of 1 W/sr in a room, and a sun.
struct SunnyRoom {
  explicit SunnyRoom(float sun) {
    Rng rng(6);
    for (int i = 0; i < 100; ++i) scene.pointLights.push_back({2.0f * randomUnit(rng), Vec3(1)});
    scene.directionalLights.push_back({{0, 0, -1}, Vec3(sun)});
    finish(scene);
  }
  Scene scene;
};

TEST(Cut, LampsKeepAnEighthOfTheChoiceHoweverBrightTheSunIs) {
  for (const float sun : {1e6f, 1e12f}) {
    const SunnyRoom room(sun);
    const Lights lights(room.scene);
    const LightTrees trees(lights);
    const ShadingPoint point{Vec3(0.1f), {0, 0, 1}};
    const Region region{Vec3(0), 0.2f};
    const Cut cut = makeCut(trees, region, {0.001f, 1024});
    const FarChoice far = cut.makeFarChoice(facingOf(point.n));
    const TreesDescent descent(trees, {point.p, point.n});
    double fromCut = 0;
    for (std::uint32_t i = 0; i < 100; ++i)
      fromCut += static_cast<double>(pmfInCut(trees, cut, far, InCluster::kIntensity, point, LightId{i}));
    EXPECT_NEAR(fromCut, 0.125, 1e-6) << sun;
    EXPECT_EQ(descent.pmf(true, 0), 0.875) << sun;
  }
}

TEST(Cut, ASunDoesNotKeepLampsFromBeingSplit) {
  const auto sizeOf = [](float sun) {
    const SunnyRoom room(sun);
    const Lights lights(room.scene);
    return makeCut(LightTrees(lights), {Vec3(0), 0.2f}, {0.02f, 1024}).size();
  };
  // With an eighth of the choice a lamp's share is above the threshold when its share of the lamps is eight times that.
  EXPECT_GT(sizeOf(1e6f), 5u);
  EXPECT_EQ(sizeOf(1e6f), sizeOf(1e12f));
  EXPECT_GT(sizeOf(1e-3f), sizeOf(1e6f));
}

TEST(Cut, WeighsNoMoreThanSixteenLightsExactly) {
  Scene scene;
  const MaterialId lamp = addMaterial(scene, emitter(Vec3(1), true));
  for (int i = 0; i < 100; ++i) {
    const float x = 0.1f * static_cast<float>(i);
    addTriangle(scene, lamp, {x, -20, 2}, {x, 20, 2}, {x + 0.05f, 20, 2});
  }
  finish(scene);
  const Lights lights(scene);
  const LightTrees trees(lights);
  const Cut cut = makeCut(trees, {Vec3(0), 0.1f}, {0, 1024});
  EXPECT_EQ(cut.size(), 100u);
  EXPECT_EQ(cut.largeLights().size(), 16u);
  float faintest = kInfinity;
  for (const Cut::LargeLight& large : cut.largeLights())
    faintest = std::min(faintest, cut.members()[cut.farCount() + large.near].estimate);
  EXPECT_EQ(std::count_if(cut.members().begin(), cut.members().end(),
                          [&](const Cut::Member& m) { return m.estimate >= faintest; }),
            16)
      << "they have the largest estimates";
}

TEST(Cut, LightsThatAreLargeForTheirDistanceAreWeighedExactly) {
  Scene scene;
  const MaterialId lamp = addMaterial(scene, emitter(Vec3(1), true));
  addTriangle(scene, lamp, {-10, 0, 2}, {40, 0, 2}, {40, 0.1f, 2});
  addTriangle(scene, lamp, {-2, 1, -1}, {2, 1, -1}, {2, 1, 2});
  addTriangle(scene, lamp, {3, 3, 3}, {3.01f, 3, 3}, {3.01f, 3.01f, 3});
  finish(scene);
  const Lights lights(scene);
  const LightTrees trees(lights);
  const Cut cut = makeCut(trees, {Vec3(0), 0.1f}, {0, 64});
  ASSERT_EQ(cut.largeLights().size(), 2u);
  Rng rng(8);
  for (int i = 0; i < 50; ++i) {
    const ShadingPoint point{0.1f * randomUnit(rng), randomUnit(rng)};
    const FarChoice far = cut.makeFarChoice(facingOf(point.n));
    const auto pmfOf = [&](std::uint32_t light) {
      return static_cast<double>(pmfInCut(trees, cut, far, InCluster::kIntensity, point, LightId{light}));
    };
    const double first = lights.irradiance(LightId{0}, point.p, point.n);
    const double second = lights.irradiance(LightId{1}, point.p, point.n);
    // Floats of a sum of three.
    EXPECT_NEAR(pmfOf(0) * second, pmfOf(1) * first, 1e-6 * (first + second)) << i;
    EXPECT_EQ(pmfOf(0) > 0, first > 0) << i;
  }
}

// The proofs of all strategies have fewer lights than a cut has clusters, but for one: here clusters hold about
// twenty-five.
TEST(Cut, ChoosesInsideClustersWithTheProbabilityThatItReports) {
  const ManyLights many(LightMix::kPoint);
  const Region region{many.scene.pointLights[0].position, 0.6f};
  std::vector<Cluster> clusters;
  findCut(many.trees, region, {0, 40}, clusters);
  const Cut cut(many.trees, region, clusters);
  ASSERT_GT(cut.farCount(), 1u);
  ASSERT_GT(cut.near().size(), 1u);
  ShadingPoint point{region.centre + Vec3(0.1f, 0.05f, 0), glm::normalize(Vec3(1, 2, -1))};
  const FarChoice far = cut.makeFarChoice(facingOf(point.n));
  for (const auto& [inCluster, mirrors] : {std::pair(InCluster::kIntensity, false),
                                           {InCluster::kDescent, false},
                                           {InCluster::kIntensity, true},
                                           {InCluster::kDescent, true}}) {
    if (mirrors) point.lobe = {glm::normalize(Vec3(0.2f, 1, 0.3f)), 0.1f, 0.5f};
    std::vector<double> outcomes;
    for (std::size_t i = 0; i < many.lights.size(); ++i) {
      outcomes.push_back(
          static_cast<double>(pmfInCut(many.trees, cut, far, inCluster, point, static_cast<LightId>(i))));
    }
    // The last outcome is none: a descent can end there.
    outcomes.push_back(std::max(0.0, 1 - std::accumulate(outcomes.begin(), outcomes.end(), 0.0)));
    std::vector<std::uint64_t> counts(outcomes.size());
    Rng rng(9);
    for (int i = 0; i < 300'000; ++i) {
      const auto sample = sampleCut(many.trees, cut, far, inCluster, point, rng.uniformDouble());
      ++counts[sample ? static_cast<std::size_t>(sample->light) : many.lights.size()];
      if (!sample) continue;
      // Roundings of a product and a quotient in another order.
      ASSERT_NEAR(static_cast<double>(sample->pmf) / outcomes[static_cast<std::size_t>(sample->light)], 1, 1e-5);
    }
    const ChiSquare test = chiSquareTest(counts, outcomes);
    EXPECT_EQ(test.impossible, 0u);
    EXPECT_GT(test.p, sidak(0.01, 4));
  }
}

TEST(CellCut, PictureIsTheSameWithoutMemoryForCells) {
  const Scene scene = stage(LightMix::kAll, 100, 5);
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.maxDepth = 3;
  Renderer kept(scene, settings);
  settings.sampler.cellMemory = 0;
  Renderer forgotten(scene, settings);
  const ImageRgb a = renderPasses(kept, 1), b = renderPasses(forgotten, 1);
  EXPECT_GT(kept.samplerStatistics().grid->made(), 0u);
  EXPECT_EQ(forgotten.samplerStatistics().grid->made(), 0u);
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
    for (const bool indirect : {false, true}) {
      const auto cell = grid.cellOf(p, indirect);
      ASSERT_TRUE(cell);
      const Region region = grid.region(*cell);
      EXPECT_LE(glm::length(glm::dvec3(p) - glm::dvec3(region.centre)), static_cast<double>(region.radius));
    }
  }
  EXPECT_FALSE(grid.cellOf(Vec3(1e30f, 0, 0)));
  EXPECT_FALSE(grid.cellOf(Vec3(std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace cellcut::test
