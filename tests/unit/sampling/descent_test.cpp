#include "renderer/sampling/descent.h"

#include "renderer/base/rng.h"
#include "renderer/sampling/mirrored_lights.h"
#include "renderer/scene/ggx.h"
#include "tests/support/scenes.h"
#include "tests/support/vectors.h"

#include <map>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// A thousand lights of all kinds in a room of about two metres, and points in it.
struct Room {
  Scene scene = stage(LightMix::kAll, 1000, 3);
  Lights lights{scene};
  LightTrees trees{lights};
  Rng rng{7};

  ShadingPoint point(float alpha) {
    const auto inRoom = [&] { return rng.uniform(-1.2f, 1.2f); };
    const Vec3 n = randomUnit(rng), any = randomUnit(rng);
    const Vec3 wo = glm::dot(any, n) < 0 ? -any : any;
    return {Vec3(inRoom(), inRoom(), inRoom()), n, {wo, alpha, 1}};
  }
  template <class Use>
  void forEachTree(const Use& use) const {
    use(trees.local, false);
    use(trees.distant, true);
  }
};

/// The importance by way of the clusters that cuts are made of, without SIMD.
/// \param most  out: what it is where no cosine is below 1
double scalarImportance(const LightTree& tree, bool distant, NodeId node, const Vec3& p, const Vec3& n, double& most) {
  const std::optional<Cluster> cluster =
      distant ? std::optional(distantCluster(tree, node)) : localCluster(tree, node, Region{p, 0});
  most = cluster ? static_cast<double>(tree.node(node).intensity()) : 0.0;
  if (!cluster) return 0;
  if (!distant) most /= static_cast<double>(cluster->meanDistance) * static_cast<double>(cluster->meanDistance);
  return static_cast<double>(cluster->estimate) *
         static_cast<double>(receiverCosine(glm::dot(n, cluster->direction), cluster->cosThetaU, cluster->sinThetaU));
}

TEST(Descent, WeighsNodesAsTheirClustersWithoutSimd) {
  Room room;
  for (int i = 0; i < 20; ++i) {
    const ShadingPoint point = room.point(1);
    room.forEachTree([&](const LightTree& tree, bool distant) {
      for (std::uint32_t node = 0; node < tree.nodes().size(); ++node) {
        double most;
        const double expected = scalarImportance(tree, distant, NodeId{node}, point.p, point.n, most);
        // Multiplications and additions are fused here and not there: some roundings of cosines at the point and at the
        // lights, each a sum whose terms may cancel, and a sine that has a multiple of its cosine's.
        ASSERT_NEAR(importanceOf(tree, distant, NodeId{node}, {point.p, point.n}), expected, 5e-6 * most);
      }
    });
  }
}

/// The nodes two levels below one; a child that is a light is there itself.
std::vector<NodeId> nodesBelow(const LightTree& tree, NodeId node) {
  std::vector<NodeId> below;
  for (const NodeId child : {tree.left(node), tree.right(node)}) {
    if (tree.isLeaf(child)) {
      below.push_back(child);
    } else {
      below.push_back(tree.left(child));
      below.push_back(tree.right(child));
    }
  }
  return below;
}

double pmfOneByOne(const LightTree& tree, bool distant, const NodeImportance& importance, std::uint32_t leaf) {
  NodeId node = tree.root();
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    double sum = 0, weight = 0;
    NodeId holder = node;
    for (const NodeId below : nodesBelow(tree, node)) {
      const double w = importanceOf(tree, distant, below, importance);
      sum += w;
      if (leaf < tree.firstLeaf(below)) continue;
      holder = below;
      weight = w;
    }
    if (!(sum > 0)) return 0;
    pmf *= weight / sum;
    node = holder;
  }
  return pmf;
}

TEST(Descent, StepsChooseAmongTheNodesTwoLevelsBelowByTheirImportance) {
  Room room;
  for (int i = 0; i < 10; ++i) {
    const ShadingPoint point = room.point(0.3f);
    for (const NodeImportance& importance : {NodeImportance{point.p, point.n}, mirroredImportance(point)}) {
      room.forEachTree([&](const LightTree& tree, bool distant) {
        for (std::uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
          const double expected = pmfOneByOne(tree, distant, importance, leaf);
          ASSERT_NEAR(pmfByDescent(tree, distant, tree.root(), importance, leaf), expected, 1e-12 * expected);
        }
      });
    }
  }
}

