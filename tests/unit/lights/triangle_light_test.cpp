#include "renderer/lights/triangle_light.h"

#include "renderer/base/rng.h"
#include "renderer/lights/lights.h"
#include "tests/support/depth.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/vectors.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// One triangle of radiance 1 on both sides: the irradiance of its reference is the form factor.
struct OneTriangle {
  Scene scene;
  std::unique_ptr<Lights> lights;
  TriangleGeometry geometry;

  OneTriangle(const Vec3& a, const Vec3& b, const Vec3& c, bool doubleSided = true) {
    addTriangle(scene, addMaterial(scene, emitter(Vec3(1), doubleSided)), a, b, c);
    finish(scene);
    lights = std::make_unique<Lights>(scene);
    geometry = triangleGeometry(scene.meshes[0], 0);
  }
  double formFactorByQuadrature(const Vec3& p, const Vec3& n) const {
    return referenceIrradiance(*lights, LightId{0}, p, n, 512).x;
  }
};

TEST(TriangleLight, FormFactorIsItsIntegralAboveTheHorizon) {
  Rng rng(1);
  int clipped = 0;
  for (int i = 0; i < 60; ++i) {
    const OneTriangle triangle(randomUnit(rng), randomUnit(rng), randomUnit(rng));
    const Vec3 p = rng.uniform(1.2f, 4) * randomUnit(rng), n = randomUnit(rng);
    const double expected = triangle.formFactorByQuadrature(p, n);
    // 512² midpoints: 10⁻⁵ where the horizon cuts through.
    EXPECT_NEAR(triangleFormFactor(triangle.geometry, p, n), expected, 2e-5) << i;
    int above = 0;
    for (const Vec3& c : triangle.geometry.corners) above += glm::dot(c - p, n) > 0;
    clipped += above == 1 || above == 2;
  }
  EXPECT_GT(clipped, 10) << "triangles across the horizon";
}

TEST(TriangleLight, FormFactorOfAHugeTriangleIsPi) {
  const OneTriangle triangle({-1e6f, -1e6f, 1}, {1e6f, -1e6f, 1}, {0, 2e6f, 1});
  EXPECT_NEAR(triangleFormFactor(triangle.geometry, Vec3(0), {0, 0, 1}), std::numbers::pi, 1e-5);
  EXPECT_EQ(triangleFormFactor(triangle.geometry, Vec3(0), {0, 0, -1}), 0);
}

TEST(TriangleLight, FormFactorIsPositiveAndRightFarAway) {
  for (const float distance : {1e2f, 1e4f, 1e6f, 1e8f, 1e10f, 1e12f}) {
    const OneTriangle triangle({0, 0, 0}, {1e-2f, 0, 0}, {0, 1e-2f, 0});
    const double expected = 0.5e-4 / distance / distance;
    const double found = triangleFormFactor(triangle.geometry, {0, 0, distance}, {0, 0, -1});
    // The cube of the angle that it spans is what its area in a plane leaves out.
    EXPECT_NEAR(found / expected, 1, 1e-3) << distance;
  }
}

TEST(TriangleLight, SliversThatReachFarAwayAreSampledBySolidAngle) {
  // A lamp of 60 m x 2 cm beside a point: by area, what a sample brings falls with the square of its distance.
  const OneTriangle lamp({-1, 0, 3}, {-1, 0.02f, 3}, {59, 0, 3});
  Rng rng(7);
  const auto pdfOf = [&] {
    return sampleTriangle(lamp.geometry, Vec3(0), Vec2(rng.uniform(), rng.uniform())).value().pdf;
  };
  const float pdf = pdfOf();
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pdfOf(), pdf) << "1 / solid angle, wherever the sample is";
}

class TriangleSampling : public testing::TestWithParam<float> {};

