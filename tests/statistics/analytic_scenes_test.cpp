// Proof 4: scenes whose pictures are known without a computer, for every strategy.
#include "tests/support/depth.h"
#include "tests/support/images.h"
#include "tests/support/statistics.h"
#include "tests/support/strategies.h"

namespace cellcut::test {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr float kAlbedo = 0.8f;

/// A unit sphere in a square view that it just fills, seen along −z.
Scene sphere(const Material& material) {
  Scene scene;
  // 512 sides: the polygon's area is short of the disk's by 3e-5.
  addSphere(scene, addMaterial(scene, material), Vec3(0), 1, 512, 256);
  scene.cameras.push_back(orthographic({0, 0, 5}, Vec3(0), 1));
  return scene;
}

class AnalyticScene : public testing::TestWithParam<SamplerVariant> {
 protected:
  LuminanceEstimate meanOf(Scene& scene, int maxDepth) const {
    finish(scene);
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.maxDepth = maxDepth;
    settings.strategy = GetParam().strategy;
    settings.sampler = GetParam().settings;
    settings.seed = 4;
    return tilesOf(renderEstimates(scene, settings, sampleShare(byDepth(32, 512))), 1)[0];
  }
  /// \param expected  luminance, mean over the square
  void expectMean(Scene& scene, double expected, double tolerance = 0.005, int maxDepth = 1) const {
    const LuminanceEstimate mean = meanOf(scene, maxDepth);
    // A sixteenth of the paths errs by four times as much.
    EXPECT_NEAR(mean.mean / expected, 1, isSixteenth() ? 4 * tolerance : tolerance);
    // Tessellation and quadrature: 10⁻⁴.
    EXPECT_LT(std::abs(zScore(mean.mean, mean.variance, expected, 1e-8 * expected * expected)), criticalZ(1))
        << mean.mean << " against " << expected;
  }
};

/// Mean over the square of a radiance that depends on the angle θ from the view's axis alone.
double overDisk(const auto& radiance) {
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = kPiD / 2 * (i + 0.5) / kSteps;
    sum += radiance(theta) * 2 * kPiD * std::sin(theta) * std::cos(theta);
  }
  return sum * kPiD / 2 / kSteps / 4;
}

/// Distance of the lights from the sphere's centre, on the axis.
constexpr double kDistance = 3;

double pointIrradiance(double theta) {
  const double d2 = kDistance * kDistance + 1 - 2 * kDistance * std::cos(theta);
  return std::max(0.0, kDistance * std::cos(theta) - 1) / (d2 * std::sqrt(d2));
}

TEST_P(AnalyticScene, SphereUnderPointLight) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  scene.pointLights.push_back({{0, 0, static_cast<float>(kDistance)}, Vec3(7)});
  expectMean(scene, overDisk([](double theta) { return 7 * kAlbedo / kPiD * pointIrradiance(theta); }));
}

TEST_P(AnalyticScene, SphereUnderSpotLight) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  // The sphere spans cosines from 1 to 0.943: plateau, ramp and darkness are all on it.
  const SpotLight spot{{0, 0, static_cast<float>(kDistance)}, {0, 0, -1}, Vec3(7), 0.99f, 0.96f};
  scene.spotLights.push_back(spot);
  expectMean(scene, overDisk([&](double theta) {
               const double d = std::sqrt(kDistance * kDistance + 1 - 2 * kDistance * std::cos(theta));
               const double t = ((kDistance - std::cos(theta)) / d - 0.96) / 0.03;
               const double falloff = std::clamp(t, 0.0, 1.0) * std::clamp(t, 0.0, 1.0);
               return 7 * kAlbedo / kPiD * falloff * pointIrradiance(theta);
             }));
}

TEST_P(AnalyticScene, SphereUnderDirectionalLight) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  scene.directionalLights.push_back({{0, 0, -1}, Vec3(3)});
  expectMean(scene, kAlbedo * 3.0 / 6);
}

