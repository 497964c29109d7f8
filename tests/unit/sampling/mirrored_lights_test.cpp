#include "renderer/sampling/mirrored_lights.h"

#include "renderer/base/rng.h"
#include "renderer/scene/bsdf.h"
#include "tests/support/depth.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

Scene thousandLamps() {
  Scene scene;
  Rng rng(5);
  const auto across = [&] { return rng.uniform(-20.0f, 20.0f); };
  for (int i = 0; i < 1000; ++i) scene.pointLights.push_back({Vec3(across(), 10, across()), Vec3(1)});
  for (const PointLight& light : scene.pointLights) scene.bounds.add(light.position);
  return scene;
}

/// Lamps of one strength 10 m above a floor that is looked at aslant.
class MirroredLamps : public testing::TestWithParam<Strategy> {
 protected:
  static Bsdf floor(float roughness) {
    return Bsdf({.diffuse = Vec3(0.2f),
                 .f0 = Vec3(0.04f),
                 .f90 = 1,
                 .dielectricF0 = 0.04f,
                 .dielectricF90 = 1,
                 .roughness = roughness});
  }
  ShadingPoint glossyPoint(float roughness) const {
    const Bsdf bsdf = floor(roughness);
    return {even.p, even.n, {wo, bsdf.alpha(), bsdf.reflectionShare(frame.toLocal(wo))}};
  }
  void SetUp() override {
    if (isSixteenth() && GetParam() == Strategy::kPointCut)
      GTEST_SKIP() << "a cut for each of thousands of probabilities";
  }
  /// Of one sample of the light that the floor reflects, were there no shadows, over its square.
  double variance(const ShadingPoint& asked, float roughness) const {
    const Bsdf bsdf = floor(roughness);
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const auto light = static_cast<LightId>(i);
      const Vec3 wi = frame.toLocal(glm::normalize(scene.pointLights[i].position - asked.p));
      const double f = static_cast<double>(luminance(bsdf.eval(frame.toLocal(wo), wi).value)) *
                       lights.irradiance(light, asked.p, asked.n);
      sum += f;
      squares += f * f / static_cast<double>(sampler->pmf(asked, light));
    }
    return squares / (sum * sum) - 1;
  }

  Scene scene = thousandLamps();
  Lights lights{scene};
  std::unique_ptr<LightSampler> sampler = makeLightSampler(GetParam(), lights);
  ShadingPoint even{Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0)};
  Frame frame{even.n};
  Vec3 wo = glm::normalize(Vec3(-2, 1, 0));
};

TEST_P(MirroredLamps, GlossyFloorsHaveAFractionOfTheVarianceOfAnEvenChoice) {
  for (const float roughness : {0.2f, 0.35f, 0.5f}) {
    EXPECT_LT(variance(glossyPoint(roughness), roughness), 0.2 * variance(even, roughness)) << roughness;
  }
}

TEST_P(MirroredLamps, RoughFloorsAskAsEvenOnes) {
  const ShadingPoint rough = glossyPoint(1);
  ASSERT_GT(rough.lobe.share, 0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto light = static_cast<LightId>(i);
    ASSERT_EQ(sampler->pmf(rough, light), sampler->pmf(even, light));
  }
}

INSTANTIATE_TEST_SUITE_P(Cuts, MirroredLamps, testing::Values(Strategy::kCellCut, Strategy::kPointCut));

}  // namespace
}  // namespace cellcut::test
