// Extremes of lights: how many, how bright, and where. For every strategy.
#include "renderer/base/rng.h"
#include "renderer/lights/light_tree.h"
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/support/frozen_render.h"
#include "tests/support/nightly.h"
#include "tests/support/probabilities.h"
#include "tests/support/shading_points.h"
#include "tests/support/strategies.h"

namespace cellcut::test {
namespace {

/// Every kind of light by itself.
constexpr std::array kKinds{LightMix::kPoint, LightMix::kSpot, LightMix::kTriangle, LightMix::kDirectional,
                            LightMix::kEnvironment};

Vec3 unitVector(Rng& rng) {
  const float z = rng.uniform(-1, 1), azimuth = rng.uniform(0, 2 * kPi), r = safeSqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Multiplies the lights of each kind by one and the other in turn.
void scaleInTurn(Scene& scene, float even, float odd) {
  const auto factor = [=](std::size_t i) { return i % 2 == 0 ? even : odd; };
  for (std::size_t i = 0; i < scene.pointLights.size(); ++i) scene.pointLights[i].intensity *= factor(i);
  for (std::size_t i = 0; i < scene.spotLights.size(); ++i) scene.spotLights[i].intensity *= factor(i);
  for (std::size_t i = 0; i < scene.directionalLights.size(); ++i) scene.directionalLights[i].irradiance *= factor(i);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) scene.materials[i].emission *= factor(i);
  if (!scene.environment) return;
  ImageRgb& sky = scene.environment->radiance;
  for (std::size_t i = 0; i < sky.size(); ++i) sky[i] *= factor(i);
}

/// A light that adds less than this share of all may have no probability at all.
constexpr double kReach = 1e-12;

Scene pointLightsAt(const std::vector<Vec3>& positions) {
  Scene scene;
  for (const Vec3& position : positions) scene.pointLights.push_back({position, Vec3(1)});
  finish(scene);
  return scene;
}

double meanOf(const ImageRgb& picture) {
  double sum = 0;
  for (const Vec3& pixel : picture) sum += luminance(glm::dvec3(pixel));
  return sum / static_cast<double>(picture.size());
}

class ExtremeLights : public testing::TestWithParam<SamplerVariant> {
 protected:
  std::unique_ptr<LightSampler> samplerOf(const Lights& lights, std::span<const Vec3> pilot = {}) const {
    return makeLightSampler(GetParam().strategy, lights, GetParam().settings, pilot);
  }
  void expectSoundAt(const Scene& scene, std::span<const ShadingPoint> points, double reach = 0) const {
    const Lights lights(scene);
    const auto sampler = samplerOf(lights);
    for (const ShadingPoint& point : points) expectSoundPmfs(*sampler, lights, point, reach);
  }
  /// A finite picture.
  ImageRgb render(const Scene& scene) const {
    RenderSettings settings;
    settings.width = 32;
    settings.height = 24;
    settings.strategy = GetParam().strategy;
    settings.sampler = GetParam().settings;
    Renderer renderer(scene, settings);
    const std::atomic<bool> cancel{false};
    for (int pass = 0; pass < 2; ++pass) EXPECT_TRUE(renderer.renderPass(cancel));
    EXPECT_EQ(renderer.film().badSamples().nan, 0u);
    EXPECT_EQ(renderer.film().badSamples().inf, 0u);
    for (const Vec3& error : renderer.film().standardError()) EXPECT_TRUE(isFinite(error));
    return renderer.film().mean();
  }
};

TEST_P(ExtremeLights, NoneAtAllMakeABlackPicture) {
  const Scene scene = stage(LightMix::kPoint, 0, 1);
  const Lights lights(scene);
  EXPECT_FALSE(samplerOf(lights)->sample(pathVertices(scene, 1, 1)[0], 0.5));
  for (const Vec3& pixel : render(scene)) ASSERT_EQ(pixel, Vec3(0));
}

TEST_P(ExtremeLights, TheOnlyOneIsDrawnForSure) {
  for (const LightMix kind : kKinds) {
    SCOPED_TRACE(nameOf(kind));
    Scene scene = stage(kind, 1, 2);
    for (Material& material : scene.materials) material.doubleSided = true;  // else one triangle may turn its back
    const Lights lights(scene);
    ASSERT_EQ(lights.size(), 1u);
    const auto sampler = samplerOf(lights);
    int drawn = 0;
    for (const ShadingPoint& point : pathVertices(scene, 30, 2)) {
      const auto sample = sampler->sample(point, 0.3);
      if (!sample) continue;
      ++drawn;
      EXPECT_NEAR(sample->pmf, 1, 1e-6);  // of a sum of two ways to choose, each rounded
    }
    EXPECT_GT(drawn, 0);
  }
}

TEST_P(ExtremeLights, TwelveDecadesApartAllHaveAProbability) {
  for (const LightMix kind : kKinds) {
    SCOPED_TRACE(nameOf(kind));
    Scene scene = stage(kind, 64, 3);
    scaleInTurn(scene, 1, 1e-12f);
    expectSoundAt(scene, pathVertices(scene, 12, 3));
  }
}

TEST_P(ExtremeLights, Of1e30And1e_30InOneSceneMakeAFinitePicture) {
  Scene scene = stage(LightMix::kAll, 120, 4);
  scaleInTurn(scene, 1e30f, 1e-30f);
  expectSoundAt(scene, pathVertices(scene, 12, 4), kReach);
  EXPECT_GT(meanOf(render(scene)), 1e28);
}

TEST_P(ExtremeLights, AtTheShadingPointItselfSendNothingAndBreakNothing) {
  // One point, hit by every ray of a camera that sees 10⁻³⁰ m.
  Scene scene;
  addTriangle(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scene.cameras.push_back(orthographic({0.25f, 0.25f, 1}, {0.25f, 0.25f, 0}, 1e-30f));
  scene.pointLights.push_back({{0, 0, 1}, Vec3(1)});
  finish(scene);
  const Vec3 p = FrozenRender(scene, {.size = {1, 1}, .passes = 1}).vertices.at(0).p;
  scene.pointLights = {{p, Vec3(1)}};
  for (const Vec3& pixel : render(scene)) ASSERT_EQ(pixel, Vec3(0));
  // The others go on.
  scene.pointLights.push_back({{0.2f, 0.3f, 0.5f}, Vec3(1)});
  finish(scene);
  expectSoundAt(scene, std::array{ShadingPoint{p, {0, 0, 1}}});
  EXPECT_GT(meanOf(render(scene)), 0);
}

TEST(LightsAtTheShadingPoint, AreCounted) {
  Scene scene;
  addTriangle(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scene.cameras.push_back(orthographic({0.25f, 0.25f, 1}, {0.25f, 0.25f, 0}, 1e-30f));
  scene.pointLights.push_back({{0, 0, 1}, Vec3(1)});
  finish(scene);
  scene.pointLights[0].position = FrozenRender(scene, {.size = {1, 1}, .passes = 1}).vertices.at(0).p;
  RenderSettings settings;
  settings.width = settings.height = 4;
  settings.strategy = Strategy::kUniform;
  Renderer renderer(scene, settings);
  renderer.renderPass(std::atomic<bool>{false});
  EXPECT_EQ(renderer.droppedSamples(), 16u);
}

TEST_P(ExtremeLights, InsideACellAndOnItsBorderHaveAProbability) {
  // Cells of 1 m; lights in the middle of one, on its faces, edges and corners.
  std::vector<Vec3> pilot(2000);
  Rng rng(6);
  for (Vec3& p : pilot) p = 4.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
  const Scene scene =
      pointLightsAt({{1.5f, 1.5f, 1.5f}, {1, 1.5f, 1.5f}, {2, 1.5f, 1.2f}, {1, 1, 1.5f}, {2, 2, 2}, {1, 1, 1}});
  const Lights lights(scene);
  const auto sampler = samplerOf(lights, pilot);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = Vec3(0.9f) + 1.2f * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    expectSoundPmfs(*sampler, lights, {p, unitVector(rng)});
  }
}

struct Arrangement {
  const char* name;
  std::vector<Vec3> positions;
};

std::vector<Arrangement> arrangements() {
  std::vector<Arrangement> all{{"coincident", {}}, {"collinear", {}}, {"coplanar", {}}, {"powers of two apart", {}}};
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    all[0].positions.emplace_back(0.3f, -0.2f, 0.7f);
    all[1].positions.push_back(rng.uniform(-1, 1) * Vec3(0.6f, 0.64f, 0.48f));
    all[2].positions.emplace_back(rng.uniform(-1, 1), 0, rng.uniform(-1, 1));
  }
  for (int i = -60; i <= 60; ++i) all[3].positions.emplace_back(std::ldexp(1.0f, i), 0, 0);
  return all;
}

TEST_P(ExtremeLights, CoincidentCollinearCoplanarOrPowersOfTwoApartHaveExactProbabilities) {
  for (const Arrangement& arrangement : arrangements()) {
    SCOPED_TRACE(arrangement.name);
    const Scene scene = pointLightsAt(arrangement.positions);
    const std::size_t anywhere = sampleShare(10);
    std::vector<ShadingPoint> points;
    points.reserve(anywhere + 2);
    Rng rng(8);
    for (std::size_t i = 0; i < anywhere; ++i) points.push_back({2.0f * unitVector(rng), unitVector(rng)});
    points.push_back({arrangement.positions[0], {0, 1, 0}});
    points.push_back({0.5f * (arrangement.positions[0] + arrangement.positions[1]), {0, 0, 1}});
    expectSoundAt(scene, points, kReach);
  }
}

TEST(LightTreeOfExtremes, IsNoDeeperThanItsStackWhateverTheArrangement) {
  for (const Arrangement& arrangement : arrangements()) {
    const Scene scene = pointLightsAt(arrangement.positions);
    const LightTree tree(localBounds(Lights(scene), 0), LightId{0}, false);
    EXPECT_EQ(tree.leafCount(), arrangement.positions.size()) << arrangement.name;
    EXPECT_LE(tree.depth(), 96) << arrangement.name;  // light_tree.cpp, kMaxCostDepth
  }
}

TEST(TenMillionLights, TakeAtMost120BytesEachAndTheirPmfsSumToOne) {
  if (!isNightly()) GTEST_SKIP() << "two minutes and 2 GB: ./dev nightly";
  constexpr std::size_t kCount = 10'000'000;
  Scene scene;
  scene.pointLights.reserve(kCount);
  Rng rng(9);
  for (std::size_t i = 0; i < kCount; ++i)
    scene.pointLights.push_back({Vec3(rng.uniform(), rng.uniform(), rng.uniform()), Vec3(rng.uniform(0.01f, 1))});
  finish(scene);
  const Lights lights(scene);
  for (const Strategy strategy : {Strategy::kCellCut, Strategy::kLightTree}) {
    SCOPED_TRACE(nameOf(strategy));
    const auto sampler = makeLightSampler(strategy, lights, {}, {});
    EXPECT_LE(static_cast<double>(lights.bytes() + sampler->bytes()) / kCount + sizeof(PointLight), 120);
    const ShadingPoint point{{0.5f, 0.5f, 1.5f}, {0, 0, -1}};
    double sum = 0;
    for (std::size_t i = 0; i < kCount; ++i)
      sum += static_cast<double>(sampler->pmf(point, static_cast<LightId>(static_cast<std::uint32_t>(i))));
    EXPECT_NEAR(sum, 1, 1e-6);  // pmfs are floats
    for (int i = 0; i < 10'000; ++i) {
      const auto drawn = sampler->sample(point, rng.uniformDouble());
      ASSERT_TRUE(drawn);
      ASSERT_EQ(drawn->pmf, sampler->pmf(point, drawn->light));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ExtremeLights, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