TEST_P(AnalyticScene, SphereUnderFarTriangle) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  // Behind the camera, 100 away and 2 wide: a point light of intensity Le · A · cosθ' to within (2/100)².
  const float area = 2;
  addTriangle(scene, addMaterial(scene, emitter(Vec3(5000), false)), {-1, -0.6666667f, 100}, {0, 1.3333333f, 100},
              {1, -0.6666667f, 100});
  expectMean(scene, overDisk([&](double theta) {
               const double d2 = 100.0 * 100 + 1 - 200 * std::cos(theta), d = std::sqrt(d2);
               const double cosine = std::max(0.0, 100 * std::cos(theta) - 1) / d,
                            emission = (100 - std::cos(theta)) / d;
               return kAlbedo / kPiD * 5000 * area * emission * cosine / d2;
             }));
}

TEST_P(AnalyticScene, SphereInsideEmissiveBox) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  const std::size_t first = scene.meshes.size();
  addBox(scene, addMaterial(scene, emitter(Vec3(2), false)), Vec3(-6), Vec3(6));
  for (std::size_t i = first; i < scene.meshes.size(); ++i) {
    for (Triangle& t : scene.meshes[i].triangles) std::swap(t.y, t.z);  // shines inwards
  }
  // Every direction shows 2; the corners of the view show the box itself.
  expectMean(scene, 2 * (kAlbedo * kPiD / 4 + (1 - kPiD / 4)));
}

Environment environmentOf(int width, int height, const auto& radianceAtPolarAngle) {
  Environment environment;
  environment.radiance = ImageRgb(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      environment.radiance.at(x, y) = Vec3(static_cast<float>(radianceAtPolarAngle(kPiD * (y + 0.5) / height)));
    }
  }
  return environment;
}

TEST_P(AnalyticScene, SphereUnderLinearEnvironment) {
  Scene scene = sphere(lambertian(Vec3(kAlbedo)));
  scene.cameras[0] = orthographic({0, 5, 0}, Vec3(0), 1);
  // L = 1 + cos φ gives E = π + 2π/3 · n.y; the corners of the view show L = 0 straight below.
  // One column is enough for what varies with the latitude alone.
  scene.environment = environmentOf(1, 128, [](double polar) { return 1 + std::cos(polar); });
  expectMean(scene, overDisk([](double theta) { return kAlbedo * (1 + 2.0 / 3 * std::cos(theta)); }));
}

/// A white sphere that fills the view, and another beside it: light goes to and fro between the two.
Scene furnace(Scene scene) {
  addSphere(scene, addMaterial(scene, lambertian(Vec3(1))), {0.9f, 0.9f, 0.5f}, 0.4f);
  scene.environment = environmentOf(16, 8, [](double) { return 1.0; });
  return scene;
}

TEST_P(AnalyticScene, WhiteFurnaceIsWhite) {
  Scene scene = furnace(sphere(lambertian(Vec3(1))));
  // 60 vertices: what is still under way has met a white surface 60 times in the open, less than 10⁻⁶.
  expectMean(scene, 1, 0.002, 60);
}

/// The choice of no light: every light is left to the paths that happen on it.
class NoLight final : public LightSampler {
 public:
  std::optional<SampledLight> sample(const ShadingPoint&, double) const override { return std::nullopt; }
  float pmf(const ShadingPoint&, LightId) const override { return 0; }
  std::size_t bytes() const override { return 0; }
};

TEST(WhiteFurnace, IsWhiteByBsdfSamplingAlone) {
  Scene scene = furnace(sphere(lambertian(Vec3(1))));
  // Flat: towards the inside of a polygon that is shaded smoothly a path would end.
  for (Mesh& mesh : scene.meshes) mesh.normals.clear();
  finish(scene);
  const Accel accel(scene);
  const Lights lights(scene);
  const NoLight none;
  const PathContext context{scene, accel, lights, none, 1000, true};
  PathCounts counts;
  const Film film = renderPasses(context, {64, 64}, sampleShare(16), 9, counts);
  EXPECT_GT(counts.bounceRays, 0u);
  EXPECT_EQ(counts.shadowRays, 0u);
  EXPECT_NEAR(tilesOf(estimatesOf(film), 1)[0].mean, 1, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Every, AnalyticScene, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
