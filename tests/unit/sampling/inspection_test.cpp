#include "renderer/sampling/inspection.h"

#include "tests/support/depth.h"
#include "tests/support/shading_points.h"
#include "tests/support/strategies.h"

#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Probabilities are read from the weights that sampling uses; what is left are roundings of pmf() to float.
constexpr double kPmfRounding = 1e-5;

/// Strategies with cuts, with clusters of one light and with clusters of many.
constexpr std::array kCutVariants{
    SamplerVariant{"cell_cut", Strategy::kCellCut, {.gridResolution = 4}},
    SamplerVariant{"cell_cut_intensity",
                   Strategy::kCellCut,
                   {.maxCut = 12, .gridResolution = 4, .inCluster = InCluster::kIntensity}},
    SamplerVariant{"cell_cut_descent", Strategy::kCellCut, {.maxCut = 12, .gridResolution = 4}},
    SamplerVariant{"point_cut_intensity", Strategy::kPointCut, {.maxCut = 12, .inCluster = InCluster::kIntensity}},
    SamplerVariant{"point_cut_descent", Strategy::kPointCut, {.maxCut = 12}},
};

class CutInspection : public testing::TestWithParam<std::tuple<SamplerVariant, LightMix>> {
 protected:
  CutInspection() {
    std::vector<Vec3> pilot;
    for (ShadingPoint& point : points) {
      pilot.push_back(point.p);
      point.lobe = {};  // inspection is of the choice by the cut
    }
    sampler = makeLightSampler(variant().strategy, lights, variant().settings, pilot);
    inspector = CutInspector::of(*sampler);
    EXPECT_GE(points.size(), 30u);
    points.resize(sampleShare(points.size()));
  }
  static const SamplerVariant& variant() { return std::get<0>(GetParam()); }
  static LightMix mix() { return std::get<1>(GetParam()); }
  double pmf(const ShadingPoint& point, LightId light) const { return static_cast<double>(sampler->pmf(point, light)); }

  Scene scene = stage(mix(), 200, 40 + static_cast<std::uint64_t>(mix()));
  Lights lights{scene};
  std::vector<ShadingPoint> points = pathVertices(scene, 60, 7);
  std::unique_ptr<LightSampler> sampler;
  std::optional<CutInspector> inspector;
};

TEST_P(CutInspection, ProbabilitiesAreTheSamplersOwn) {
  ASSERT_TRUE(inspector);
  for (const ShadingPoint& point : points) {
    double chosen = 0, sumOfPmf = 0;
    for (const ClusterInspection& cluster : inspector->inspect(point).clusters) {
      double inCluster = 0;
      for (const LightId light : inspector->lights(cluster)) inCluster += pmf(point, light);
      chosen += cluster.probability;
      sumOfPmf += inCluster;
      // A descent can end where none of the lights below is above the horizon: then less comes out than went in.
      const bool canEndInNothing = variant().settings.inCluster == InCluster::kDescent && cluster.lightCount > 1;
      ASSERT_LE(inCluster, cluster.probability + kPmfRounding);
      if (!canEndInNothing) {
        ASSERT_NEAR(inCluster, cluster.probability, kPmfRounding);
      }
    }
    if (sumOfPmf > 0) {
      ASSERT_NEAR(chosen, 1, kPmfRounding);
    }
    double everyLight = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) everyLight += pmf(point, static_cast<LightId>(i));
    ASSERT_NEAR(sumOfPmf, everyLight, kPmfRounding);  // no light that can be drawn is missing from the clusters
  }
}

