#include "ui/overlays/cell_inspector.h"

#include "renderer/lights/scalar_emission.h"
#include "renderer/scene/camera.h"
#include "tests/support/frozen_render.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut::test {
namespace {

/// Points per side of the midpoint rule in these tests.
constexpr int kPerSide = 24;

/// A rendering with clusters of many lights, and the reports of some of its pixels.
struct Inspected {
  explicit Inspected(const Scene& scene, Strategy strategy = Strategy::kCellCut)
      : run(scene, {.strategy = strategy, .sampler = {.maxCut = 12, .gridResolution = 4, .countVisits = true}}) {}
  PixelReport at(int x, int y, int perSide = kPerSide) const {
    const InspectionInputs inputs{run.scene,         run.accel, run.lights,     *run.sampler,     run.camera(),
                                  run.settings.size, &mean,     &standardError, run.film.passes()};
    return *inspectPixel(inputs, {x, y}, perSide, kNever);
  }
  FrozenRender run;
  ImageRgb mean = run.film.mean(), standardError = run.film.standardError();
};

class InspectorTruth : public testing::TestWithParam<LightMix> {};

TEST_P(InspectorTruth, ContributionsAreThoseOfAnIndependentSum) {
  const Scene scene = stage(GetParam(), 200, 21);
  const Inspected inspected(scene);
  const CutInspector inspector = *CutInspector::of(*inspected.run.sampler);
  std::size_t shadowed = 0;
  for (const glm::ivec2 pixel : {glm::ivec2(16, 12), glm::ivec2(9, 15), glm::ivec2(20, 18), glm::ivec2(13, 9)}) {
    const PixelReport report = inspected.at(pixel.x, pixel.y);
    ASSERT_TRUE(report.hit.hit());
    for (const ClusterRow& row : report.clusters) {
      double unoccluded = 0, visible = 0;
      for (const LightId light : inspector.lights(row.cluster)) {
        const ShadingPoint& point = report.hit.point;
        const auto sum = [&](const Accel* occluders) {
          return scalarEmission(
              referenceIrradiance(inspected.run.lights, light, point.p, point.n, kPerSide, occluders));
        };
        unoccluded += sum(nullptr);
        visible += sum(&inspected.run.accel);
      }
      // Midpoint rules of 24² points over other coordinates: the smooth integrand to a thousandth, a shadow's edge to
      // the points along it, 1/24, and on average over a cluster's lights to a fraction of that. What is left of a
      // light that is cut by the horizon is a smaller part of all light.
      const double horizon = 1e-5 * report.unoccluded;
      EXPECT_NEAR(row.contribution.unoccluded, unoccluded, 2e-3 * unoccluded + horizon);
      EXPECT_NEAR(row.contribution.visible, visible, 2e-2 * unoccluded + horizon);
      EXPECT_LE(row.contribution.visible, row.contribution.unoccluded * (1 + 1e-12));
      if (visible < 0.99 * unoccluded) ++shadowed;
    }
  }
  EXPECT_GT(shadowed, 0u);
}

INSTANTIATE_TEST_SUITE_P(Every, InspectorTruth, testing::ValuesIn(kLightMixes),
                         [](const auto& mix) { return nameOf(mix.param); });

TEST(PixelReport, SumsAndSharesFitTogether) {
  const Scene scene = stage(LightMix::kAll, 200, 3);
  const Inspected inspected(scene);
  const PixelReport report = inspected.at(16, 12, 4);
  ASSERT_EQ(report.clusters.size(), 12u);
  double probability = 0, share = 0, mismatch = 0, visible = 0, distance = 0;
  std::size_t lights = 0;
  for (const ClusterRow& row : report.clusters) {
    probability += row.cluster.probability;
    share += row.share;
    mismatch += row.mismatch;
    distance += std::abs(row.cluster.probability - row.contribution.visible / report.visible) / 2;
    visible += row.contribution.visible;
    lights += row.cluster.lightCount;
  }
  EXPECT_NEAR(probability, 1, 1e-6);  // the far clusters' probabilities are floats
  EXPECT_NEAR(share, 1, 1e-12);
  EXPECT_NEAR(mismatch, 0, 1e-6);
  EXPECT_NEAR(report.visible, visible, 1e-12 * visible);
  ASSERT_TRUE(report.distance);
  EXPECT_NEAR(*report.distance, distance, 1e-12);
  EXPECT_GT(*report.distance, 0);
  EXPECT_LT(*report.distance, 1);
  EXPECT_LE(lights, inspected.run.lights.size());
}

TEST(PixelReport, BoxesHoldTheirLightsAndTheCellItsPoint) {
  const Scene scene = stage(LightMix::kPoint, 200, 3);
  const Inspected inspected(scene);
  const CutInspector inspector = *CutInspector::of(*inspected.run.sampler);
  const PixelReport report = inspected.at(16, 12, 1);
  std::size_t lights = 0;
  for (const ClusterRow& row : report.clusters) {
    for (const LightId light : inspector.lights(row.cluster)) {
      const Vec3 p = scene.pointLights[indexOf(light)].position;
      EXPECT_EQ(glm::clamp(p, row.cluster.box.lower, row.cluster.box.upper), p);
      ++lights;
    }
  }
  EXPECT_EQ(lights, 200u);
  const Vec3 p = report.hit.point.p;
  EXPECT_EQ(glm::clamp(p, report.cellBox.lower, report.cellBox.upper), p);
  EXPECT_TRUE(report.kept);
  EXPECT_GT(report.visits, 0u);
}

TEST(PixelReport, ReadsTheFilm) {
  const Scene scene = stage(LightMix::kPoint, 20, 3);
  const Inspected inspected(scene);
  const PixelReport report = inspected.at(10, 11, 1);
  EXPECT_EQ(report.samples, 2u);
  EXPECT_EQ(report.radiance, inspected.mean.at(10, 11));
  const glm::dvec3 error(inspected.standardError.at(10, 11));
  EXPECT_NEAR(*report.variance, 2 * glm::dot(error, error) / 3, 1e-12);
}

TEST(PixelReport, SaysWhereThereIsNothing) {
  const Scene scene = stage(LightMix::kPoint, 20, 3);
  const Inspected cuts(scene), uniform(scene, Strategy::kUniform);
  int i = 0;
  while (i + 1 < 32 * 24 && cuts.at(i % 32, i / 32, 1).hit.hit()) ++i;
  const PixelReport sky = cuts.at(i % 32, i / 32, 1);
  ASSERT_FALSE(sky.hit.hit());
  EXPECT_TRUE(sky.clusters.empty());
  EXPECT_FALSE(sky.distance);
  const auto json = toJson(sky);
  EXPECT_TRUE(json["hit"].is_null());
  EXPECT_TRUE(json["cut"].is_null());

  const PixelReport noCut = uniform.at(16, 12, 1);
  EXPECT_TRUE(noCut.hit.hit());
  EXPECT_FALSE(noCut.hasCut);
  EXPECT_TRUE(toJson(noCut)["cut"].is_null());
}

TEST(PixelReport, OfAPointCutHasNoCell) {
  const Scene scene = stage(LightMix::kPoint, 20, 3);
  const Inspected inspected(scene, Strategy::kPointCut);
  const PixelReport report = inspected.at(16, 12, 1);
  EXPECT_TRUE(report.hasCut);
  EXPECT_FALSE(report.cell);
  EXPECT_EQ(report.clusters.size(), 12u);
  EXPECT_TRUE(toJson(report)["cut"]["cell"].is_null());
}

TEST(PixelReport, StopsWhenItIsTold) {
  const Scene scene = stage(LightMix::kPoint, 20, 3);
  const FrozenRender run(scene, {});
  const std::atomic<bool> now{true};
  EXPECT_FALSE(
      inspectPixel({scene, run.accel, run.lights, *run.sampler, run.camera(), run.settings.size}, {16, 12}, 1, now));
}

TEST(PixelReport, JsonHasTheTable) {
  const Scene scene = stage(LightMix::kAll, 100, 3);
  const Inspected inspected(scene);
  const PixelReport report = inspected.at(16, 12, 2);
  const auto json = nlohmann::json::parse(toJson(report).dump());
  EXPECT_EQ(json["pixel"], (nlohmann::json{16, 12}));
  EXPECT_EQ(json["hit"]["point"][1], report.hit.point.p.y);
  EXPECT_EQ(json["cut"]["cell"][0], report.cell->x);
  EXPECT_EQ(json["cut"]["box"][1][2], report.cellBox.upper.z);
  EXPECT_EQ(json["cut"]["size"], report.clusters.size());
  ASSERT_EQ(json["cut"]["clusters"].size(), report.clusters.size());
  std::size_t distant = 0;
  for (std::size_t i = 0; i < report.clusters.size(); ++i) {
    const ClusterRow& row = report.clusters[i];
    const auto& entry = json["cut"]["clusters"][i];
    EXPECT_EQ(entry["kind"], row.cluster.distant ? "distant" : "local");
    EXPECT_EQ(entry.contains("box"), !row.cluster.distant);
    EXPECT_EQ(entry["lights"], row.cluster.lightCount);
    EXPECT_EQ(entry["probability"], row.cluster.probability);
    EXPECT_EQ(entry["visible"], row.contribution.visible);
    EXPECT_EQ(entry["mismatch"], row.mismatch);
    distant += row.cluster.distant ? 1 : 0;
  }
  EXPECT_GT(distant, 0u);
  EXPECT_LT(distant, report.clusters.size());
}

}  // namespace
}  // namespace cellcut::test