TEST_P(TriangleSampling, MeanOfContributionsIsTheFormFactor) {
  // So close, points are sampled by area and almost all that they bring comes from a few of them: the integrator's MIS
  // is tested there.
  if (GetParam() < 1e-3f) GTEST_SKIP();
  // From area sampling through solid angle to all but a hemisphere.
  const OneTriangle triangle({-0.5f, -0.4f, 0}, {0.6f, -0.3f, 0}, {0.1f, 0.7f, 0});
  Rng rng(3);
  for (const Vec3& n : {Vec3(0, 0, 1), glm::normalize(Vec3(1, 0, 0.2f))}) {
    const Vec3 p(0.05f, 0.02f, -GetParam());
    Moments moments;
    for (std::size_t i = 0; i < sampleShare(100'000); ++i) {
      const float u = rng.uniform();
      const auto sample = triangle.lights->sample(LightId{0}, p, {u, rng.uniform()});
      moments.add(sample ? static_cast<double>(std::max(0.0f, glm::dot(sample->wi, n)) / sample->pdf) : 0.0);
    }
    const double expected = triangleFormFactor(triangle.geometry, p, n);
    // 10⁻⁴: what the solid angle of three float directions is right to (triangle_light.cpp).
    EXPECT_LT(std::abs(zScore(moments.mean(), moments.meanVariance(), expected, 1e-8 * expected * expected)),
              criticalZ(16))
        << moments.mean() << " against " << expected;
  }
}

TEST(TriangleLight, IsSampledRightFromCloseToAnEdge) {
  // Every distance at which directions are sampled, whichever corner comes first.
  constexpr std::array<float, 6> kDistances{1, 0.1f, 0.03f, 0.02f, 0.01f, 1e-3f};
  for (const float h : kDistances) {
    for (std::size_t first = 0; first < 3; ++first) {
      const std::array<Vec3, 3> c{Vec3(-5, h, -5), Vec3(5, h, -5), Vec3(5, h, 5)};
      const OneTriangle triangle(c[first], c[(first + 1) % 3], c[(first + 2) % 3]);
      Rng rng(16);
      Moments moments;
      bool byDirection = true;
      for (std::size_t i = 0; i < sampleShare(byDepth(100'000, 10'000'000)); ++i) {
        const float u = rng.uniform();
        const auto sample = triangle.lights->sample(LightId{0}, Vec3(0), {u, rng.uniform()});
        byDirection = byDirection && sample && std::abs(sample->pdf - 1 / kPi) < 0.1f;
        moments.add(sample ? static_cast<double>(std::max(0.0f, sample->wi.y) / sample->pdf) : 0.0);
      }
      if (!byDirection && h < 0.02f) continue;  // by area: right by construction, with too much variance for a z-test
      const double expected = triangleFormFactor(triangle.geometry, Vec3(0), {0, 1, 0});
      EXPECT_LT(std::abs(zScore(moments.mean(), moments.meanVariance(), expected, 1e-8 * expected * expected)),
                criticalZ(3 * kDistances.size()))
          << moments.mean() << " against " << expected << " at " << h << ", corner " << first;
    }
  }
}

TEST_P(TriangleSampling, PdfIsThatOfTheSample) {
  const OneTriangle triangle({-0.5f, -0.4f, 0}, {0.6f, -0.3f, 0}, {0.1f, 0.7f, 0});
  const Vec3 p(0.05f, 0.02f, -GetParam());
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const float u = rng.uniform();
    const auto point = sampleTriangle(triangle.geometry, p, {u, rng.uniform()});
    ASSERT_TRUE(point);
    ASSERT_NEAR(point->pdf / trianglePdf(triangle.geometry, p, point->position), 1, 1e-5);
    ASSERT_GE(std::min({point->barycentric.x, point->barycentric.y, 1 - point->barycentric.x - point->barycentric.y}),
              -1e-6f);
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, TriangleSampling,
                         testing::Values(1e-4f, 1e-2f, 0.1f, 1.0f, 5.0f, 9.0f, 100.0f, 1e4f));

TEST(TriangleLight, EdgesOfTheUnitSquareGiveSamples) {
  const OneTriangle triangle({-0.5f, -0.4f, 0}, {0.6f, -0.3f, 0}, {0.1f, 0.7f, 0});
  constexpr float kLast = 0x1.fffffep-1f;
  for (const float distance : {0.01f, 1.0f, 100.0f}) {
    for (const float x : {0.0f, kLast}) {
      for (const float y : {0.0f, kLast}) {
        const auto sample = triangle.lights->sample(LightId{0}, {0.05f, 0.02f, -distance}, {x, y});
        ASSERT_TRUE(sample) << distance << " " << x << " " << y;
        EXPECT_TRUE(isFinite(sample->wi) && std::isfinite(sample->pdf) && sample->pdf > 0);
      }
    }
  }
}

TEST(TriangleLight, ShinesFromItsBackOnlyIfDoubleSided) {
  const OneTriangle one({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, false), both({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, true);
  const Vec3 front(0.2f, 0.2f, 1), back(0.2f, 0.2f, -1), up(0, 0, 1);
  EXPECT_TRUE(one.lights->sample(LightId{0}, front, Vec2(0.3f)));
  EXPECT_FALSE(one.lights->sample(LightId{0}, back, Vec2(0.3f)));
  EXPECT_TRUE(both.lights->sample(LightId{0}, back, Vec2(0.3f)));
  EXPECT_EQ(one.lights->irradiance(LightId{0}, back, up), 0);
  EXPECT_NEAR(both.lights->irradiance(LightId{0}, back, up), one.lights->irradiance(LightId{0}, front, -up), 1e-7);
  EXPECT_NEAR(both.lights->flux(LightId{0}), 2 * one.lights->flux(LightId{0}), 1e-9);
}

TEST(TriangleLight, ScalesExactlyByPowersOfTwo) {
  for (const float scale : {0x1p-20f, 0x1p20f}) {
    const OneTriangle one({0, 0, 0}, {1, 0.1f, 0}, {0.2f, 1, 0.3f});
    const OneTriangle scaled(Vec3(0), scale * Vec3(1, 0.1f, 0), scale * Vec3(0.2f, 1, 0.3f));
    for (const float distance : {0.1f, 2.0f, 60.0f}) {
      const Vec3 p(0.2f, 0.3f, -distance);
      const auto a = one.lights->sample(LightId{0}, p, {0.3f, 0.8f}),
                 b = scaled.lights->sample(LightId{0}, scale * p, {0.3f, 0.8f});
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->wi, b->wi);
      EXPECT_EQ(a->pdf, b->pdf);
      EXPECT_EQ(one.lights->irradiance(LightId{0}, p, {0, 0, 1}),
                scaled.lights->irradiance(LightId{0}, scale * p, {0, 0, 1}));
    }
  }
}

/// Two triangles for each of these quads beside each other, which emit what the texture says.
Scene texturedQuads(ImageRgba8 texels, int quads, const Vec3& emission = {1, 0, 0}) {
  Scene scene;
  scene.texels.push_back(std::move(texels));
  scene.textures.push_back({TexelsId{0}});
  Material material = emitter(emission, true);
  material.setSlot(TextureUse::kEmission, {.texture = TextureId{0}});
  const MaterialId id = addMaterial(scene, material);
  for (int i = 0; i < quads; ++i) addQuad(scene, id, Vec3(i, 0, 0), {1, 0, 0}, {0, 1, 0});
  finish(scene);
  return scene;
}

TEST(TriangleLight, BlackTexturesOfAnySizeTakeNoTime) {
  ImageRgba8 texels(4096, 4096, {0, 255, 255, 255});  // black for a material that is red
  const Scene scene = texturedQuads(std::move(texels), 500);
  const HostileBudget budget("black texture");
  EXPECT_TRUE(collectTriangleLights(scene).empty());
}

TEST(TriangleLight, WeighTheSameInEachChannelOfATexture) {
  ImageRgba8 texels(16, 16, {255, 255, 255, 255});
  for (int i = 0; i < 16; ++i) texels.at(i, i) = {0, 0, 0, 255};
  const auto weights = [&](const Vec3& emission) {
    std::vector<float> result;
    for (const TriangleLight& light : collectTriangleLights(texturedQuads(texels, 1, emission)))
      result.push_back(light.meanRadiance);
    return result;
  };
  const std::vector<float> red = weights({1, 0, 0});
  ASSERT_EQ(red.size(), 2u);
  // The diagonal is a sixteenth, which a bilinear lookup spreads but does not brighten or darken.
  EXPECT_NEAR(red[0] + red[1], 2 * 0.9375f / std::sqrt(3.0f), 0.01f);
  EXPECT_EQ(weights({0, 1, 0}), red);
  EXPECT_EQ(weights({0, 0, 1}), red);
}

TEST(TriangleLight, AreThoseWithALitTexel) {
  ImageRgba8 texels(256, 256, {0, 0, 0, 255});
  texels.at(200, 20) = {255, 0, 0, 255};
  Scene scene = texturedQuads(texels, 2);
  const auto turn = [&](std::size_t mesh, Vec2 offset) {
    for (Vec2& uv : scene.meshes[mesh].texCoords[0]) uv = 0.25f * uv + offset;
  };
  turn(0, {0.1f, 0.1f});
  turn(1, {0.7f, 0.01f});
  const std::vector<TriangleLight> lights = collectTriangleLights(scene);
  ASSERT_FALSE(lights.empty());
  for (const TriangleLight& light : lights) EXPECT_EQ(light.mesh, MeshId{1});
}

}  // namespace
}  // namespace cellcut::test
