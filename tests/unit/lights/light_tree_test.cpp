#include "renderer/lights/light_tree.h"

#include "renderer/base/rng.h"

#include <array>
#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Lights that shine everywhere, of these intensities, at these places.
LightTree pointTree(const std::vector<Vec3>& positions, const std::vector<float>& intensities) {
  std::vector<LightBounds> bounds(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    bounds[i].axes = {{0, 0, 1}, -1, 0};
    bounds[i].box.add(positions[i]);
    bounds[i].intensity = intensities[i];
  }
  return LightTree(bounds, LightId{0}, false);
}
LightTree pointTree(const std::vector<Vec3>& positions) {
  return pointTree(positions, std::vector<float>(positions.size(), 1));
}

/// `many` lights of intensity 1 in a unit cube, then `few` faint ones in a row far beside them.
LightTree brightAndFaint(std::size_t many, std::size_t few, float faint) {
  Rng rng(1);
  std::vector<Vec3> positions;
  std::vector<float> intensities;
  for (std::size_t i = 0; i < many + few; ++i) {
    const bool bright = i < many;
    positions.push_back(bright ? Vec3(rng.uniform(), rng.uniform(), rng.uniform())
                               : Vec3(100 + static_cast<float>(i - many), 0, 0));
    intensities.push_back(bright ? 1 : faint);
  }
  return pointTree(positions, intensities);
}

/// The node over just these leaves.
NodeId nodeOver(const LightTree& tree, std::uint32_t firstLeaf, std::uint32_t count) {
  std::uint32_t at = 0;
  const auto isIt = [&](NodeId id) { return tree.firstLeaf(id) == firstLeaf && tree.node(id).leafCount() == count; };
  while (at < tree.nodes().size() && !isIt(NodeId{at})) ++at;
  EXPECT_LT(at, tree.nodes().size());
  return NodeId{at};
}

TEST(LightTree, StandsExtentsWhoseReciprocalOverflows) {
  const LightTree tree = pointTree({{0, 0, 0}, {1e-39f, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(tree.leafCount(), 3u);
  EXPECT_EQ(tree.depth(), 3);
}

TEST(LightTree, StandsExtentsThatOverflow) {
  const LightTree tree = pointTree({{-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(tree.leafCount(), 3u);
  EXPECT_EQ(tree.depth(), 3);
}

TEST(LightTree, LightsFaintBesideManyOthersKeepTheirProbability) {
  const LightTree tree = brightAndFaint(100'000, 2, 1e-12f);
  const std::uint32_t first = std::min(tree.leafOf(LightId{100'000}), tree.leafOf(LightId{100'001}));
  for (const std::uint32_t leaf : {first, first + 1}) {
    // J / ΣJ, but for float roundings of ΣJ at each of some 30 levels.
    EXPECT_NEAR(tree.pmfByIntensity(tree.root(), leaf) / 1e-17, 1, 1e-4);
    EXPECT_EQ(tree.pmfByIntensity(nodeOver(tree, first, 2), leaf), 0.5);
    EXPECT_EQ(tree.pmfByIntensity(nodeOver(tree, leaf, 1), leaf), 1);
  }
}

TEST(LightTree, DrawsFaintLightsAsOftenAsItSays) {
  const LightTree tree = brightAndFaint(20'000, 4, 4e-12f);
  std::uint32_t first = tree.leafOf(LightId{20'000});
  for (std::uint32_t i = 1; i < 4; ++i) first = std::min(first, tree.leafOf(static_cast<LightId>(20'000 + i)));
  const NodeId faint = nodeOver(tree, first, 4);
  std::array<int, 4> counts{};
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const SampledLeaf leaf = tree.sampleByIntensity(faint, first, 4, (i + 0.5) / kDraws);
    EXPECT_EQ(leaf.pmf, 0.25);
    ++counts[leaf.leaf - first];
  }
  for (const int count : counts) EXPECT_EQ(count, kDraws / 4);
}

TEST(LightTree, AStrongLightAsideLeavesTheProbabilitiesOfOthersAlone) {
  // A sun beside 2,000 lamps; the node over most of them begins or ends near it in the order of leaves.
  Rng rng(4);
  std::vector<Vec3> positions{{1e8f, 0, 0}};
  std::vector<float> intensities{1e18f};
  for (int i = 0; i < 2000; ++i) {
    positions.emplace_back(rng.uniform(), rng.uniform(), rng.uniform());
    intensities.push_back(rng.uniform(1, 2));
  }
  const LightTree tree = pointTree(positions, intensities);
  const std::uint32_t sun = tree.leafOf(LightId{0});
  int looked = 0;
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const LightTreeNode& node = tree.nodes()[i];
    const std::uint32_t first = tree.firstLeaf(NodeId{i});
    if (node.leafCount() < 10 || sun - first < node.leafCount()) continue;
    ++looked;
    for (std::uint32_t leaf = first; leaf < first + node.leafCount(); ++leaf) {
      const double expected = static_cast<double>(intensities[static_cast<std::size_t>(tree.light(leaf))]) /
                              static_cast<double>(node.intensity());
      ASSERT_NEAR(tree.pmfByIntensity(static_cast<NodeId>(i), leaf) / expected, 1, 1e-3) << i << " " << leaf;
    }
  }
  EXPECT_GT(looked, 50);
}

TEST(LightTree, ProbabilitiesByIntensityAddUpAndAreThoseOfTheDraw) {
  // More than a block of running sums, so that the walk down to one is in it.
  Rng rng(3);
  std::vector<Vec3> positions;
  std::vector<float> intensities;
  for (int i = 0; i < 5000; ++i) {
    positions.emplace_back(rng.uniform(), rng.uniform(), rng.uniform());
    intensities.push_back(std::pow(10.0f, rng.uniform(-12, 0)));
  }
  const LightTree tree = pointTree(positions, intensities);
  double sum = 0;
  for (std::uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) sum += tree.pmfByIntensity(tree.root(), leaf);
  EXPECT_NEAR(sum, 1, 1e-12);  // five thousand double roundings
  for (const double u : {0.0, 0.1, 0.5, 0.9, 1 - 0x1p-24, 1 - 0x1p-53}) {
    const SampledLeaf leaf = tree.sampleByIntensity(tree.root(), 0, 5000, u);
    EXPECT_EQ(leaf.pmf, tree.pmfByIntensity(tree.root(), leaf.leaf));
    EXPECT_GT(leaf.pmf, 0);
  }
}

}  // namespace
}  // namespace cellcut::test