TEST_P(CutInspection, WhatComesOutOfADescentIsWhatWentInLessWhatEndsInNothing) {
  for (const ShadingPoint& point : points) {
    double chosen = 0, everyLight = 0;
    for (const ClusterInspection& cluster : inspector->inspect(point).clusters) chosen += cluster.probability;
    for (std::size_t i = 0; i < lights.size(); ++i) everyLight += pmf(point, static_cast<LightId>(i));
    constexpr int kDraws = 4000;
    int nothing = 0;
    for (int i = 0; i < kDraws; ++i) nothing += sampler->sample(point, (i + 0.5) / kDraws) ? 0 : 1;
    // Evenly spaced numbers meet each of at most 400 intervals but for its ends.
    ASSERT_NEAR(static_cast<double>(nothing) / kDraws, 1 - everyLight, 400.0 / kDraws);
    if (chosen == 0) {
      ASSERT_EQ(nothing, kDraws);
    }
  }
}

TEST_P(CutInspection, HoldsEachLightOnceAndItsBoxAroundThem) {
  for (const ShadingPoint& point : points) {
    std::set<LightId> seen;
    for (const ClusterInspection& cluster : inspector->inspect(point).clusters) {
      const std::vector<LightId> inside = inspector->lights(cluster);
      ASSERT_EQ(inside.size(), cluster.lightCount);
      ASSERT_EQ(cluster.box.empty(), cluster.distant);
      ASSERT_GT(cluster.estimate, 0);
      for (const LightId light : inside) {
        ASSERT_TRUE(seen.insert(light).second);
        const LightKind kind = lights.kind(light);
        const std::size_t i = lights.indexInKind(light);
        ASSERT_EQ(cluster.distant, kind == LightKind::kDirectional || kind == LightKind::kEnvironment);
        if (kind == LightKind::kPoint || kind == LightKind::kSpot) {
          const Vec3 p = kind == LightKind::kPoint ? scene.pointLights[i].position : scene.spotLights[i].position;
          ASSERT_EQ(glm::clamp(p, cluster.box.lower, cluster.box.upper), p);
        }
        if (kind == LightKind::kDirectional) {
          // Half of the 16 bits of a node's cone, see LightTreeNode::axes().
          const float cosine = glm::dot(cluster.directions.axis, -scene.directionalLights[i].axis);
          ASSERT_LE(std::acos(std::min(cosine, 1.0f)), std::acos(cluster.directions.cosTheta) + 1e-3f);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, CutInspection,
                         testing::Combine(testing::ValuesIn(kCutVariants), testing::ValuesIn(kLightMixes)),
                         strategyAndLightsName);

/// A cell-cut sampler over a stage.
struct CellCutStage {
  explicit CellCutStage(SamplerSettings settings)
      : sampler(makeLightSampler(Strategy::kCellCut, lights, settings, std::array{Vec3(-1), Vec3(1)})),
        inspector(*CutInspector::of(*sampler)) {}
  Scene scene = stage(LightMix::kAll, 300, 5);
  Lights lights{scene};
  std::unique_ptr<LightSampler> sampler;
  CutInspector inspector;
  ShadingPoint point{Vec3(0.1f, 0.2f, 0.3f), Vec3(0, 1, 0)};
};

TEST(CutInspector, LooksWithoutTouching) {
  const CellCutStage s({.countVisits = true});
  const auto before = s.inspector.inspect(s.point);
  EXPECT_FALSE(before.kept);
  EXPECT_EQ(s.sampler->statistics().grid->made(), 0u);
  EXPECT_EQ(s.sampler->statistics().cut->seconds, 0);

  for (int i = 0; i < 5; ++i) s.sampler->sample(s.point, 0.2 * i);
  const auto after = s.inspector.inspect(s.point);
  EXPECT_TRUE(after.kept);
  EXPECT_EQ(after.visits, 5u);
  EXPECT_EQ(s.inspector.inspect(s.point).visits, 5u);
  // The cut that was found for the looker is the one that the path made.
  ASSERT_EQ(before.clusters.size(), after.clusters.size());
  for (std::size_t i = 0; i < before.clusters.size(); ++i) {
    EXPECT_EQ(before.clusters[i].node, after.clusters[i].node);
    EXPECT_EQ(before.clusters[i].probability, after.clusters[i].probability);
  }
}

TEST(CutInspector, VisitsAreCountedOnlyWhereAskedFor) {
  const CellCutStage s({});
  s.sampler->sample(s.point, 0.5);
  EXPECT_TRUE(s.inspector.inspect(s.point).kept);
  EXPECT_EQ(s.inspector.inspect(s.point).visits, 0u);
}

TEST(CutInspector, SummaryIsThatOfTheClusters) {
  const CellCutStage s({.maxCut = 400});
  s.sampler->sample(s.point, 0.5);
  const auto inspection = s.inspector.inspect(s.point);
  const CutSummary summary = s.inspector.summary(*s.inspector.find(*inspection.cell));
  double estimate = 0;
  int depth = 0;
  for (const ClusterInspection& c : inspection.clusters) {
    estimate += c.estimate;
    depth = std::max(depth, c.depth);
  }
  EXPECT_EQ(summary.size, inspection.clusters.size());
  EXPECT_EQ(summary.estimate, estimate);
  EXPECT_EQ(summary.depth, depth);
  EXPECT_GT(summary.depth, 3);  // 300 lights in 100 clusters at least: a coarse cell has a quarter of 400
}

// One point light is one cluster whose box is a point: its estimate for a point is its irradiance of a surface that
// faces it, in W/m² whatever unit the trees count in.
TEST(CutInspector, EstimatesAreInWattsPerSquareMetre) {
  Scene scene;
  scene.pointLights.push_back({Vec3(0, 2, 0), Vec3(12.0f)});
  scene.pointLights.push_back({Vec3(0, 20, 0), Vec3(4000.0f)});
  finish(scene);
  const Lights lights(scene);
  const auto sampler = makeLightSampler(Strategy::kPointCut, lights, {.threshold = 0});
  const auto inspection = CutInspector::of(*sampler)->inspect({Vec3(0), Vec3(0, 1, 0)});
  ASSERT_EQ(inspection.clusters.size(), 2u);
  std::set<double> estimates;
  for (const auto& c : inspection.clusters) estimates.insert(std::round(c.estimate * 1e4) / 1e4);
  EXPECT_EQ(estimates, (std::set<double>{3, 10}));
  EXPECT_FALSE(inspection.cell);
}

TEST(CutInspector, StrategiesWithoutCutsHaveNone) {
  const Scene scene = stage(LightMix::kPoint, 4, 1);
  const Lights lights(scene);
  for (const Strategy strategy :
       {Strategy::kUniform, Strategy::kPower, Strategy::kProportional, Strategy::kLightTree}) {
    EXPECT_FALSE(CutInspector::of(*makeLightSampler(strategy, lights)));
  }
}

TEST(CutInspector, DepthIsTheNumberOfStepsFromTheRoot) {
  const Scene scene = stage(LightMix::kPoint, 100, 2);
  const Lights lights(scene);
  const LightTrees trees(lights);
  const LightTree& tree = trees.local;
  EXPECT_EQ(depthOf(tree, tree.root()), 0);
  const NodeId below = tree.left(tree.right(tree.left(tree.root())));
  EXPECT_EQ(depthOf(tree, below), 3);
  EXPECT_EQ(depthOf(tree, tree.right(tree.root())), 1);
}

TEST(GridGeometry, BoxesHoldTheirPointsAndShareCorners) {
  Bounds box;
  box.add(Vec3(-3, 1, 2));
  box.add(Vec3(5, 2, 4));
  const GridGeometry grid(box, 7);
  const Vec3 p(0.3f, 1.2f, 3.9f);
  for (const bool indirect : {false, true}) {
    const CellCoordinates cell = *grid.cellOf(p, indirect);
    EXPECT_EQ(cell.coarse, indirect);
    const Bounds b = grid.box(cell);
    EXPECT_EQ(glm::clamp(p, b.lower, b.upper), p);
    EXPECT_EQ(grid.box({cell.x + 1, cell.y + 1, cell.z + 1, cell.coarse}).lower, b.upper);
  }
}

}  // namespace
}  // namespace cellcut::test
