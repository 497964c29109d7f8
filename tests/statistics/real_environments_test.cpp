// Real pictures of the sky as light: a plane and a sphere against numerical integration.
#include "renderer/scene/environment.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/support/images.h"
#include "tests/support/scenes.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using DVec3 = glm::dvec3;

/// Directions with the luminance that comes from each, times its solid angle.
struct SkyRay {
  DVec3 direction;
  double power;
};

/// Two midpoints per texel and axis: the environment is bilinear between its texels.
std::vector<SkyRay> integrate(const Environment& environment) {
  const int width = 2 * environment.radiance.width(), height = 2 * environment.radiance.height();
  const double pi = std::numbers::pi;
  std::vector<SkyRay> rays;
  for (int y = 0; y < height; ++y) {
    const double solidAngle = 2 * pi / width * 2 * std::sin(pi * (y + 0.5) / height) * std::sin(pi * 0.5 / height);
    for (int x = 0; x < width; ++x) {
      const Vec3 direction = directionFromLatLong(environment, (Vec2(x, y) + 0.5f) / Vec2(width, height));
      rays.push_back({DVec3(direction), luminance(DVec3(environmentRadiance(environment, direction))) * solidAngle});
    }
  }
  return rays;
}

double irradiance(const std::vector<SkyRay>& rays, const DVec3& n) {
  double sum = 0;
  for (const SkyRay& ray : rays) sum += ray.power * std::max(0.0, glm::dot(ray.direction, n));
  return sum;
}

double meanLuminance(const Scene& scene) {
  RenderSettings settings;
  settings.width = settings.height = 64;
  settings.maxDepth = 1;
  settings.auxiliary = false;
  Renderer renderer(scene, settings);
  const ImageRgb picture = renderPasses(renderer, sampleShare(64));
  double sum = 0;
  for (const Vec3& pixel : picture) sum += luminance(DVec3(pixel));
  return sum / static_cast<double>(picture.size());
}

class RealEnvironment : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(CELLCUT_CORPUS)) GTEST_SKIP() << "no corpus beside this checkout";
    picture_ = readImage(std::string(CELLCUT_CORPUS) + "/environments/" + GetParam() + ".exr");
  }
  Scene lit(Scene scene) const {
    finish(scene);
    setEnvironment(scene, picture_, 1, 0, GetParam());
    return scene;
  }
  ImageRgb picture_;
};

/// What the issue asks for. 262,144 paths leave less than half of it to chance; a sixteenth of them four times as much.
double tolerance() {
  return isSixteenth() ? 0.02 : 0.005;
}

TEST_P(RealEnvironment, LightsADiffusePlaneAsNumericalIntegrationSays) {
  Scene scene;
  addQuad(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  scene.cameras.push_back(orthographic({0, 5, 0}, Vec3(0), 1));
  const Scene plane = lit(std::move(scene));
  const double expected = 0.5 / std::numbers::pi * irradiance(integrate(*plane.environment), {0, 1, 0});
  EXPECT_NEAR(meanLuminance(plane) / expected, 1, tolerance());
}

TEST_P(RealEnvironment, LightsAWhiteSphereAsNumericalIntegrationSays) {
  Scene scene;
  addSphere(scene, addMaterial(scene, lambertian(Vec3(1))), Vec3(0), 1, 512, 256);
  scene.cameras.push_back(orthographic({0, 0, 5}, Vec3(0), 1));
  const Scene sphere = lit(std::move(scene));
  const std::vector<SkyRay> rays = integrate(*sphere.environment);
  // The picture is the sphere's disk, by midpoints of equal area, and behind its corners one direction of the sky.
  constexpr int kRings = 8, kSectors = 24;
  double disk = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      const double r2 = (ring + 0.5) / kRings, phi = 2 * std::numbers::pi * (sector + 0.5) / kSectors;
      const DVec3 n(std::sqrt(r2) * std::cos(phi), std::sqrt(r2) * std::sin(phi), std::sqrt(1 - r2));
      disk += irradiance(rays, n) / std::numbers::pi / (kRings * kSectors);
    }
  }
  const double share = std::numbers::pi / 4;
  const double sky = luminance(DVec3(environmentRadiance(*sphere.environment, {0, 0, -1})));
  EXPECT_NEAR(meanLuminance(sphere) / (share * disk + (1 - share) * sky), 1, tolerance());
}

INSTANTIATE_TEST_SUITE_P(Corpus, RealEnvironment,
                         testing::Values("city", "forest", "lobby", "night", "studio", "sunset"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace cellcut::test
