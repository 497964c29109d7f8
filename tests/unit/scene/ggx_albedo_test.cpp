#include "renderer/scene/ggx_albedo.h"

#include "renderer/base/rng.h"
#include "renderer/scene/ggx.h"
#include "tests/support/depth.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(GgxAlbedo, IsTheIntegralOfTheLobe) {
  // Without the table: the share of the visible normals that leaves, from the definitions, at roughnesses and cosines
  // between its entries.
  Rng rng(5);
  const std::size_t samples = sampleShare(byDepth(100'000, 1'000'000));
  for (const float roughness : {0.0f, 0.05f, 0.21f, 0.47f, 0.78f, 1.0f}) {
    for (const float cosine : {0.02f, 0.09f, 0.3f, 0.7f, 1.0f}) {
      const Vec3 wo(safeSqrt(1 - cosine * cosine), 0, cosine);
      const float alpha = ggxAlpha(roughness);
      Moments f0, f90;
      for (std::size_t i = 0; i < samples; ++i) {
        const float u = rng.uniform();
        const Vec3 h = sampleVisibleNormal(alpha, wo, {u, rng.uniform()});
        const Vec3 wi = 2 * glm::dot(wo, h) * h - wo;
        const double masked = 1 + static_cast<double>(ggxLambda(alpha, wo));
        const double share = wi.z > 0 ? masked / (masked + static_cast<double>(ggxLambda(alpha, wi))) : 0.0;
        const double weight = std::pow(1 - static_cast<double>(glm::dot(wo, h)), 5);
        f0.add(share * (1 - weight));
        f90.add(share * weight);
      }
      const Vec2 found = GgxAlbedo(roughness)(cosine);
      const double resolution = cosine < 0.05f ? 0.01 : 0.005;  // what the header promises
      EXPECT_NEAR(found.x, f0.mean(), resolution + 4 * std::sqrt(f0.meanVariance())) << roughness << " " << cosine;
      EXPECT_NEAR(found.y, f90.mean(), resolution + 4 * std::sqrt(f90.meanVariance())) << roughness << " " << cosine;
    }
  }
}

TEST(GgxAlbedo, MeanIsItsIntegralOverTheHemisphere) {
  for (const float roughness : {0.0f, 0.4f, 0.9f}) {
    const GgxAlbedo albedo(roughness);
    glm::dvec2 sum(0);
    constexpr int kSteps = 100'000;
    for (int i = 0; i < kSteps; ++i) sum += albedo(std::sqrt((static_cast<float>(i) + 0.5f) / kSteps));  // dμ² = 2 μ dμ
    EXPECT_NEAR(albedo.mean().x, sum.x / kSteps, 1e-5) << roughness;
    EXPECT_NEAR(albedo.mean().y, sum.y / kSteps, 1e-5) << roughness;
  }
}

}  // namespace
}  // namespace cellcut::test
