// Extremes of lights: how many, how bright, and where. For every strategy.
#include "renderer/base/rng.h"
#include "renderer/lights/light_tree.h"
#include "renderer/sampling/cell_grid.h"
#include "renderer/trace/prepared_scene.h"
#include "tests/support/depth.h"
#include "tests/support/frozen_render.h"
#include "tests/support/images.h"
#include "tests/support/nightly.h"
#include "tests/support/probabilities.h"
#include "tests/support/reference.h"
#include "tests/support/shading_points.h"
#include "tests/support/statistics.h"
#include "tests/support/strategies.h"
#include "tests/support/vectors.h"

namespace cellcut::test {
namespace {

/// Every kind of light by itself.
constexpr std::array kKinds{LightMix::kPoint, LightMix::kSpot, LightMix::kTriangle, LightMix::kDirectional,
                            LightMix::kEnvironment};

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

Scene lightsAt(LightMix kind, const std::vector<Vec3>& positions) {
  Scene scene;
  addLightsAt(scene, kind, positions, 1);
  finish(scene);
  return scene;
}

double meanOf(const ImageRgb& picture) {
  double sum = 0;
  for (const Vec3& pixel : picture) sum += luminance(glm::dvec3(pixel));
  return sum / static_cast<double>(picture.size());
}

RenderSettings smallPicture(const SamplerVariant& variant) {
  RenderSettings settings;
  settings.width = 32;
  settings.height = 24;
  settings.strategy = variant.strategy;
  settings.sampler = variant.settings;
  return settings;
}

ImageRgb finitePicture(Renderer& renderer) {
  ImageRgb picture = renderPasses(renderer, 2);
  EXPECT_EQ(renderer.film().badSamples().nan, 0u);
  EXPECT_EQ(renderer.film().badSamples().inf, 0u);
  for (const Vec3& error : renderer.film().standardError()) EXPECT_TRUE(isFinite(error));
  return picture;
}

class ExtremeLights : public testing::TestWithParam<SamplerVariant> {
 protected:
  std::unique_ptr<LightSampler> samplerOf(const Lights& lights, std::span<const Vec3> pilot = {}) const {
    return makeLightSampler(GetParam().strategy, lights, GetParam().settings, pilot);
  }
  void expectSoundAt(const Scene& scene, std::span<const ShadingPoint> points, double reach = 0) const {
    const Lights lights(scene);
    const auto sampler = samplerOf(lights);
    for (const ShadingPoint& point : points) expectSoundPmfs(GetParam(), *sampler, lights, point, reach);
  }
  ImageRgb render(const Scene& scene) const {
    Renderer renderer(scene, smallPicture(GetParam()));
    return finitePicture(renderer);
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

TEST_P(ExtremeLights, SixtyDecadesInOneSkyMakeAFinitePicture) {
  Scene scene = stage(LightMix::kPoint, 3, 5);
  scene.environment.emplace().radiance = ImageRgb(61, 8);
  ImageRgb& sky = scene.environment->radiance;
  for (int y = 0; y < sky.height(); ++y) {
    for (int x = 0; x < sky.width(); ++x) sky.at(x, y) = Vec3(std::pow(10.0f, static_cast<float>(x) - 30));
  }
  expectSoundAt(scene, pathVertices(scene, 12, 5), kReach);
  EXPECT_GT(meanOf(render(scene)), 1e26);
}

/// A surface that all rays of a camera meet at one point: it sees 10⁻³⁰ m.
struct OnePoint {
  Scene scene;
  ShadingPoint point;

  /// \param emission  of the surface, on both sides if it is `doubleSided`
  explicit OnePoint(const Vec3& emission = Vec3(0), bool doubleSided = true) {
    Material material = lambertian(Vec3(0.5f));
    material.emission = emission;
    material.doubleSided = doubleSided;
    addTriangle(scene, addMaterial(scene, material), {0, 0, 0}, {1, 0, 0.3f}, {0, 1, -0.2f});
    scene.cameras.push_back(orthographic({0.25f, 0.25f, 1}, {0.25f, 0.25f, 0}, 1e-30f));
    scene.pointLights.push_back({{0, 0, 1}, Vec3(1)});
    finish(scene);
    point = FrozenRender(scene, {.size = {1, 1}, .passes = 1}).vertices.at(0);
    scene.pointLights.clear();
  }
};

TEST_P(ExtremeLights, AtTheShadingPointItselfSendNothingAndBreakNothing) {
  auto [scene, point] = OnePoint();
  scene.pointLights = {{point.p, Vec3(1)}, {point.p, Vec3(2)}};
  finish(scene);
  for (const Vec3& pixel : render(scene)) ASSERT_EQ(pixel, Vec3(0));
  // The others go on.
  scene.pointLights.push_back({{0.2f, 0.3f, 0.5f}, Vec3(1)});
  finish(scene);
  expectSoundAt(scene, std::array{point});
  EXPECT_GT(meanOf(render(scene)), 0);
}

TEST_P(ExtremeLights, AtTheShadingPointItselfAreCountedAsOftenAsTheyAreDrawn) {
  for (const LightMix kind : {LightMix::kPoint, LightMix::kSpot}) {
    SCOPED_TRACE(nameOf(kind));
    auto [scene, point] = OnePoint();
    addLightsAt(scene, kind, std::array{point.p, Vec3(0.2f, 0.3f, 0.5f)}, 2);
    finish(scene);
    RenderSettings settings;
    settings.width = settings.height = isSixteenth() ? 16 : 64;
    settings.maxDepth = 1;
    settings.sampling = PixelSampling::kIndependent;
    settings.strategy = GetParam().strategy;
    settings.sampler = GetParam().settings;
    Renderer renderer(scene, settings);
    ASSERT_TRUE(renderer.renderPass(kNever));
    const PreparedScene prepared(scene);
    const double pmf = static_cast<double>(makeLightSampler(prepared, settings)->pmf(point, LightId{0}));
    // One strategy knows that it sends nothing; the others learn it when they sample it.
    EXPECT_EQ(pmf > 0, GetParam().strategy != Strategy::kProportional);
    const double n = settings.width * settings.height;
    EXPECT_NEAR(static_cast<double>(renderer.droppedSamples()), n * pmf,
                criticalZ(2 * kSamplerVariants.size()) * std::sqrt(n * pmf * (1 - pmf)));
  }
}

TEST_P(ExtremeLights, ThatTheShadingPointIsPartOfAddTheirOwnRadianceAndNoMore) {
  for (const bool doubleSided : {false, true}) {
    SCOPED_TRACE(doubleSided);
    auto [scene, point] = OnePoint(Vec3(2), doubleSided);
    const Vec3 lamp(0.2f, 0.3f, 0.7f);
    scene.pointLights = {{lamp, Vec3(3)}};
    finish(scene);
    RenderSettings settings = smallPicture(GetParam());
    settings.maxDepth = 1;
    settings.sampling = PixelSampling::kIndependent;
    Renderer renderer(scene, settings);
    finitePicture(renderer);
    const LuminanceEstimate mean = tilesOf(estimatesOf(renderer.film()), 1)[0];
    const glm::dvec3 d = glm::dvec3(lamp) - glm::dvec3(point.p);
    const double expected =
        2 + 0.5 / std::numbers::pi * 3 * glm::dot(d, glm::dvec3(point.n)) / std::pow(glm::length(d), 3);
    // 10⁻⁶: roundings of a path.
    EXPECT_LT(std::abs(zScore(mean.mean, mean.variance, expected, 1e-12)), criticalZ(2 * kSamplerVariants.size()))
        << mean.mean << " against " << expected;
    // No light is missing for it.
    EXPECT_EQ(renderer.droppedSamples(), 0u);
  }
}

/// Half of the points at each of two corners of a box: so are their quantiles, and the grid is the box's.
std::vector<Vec3> pilotOf(const Vec3& lower, const Vec3& upper) {
  std::vector<Vec3> pilot(200, lower);
  std::fill(pilot.begin() + 100, pilot.end(), upper);
  return pilot;
}

Vec3 nextTo(const Vec3& p, const Vec3& direction) {
  return {std::nextafter(p.x, p.x + direction.x), std::nextafter(p.y, p.y + direction.y),
          std::nextafter(p.z, p.z + direction.z)};
}

/// The middle of a cell, of its faces and of its edges, and its corners.
std::vector<Vec3> placesOf(const Bounds& cell) {
  const std::array<Vec3, 3> at{cell.lower, cell.centre(), cell.upper};
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < 27; ++i) places.emplace_back(at[i % 3].x, at[i / 3 % 3].y, at[i / 9].z);
  return places;
}

TEST_P(ExtremeLights, InsideACellAndOnItsBorderHaveAProbability) {
  // Borders that are floats, and such as no float is on.
  for (const auto& [lower, upper] :
       {std::pair(Vec3(1), Vec3(5)), std::pair(Vec3(0.1f, -0.3f, 0.7f), Vec3(3.3f, 2.9f, 3.8f))}) {
    const std::vector<Vec3> pilot = pilotOf(lower, upper);
    const int resolution = GetParam().settings.gridResolution;
    const GridGeometry grid(centralBox(pilot), resolution);
    // With the default resolution its lower corner is one of coarse cells, too.
    const CellCoordinates middle{resolution / 2, resolution / 4, resolution / 2};
    const std::vector<Vec3> places = placesOf(grid.box(middle));
    ASSERT_EQ(grid.cellOf(places[13]), middle);
    for (const auto& [place, axis] : {std::pair(12, 0), std::pair(10, 1), std::pair(4, 2)}) {
      Vec3 across(0);
      across[axis] = 1;
      const Vec3& face = places[static_cast<std::size_t>(place)];
      ASSERT_NE(grid.cellOf(nextTo(face, -across)), grid.cellOf(nextTo(face, across))) << "no border";
    }
    for (const LightMix kind : kLocalMixes) {
      SCOPED_TRACE(nameOf(kind));
      const Scene scene = lightsAt(kind, places);
      const Lights lights(scene);
      const auto sampler = samplerOf(lights, pilot);
      if (GetParam().strategy == Strategy::kCellCut) {
        ASSERT_EQ(sampler->cutStrategy()->grid->box(middle).lower, places[0]);
      }
      Rng rng(6);
      const auto expectSound = [&](const Vec3& p) {
        const ShadingPoint point{p, randomUnit(rng), {}, rng.below(2) == 1};
        expectSoundPmfs(GetParam(), *sampler, lights, point);
      };
      for (const Vec3& place : places) {
        expectSound(place);
        expectSound(nextTo(place, randomUnit(rng)));
        expectSound(nextTo(place, randomUnit(rng)));
      }
      for (std::size_t i = 0; i < sampleShare(4 * 27); ++i) {
        const auto at = [&](std::size_t turn) { return static_cast<std::int32_t>(turn % 3) - 1; };
        const Bounds cell = grid.box({middle.x + at(i), middle.y + at(i / 3), middle.z + at(i / 9)});
        expectSound(cell.lower + (cell.upper - cell.lower) * Vec3(rng.uniform(), rng.uniform(), rng.uniform()));
      }
    }
  }
}

struct Arrangement {
  const char* name;
  std::vector<Vec3> positions;
};

std::vector<Arrangement> arrangements(LightMix kind) {
  std::vector<Arrangement> all{{"coincident", {}}, {"collinear", {}}, {"coplanar", {}}, {"powers of two apart", {}}};
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    all[0].positions.emplace_back(0.3f, -0.2f, 0.7f);
    all[1].positions.push_back(rng.uniform(-1, 1) * Vec3(0.6f, 0.64f, 0.48f));
    all[2].positions.emplace_back(rng.uniform(-1, 1), 0, rng.uniform(-1, 1));
  }
  // The triangles are as large as they are far, and twelve decades of areas is as much as all are reached in.
  const int farthest = kind == LightMix::kTriangle ? 20 : 60;
  for (int i = -farthest; i <= farthest; ++i) all[3].positions.emplace_back(std::ldexp(1.0f, i), 0, 0);
  return all;
}

TEST_P(ExtremeLights, CoincidentCollinearCoplanarOrPowersOfTwoApartHaveExactProbabilities) {
  for (const LightMix kind : kLocalMixes) {
    for (const Arrangement& arrangement : arrangements(kind)) {
      SCOPED_TRACE(nameOf(kind) + " lights, " + arrangement.name);
      const std::size_t anywhere = sampleShare(10);
      std::vector<ShadingPoint> points;
      points.reserve(anywhere + 2);
      Rng rng(8);
      for (std::size_t i = 0; i < anywhere; ++i) points.push_back({2.0f * randomUnit(rng), randomUnit(rng)});
      points.push_back({arrangement.positions[0], {0, 1, 0}});
      points.push_back({0.5f * (arrangement.positions[0] + arrangement.positions[1]), {0, 0, 1}});
      expectSoundAt(lightsAt(kind, arrangement.positions), points, kReach);
    }
  }
}

TEST(LightTreeOfExtremes, IsNoDeeperThanItsStackWhateverTheArrangement) {
  for (const LightMix kind : kLocalMixes) {
    for (const Arrangement& arrangement : arrangements(kind)) {
      SCOPED_TRACE(nameOf(kind) + " lights, " + arrangement.name);
      const Scene scene = lightsAt(kind, arrangement.positions);
      const LightTree tree(localBounds(Lights(scene), 0), LightId{0}, false);
      EXPECT_EQ(tree.leafCount(), arrangement.positions.size());
      EXPECT_LE(tree.depth(), 96);  // light_tree.cpp, kMaxCostDepth
    }
  }
}

/// Of all kinds.
Scene aMillionLights(float even, float odd) {
  // A fifth of them is a sky, which has fewer tiles than texels.
  Scene scene = stage(LightMix::kAll, static_cast<int>(sampleShare(1'250'000)), 10);
  scaleInTurn(scene, even, odd);
  return scene;
}

TEST(AMillionLights, TwelveDecadesApartAllHaveAProbability) {
  const Scene scene = aMillionLights(1, 1e-12f);
  const Lights lights(scene);
  ASSERT_GE(lights.size(), sampleShare(1'000'000));
  for (const SamplerVariant& variant : kFastVariants) {
    SCOPED_TRACE(variant.name);
    const auto sampler = makeLightSampler(variant.strategy, lights, variant.settings);
    for (const ShadingPoint& point : pathVertices(scene, byDepth(1, 6), 10)) {
      expectSoundPmfs(variant, *sampler, lights, point);
    }
  }
}

TEST(AMillionLights, TwelveDecadesApartHaveAProbabilityWithTheSlowStrategies) {
  if (!isNightly()) GTEST_SKIP() << "a minute: ./dev nightly";
  const Scene scene = aMillionLights(1, 1e-12f);
  const Lights lights(scene);
  const ShadingPoint point = pathVertices(scene, 1, 10)[0];
  for (const Strategy strategy : {Strategy::kProportional, Strategy::kPointCut}) {
    SCOPED_TRACE(nameOf(strategy));
    const auto sampler = makeLightSampler(strategy, lights);
    for (const double u : {0.0, 0.3, 0.6, 1 - 0x1p-53}) {
      if (const auto sample = sampler->sample(point, u)) {
        EXPECT_NEAR(sampler->pmf(point, sample->light) / sample->pmf, 1, 1e-5);
      }
    }
    for (std::size_t i = 0; i < lights.size(); i += 9973) {
      const auto light = static_cast<LightId>(i);
      if (luminance(referenceIrradiance(lights, light, point.p, point.n, 4)) > 0) {
        EXPECT_GT(sampler->pmf(point, light), 0) << "light " << i;
      }
    }
  }
}

TEST(AMillionLights, Of1e30And1e_30InOneSceneMakeAFinitePicture) {
  const Scene scene = aMillionLights(1e30f, 1e-30f);
  const Lights lights(scene);
  std::optional<Renderer> renderer;
  for (const SamplerVariant& variant : kFastVariants) {
    SCOPED_TRACE(variant.name);
    const RenderSettings settings = smallPicture(variant);
    renderer.emplace(renderer ? Renderer(*renderer, settings) : Renderer(scene, settings));
    EXPECT_GT(meanOf(finitePicture(*renderer)), 1e28);
    const auto sampler = makeLightSampler(variant.strategy, lights, variant.settings);
    for (const ShadingPoint& point : pathVertices(scene, byDepth(1, 6), 11)) {
      expectSoundPmfs(variant, *sampler, lights, point, kReach);
    }
  }
}

class TenMillionLights : public testing::TestWithParam<LightMix> {};

/// Over a floor that a camera looks down at.
Scene tenMillionLights(LightMix kind, std::size_t count) {
  Scene scene;
  addQuad(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {-1, 0, 1}, {3, 0, 0}, {0, 0, -3});
  scene.cameras.push_back(perspective({0.5f, 3, 3}, {0.5f, 0, 0.5f}, 0.6f));
  std::vector<Vec3> positions(count);
  Rng rng(9);
  for (Vec3& p : positions) p = {rng.uniform(), 1 + rng.uniform(), rng.uniform()};
  if (kind == LightMix::kPoint) {
    for (const Vec3& p : positions) scene.pointLights.push_back({p, Vec3(rng.uniform(0.01f, 1))});
  } else {
    // As many to a side as fit without touching.
    const float size = 0.2f / std::cbrt(static_cast<float>(count));
    Mesh& mesh = addMesh(scene, addMaterial(scene, emitter(Vec3(1), true)));
    for (const Vec3& p : positions) {
      const Vec3 u = size * randomUnit(rng), v = size * randomUnit(rng);
      appendTriangle(mesh, p, p + u, p + v);
    }
  }
  finish(scene);
  return scene;
}

TEST_P(TenMillionLights, TakeAtMost120BytesEachAndTheirPmfsSumToOne) {
  if (!isNightly()) GTEST_SKIP() << "minutes and gigabytes: ./dev nightly";
  constexpr std::size_t kCount = 10'000'000;
  const Scene scene = tenMillionLights(GetParam(), kCount);
  const Lights lights(scene);
  ASSERT_EQ(lights.size(), kCount);
  std::optional<Renderer> renderer;
  for (const SamplerVariant& variant : {kFastVariants[2], kFastVariants[3]}) {
    SCOPED_TRACE(variant.name);
    const auto sampler = makeLightSampler(variant.strategy, lights, variant.settings);
    const std::size_t inScene = GetParam() == LightMix::kPoint ? sizeof(PointLight) : 0;
    EXPECT_LE(static_cast<double>(lights.bytes() + sampler->bytes()) / kCount + static_cast<double>(inScene), 120);
    expectSoundPmfs(variant, *sampler, lights, {{0.5f, 0, 0.5f}, {0, 1, 0}});
    const RenderSettings settings = smallPicture(variant);
    renderer.emplace(renderer ? Renderer(*renderer, settings) : Renderer(scene, settings));
    EXPECT_GT(meanOf(finitePicture(*renderer)), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, TenMillionLights, testing::Values(LightMix::kPoint, LightMix::kTriangle),
                         [](const auto& info) { return nameOf(info.param); });

INSTANTIATE_TEST_SUITE_P(Every, ExtremeLights, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