TEST(Descent, ALobeWeighsSingleLightsByGgx) {
  Room room;
  int above = 0;
  for (const float alpha : {0.012f, 0.1f, 0.5f, 0.9f}) {
    for (int i = 0; i < 20; ++i) {
      const ShadingPoint point = room.point(alpha);
      const LightTree& tree = room.trees.local;
      for (std::uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
        const LightId light = tree.light(leaf);
        if (room.lights.kind(light) != LightKind::kPoint) continue;
        NodeId node = tree.root();
        while (!tree.isLeaf(node)) node = leaf < tree.firstLeaf(tree.right(node)) ? tree.left(node) : tree.right(node);
        const Vec3 to = tree.node(node).lower() - point.p;
        const double weight = importanceOf(tree, false, node, mirroredImportance(point));
        if (!(glm::dot(to, point.n) > 0)) continue;
        ++above;
        const Vec3 h = Frame(point.n).toLocal(glm::normalize(glm::normalize(to) + point.lobe.wo));
        const double expected =
            std::ldexp(room.lights.irradiance(light, point.p, glm::normalize(to)), -room.trees.exponent) *
            static_cast<double>(kPi * ggxD(alpha, h));
        // sin² θh is a difference of numbers near 1, and D has its inverse square.
        ASSERT_NEAR(weight, expected, expected * (1e-5 + 1e-6 / static_cast<double>(alpha * alpha)));
      }
    }
  }
  EXPECT_GT(above, 1000);
}

TEST(Descent, PmfsOfAllLeavesAndOfNoneSumToOneAndAreThoseOfSamples) {
  Room room;
  for (int i = 0; i < 8; ++i) {
    const ShadingPoint point = room.point(i % 2 == 0 ? 0.1f : 1.0f);
    const NodeImportance importance = i % 2 == 0 ? mirroredImportance(point) : NodeImportance{point.p, point.n};
    room.forEachTree([&](const LightTree& tree, bool distant) {
      std::map<std::uint32_t, int> drawn;
      int none = 0;
      constexpr int kDraws = 100'000;
      for (int k = 0; k < kDraws; ++k) {
        const double u = (k + 0.5) / kDraws;
        const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, tree.root(), importance, u);
        if (!leaf) {
          ++none;
          continue;
        }
        if (drawn[leaf->leaf]++ == 0) {
          ASSERT_EQ(leaf->pmf, pmfByDescent(tree, distant, tree.root(), importance, leaf->leaf));
        }
      }
      double sum = 0;
      for (std::uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
        const double pmf = pmfByDescent(tree, distant, tree.root(), importance, leaf);
        sum += pmf;
        // Even numbers: what a leaf is drawn for is an interval of its pmf's width, and neighbours that end in none
        // leave it whole.
        ASSERT_NEAR(drawn[leaf], pmf * kDraws, 1 + 1e-6 * kDraws) << leaf;
      }
      EXPECT_NEAR(sum + static_cast<double>(none) / kDraws, 1, 1e-3 * (none > 0) + 1e-9);
    });
  }
}

TEST(Descent, AFaintLightFarAwayKeepsItsProbabilityInAnyUnitOfLength) {
  const auto faintPmf = [](int exponent) {
    Scene scene;
    for (const float faint : {1.0f, 1e-12f}) {
      const Vec3 position(1e5f, faint < 1 ? 1e3f : 0.0f, 0);
      scene.pointLights.push_back({std::ldexp(1.0f, exponent) * position, Vec3(std::ldexp(faint, 2 * exponent))});
      scene.bounds.add(scene.pointLights.back().position);
    }
    const Lights lights(scene);
    const LightTrees trees(lights);
    return pmfByDescent(trees.local, false, trees.local.root(), {Vec3(0), Vec3(1, 0, 0)},
                        trees.local.leafOf(LightId{1}));
  };
  const double plain = faintPmf(0);
  EXPECT_NEAR(plain / 1e-12, 1, 1e-3);  // it is farther away by 5 parts in 10⁵
  for (const int exponent : {-20, 20}) EXPECT_EQ(faintPmf(exponent), plain) << exponent;
  // Its estimate is a denormal number there, of 14 bits.
  EXPECT_NEAR(faintPmf(30) / plain, 1, 0x1p-13);
}

TEST(Descent, EndsOfTheUniformNumberFindLights) {
  Room room;
  for (int i = 0; i < 200; ++i) {
    const ShadingPoint point = room.point(1);
    for (const double u : {0.0, 0x1p-53, 1 - 0x1p-24, kAlmostOne}) {
      room.forEachTree([&](const LightTree& tree, bool distant) {
        const auto leaf = sampleByDescent(tree, distant, tree.root(), {point.p, point.n}, u);
        ASSERT_TRUE(!leaf || leaf->pmf > 0);
      });
    }
  }
}

}  // namespace
}  // namespace cellcut::test
