// Extremes of the places that a strategy is asked at, and of its grid of cells.
#include "renderer/base/rng.h"
#include "renderer/sampling/cut_weights.h"
#include "renderer/trace/renderer.h"
#include "tests/support/probabilities.h"
#include "tests/support/strategies.h"

namespace cellcut::test {
namespace {

Vec3 inUnitBox(Rng& rng) {
  return {rng.uniform(), rng.uniform(), rng.uniform()};
}

class ExtremePlaces : public testing::TestWithParam<SamplerVariant> {
 protected:
  void expectSoundAt(const Scene& scene, std::span<const Vec3> pilot, std::span<const Vec3> places) const {
    const Lights lights(scene);
    const auto sampler = makeLightSampler(GetParam().strategy, lights, GetParam().settings, pilot);
    for (const Vec3& p : places) {
      for (const Vec3& n : {Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(0.6f, -0.8f, 0)}) {
        SCOPED_TRACE(testing::Message() << p.x << " " << p.y << " " << p.z);
        expectSoundPmfs(GetParam(), *sampler, lights, {p, n}, kReach);
      }
    }
  }
};

TEST_P(ExtremePlaces, OutsideThePilotsBoxAndBeyondIntegerCellsAreAnswered) {
  const Scene scene = stage(LightMix::kAll, 60, 1);
  Rng rng(1);
  std::vector<Vec3> pilot(1000);
  for (Vec3& p : pilot) p = inUnitBox(rng);
  // 1e6 is beyond 2²⁰ cells of 1/16, 1e30 beyond any integer.
  std::vector<Vec3> places;
  for (const float far : {-0.01f, 2.0f, -100.0f, 6e4f, 1e6f, -1e12f, 1e18f}) {
    places.emplace_back(far, 0.5f, 0.5f);
    places.push_back(Vec3(far, -far, 0.3f * far));
  }
  expectSoundAt(scene, pilot, places);
}

TEST_P(ExtremePlaces, BeyondTheSquareRootOfTheLargestFloatAreAnsweredWithoutNan) {
  // No light arrives from so far: the squares of the distances overflow. What is asked is that nothing breaks.
  const Scene scene = stage(LightMix::kAll, 60, 1);
  const Lights lights(scene);
  const std::vector<Vec3> pilot{Vec3(0), Vec3(1)};
  const auto sampler = makeLightSampler(GetParam().strategy, lights, GetParam().settings, pilot);
  for (const float far : {1e20f, -1e30f, 3e38f}) {
    const ShadingPoint point{{far, 0, 1}, {0, 1, 0}};
    for (const double pmf : allPmfs(*sampler, lights, point)) ASSERT_TRUE(pmf >= 0 && pmf <= 1) << pmf;
    (void)sampler->sample(point, 0.5);
  }
}

TEST_P(ExtremePlaces, FlatThinAndSinglePointScenesAreAnswered) {
  for (const Vec3& extent : {Vec3(1, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(1, 1e-20f, 1)}) {
    SCOPED_TRACE(testing::Message() << extent.x << " " << extent.y << " " << extent.z);
    Scene scene;
    Rng rng(2);
    std::array<Vec3, 20> positions;
    for (Vec3& p : positions) p = extent * inUnitBox(rng);
    addLightsAt(scene, LightMix::kPoint, positions, 2);
    addLightsAt(scene, LightMix::kSpot, positions, 2);
    if (extent.x > 0) {  // else no triangle has an area
      Mesh& mesh = addMesh(scene, addMaterial(scene, emitter(Vec3(1), true)));
      for (const Vec3& p : positions) {
        appendTriangle(mesh, p, extent * inUnitBox(rng), extent * inUnitBox(rng));
      }
    }
    if (extent != Vec3(0)) addLights(scene, LightMix::kDirectional, 5, 2);  // else there is nothing that they fall on
    finish(scene);
    std::vector<Vec3> pilot(1000);
    for (Vec3& p : pilot) p = extent * inUnitBox(rng);
    std::vector<Vec3> places(pilot.begin(), pilot.begin() + 5);
    places.emplace_back(0.5f, 0.5f, 0.5f);
    places.emplace_back(0.0f);
    expectSoundAt(scene, pilot, places);
    expectSoundAt(scene, {}, places);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ExtremePlaces, testing::ValuesIn(kSamplerVariants), variantName);

TEST(CellGrids, OfOneTo1024CellsPerAxisStayInTheirMemory) {
  const Scene scene = stage(LightMix::kAll, 4000, 3);
  constexpr std::size_t kMemory = 4 << 20;
  for (const int resolution : {1, 16, 128, 1024}) {
    SCOPED_TRACE(resolution);
    RenderSettings settings;
    settings.width = 96;
    settings.height = 72;
    settings.maxDepth = 2;
    settings.threads = 2;
    settings.sampler.maxCut = 256;
    settings.sampler.gridResolution = resolution;
    settings.sampler.cellMemory = kMemory;
    Renderer renderer(scene, settings);
    ASSERT_TRUE(renderer.renderPass(std::atomic<bool>{false}));
    const SamplerStatistics statistics = renderer.samplerStatistics();
    EXPECT_GE(statistics.grid->made(), 1u);
    // Whether there is room is asked before a cut is made, and each thread may be making one.
    constexpr std::size_t kOneCut = 256 * 4 * kClusterBlock;
    EXPECT_LE(statistics.cut->bytes, kMemory + 2 * kOneCut);
  }
}

}  // namespace
}  // namespace cellcut::test
