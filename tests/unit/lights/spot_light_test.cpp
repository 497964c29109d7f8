#include "renderer/lights/lights.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

Scene spotScene(float cosInner, float cosOuter) {
  Scene scene;
  scene.spotLights.push_back({Vec3(0), {0, 0, 1}, Vec3(1), cosInner, cosOuter});
  finish(scene);
  return scene;
}

TEST(SpotLight, FluxIsTheIntegralOfItsIntensity) {
  for (const auto& [inner, outer] :
       {std::pair(0.9f, 0.5f), std::pair(1.0f, 0.0f), std::pair(0.3f, -0.8f), std::pair(0.9999f, 0.9998f)}) {
    const Scene scene = spotScene(inner, outer);
    const Lights lights(scene);
    // At distance 1 the radiance of a delta sample is the intensity.
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = 1 + (static_cast<double>(outer) - 1) * (i + 0.5) / kSteps;
      const Vec3 p(glm::dvec3(std::sqrt(1 - cosine * cosine), 0, cosine));
      const auto sample = lights.sample(LightId{0}, p, Vec2(0));
      if (sample)
        sum +=
            static_cast<double>(sample->radiance.x) * 2 * std::numbers::pi * (1 - static_cast<double>(outer)) / kSteps;
    }
    // Float directions know the cosine to 6e-8, which is 6e-4 of the narrowest ramp.
    EXPECT_NEAR(lights.flux(LightId{0}) / sum, 1, inner > 0.999f ? 1e-3 : 1e-5);
  }
}

TEST(SpotLight, IsDarkOutsideItsConeAndAtItself) {
  const Scene scene = spotScene(0.9f, 0.5f);
  const Lights lights(scene);
  EXPECT_TRUE(lights.sample(LightId{0}, {0, 0, 2}, Vec2(0)));
  EXPECT_FALSE(lights.sample(LightId{0}, {0, 0, -2}, Vec2(0)));
  EXPECT_FALSE(lights.sample(LightId{0}, {2, 0, 1}, Vec2(0)));
  EXPECT_FALSE(lights.sample(LightId{0}, Vec3(0), Vec2(0)));
  EXPECT_TRUE(lights.liesAt(LightId{0}, Vec3(0)));
}

TEST(SpotLight, FallsOffAsTheExtensionSays) {
  const Scene scene = spotScene(0.8f, 0.4f);
  const Lights lights(scene);
  const auto at = [&](float cosine) {
    return lights.sample(LightId{0}, {std::sqrt(1 - cosine * cosine), 0, cosine}, Vec2(0));
  };
  EXPECT_NEAR(at(0.9f)->radiance.x, 1, 1e-6);
  EXPECT_NEAR(at(0.6f)->radiance.x, 0.25f, 1e-6);  // half way, squared
  EXPECT_NEAR(at(0.5f)->radiance.x, 0.0625f, 1e-6);
}

TEST(PointLight, HasNoSampleAtItselfAndFallsWithTheSquare) {
  Scene scene;
  scene.pointLights.push_back({{1, 2, 3}, Vec3(8)});
  finish(scene);
  const Lights lights(scene);
  EXPECT_FALSE(lights.sample(LightId{0}, {1, 2, 3}, Vec2(0)));
  EXPECT_EQ(lights.irradiance(LightId{0}, {1, 2, 3}, {0, 1, 0}), 0);
  EXPECT_FLOAT_EQ(lights.sample(LightId{0}, {1, 2, 5}, Vec2(0))->radiance.x, 2);
  // Neither 10⁻³⁰ squared nor its inverse is a float, the quotient is.
  EXPECT_NEAR(lights.irradiance(LightId{0}, {1, 2, 3e15f}, {0, 0, -1}) / (8 / 9e30), 1, 1e-6);
}

}  // namespace
}  // namespace cellcut::test
