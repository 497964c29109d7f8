// Proofs 1 and 2 of every strategy: its probabilities are probabilities, they are those it samples with, and no light
// that contributes is left out.
#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/probabilities.h"
#include "tests/support/reference.h"
#include "tests/support/shading_points.h"
#include "tests/support/statistics.h"
#include "tests/support/strategies.h"

#include <array>
#include <numeric>

namespace cellcut::test {
namespace {

constexpr double kLastDouble = 1 - 0x1p-53;
/// The largest that 24 bits make.
constexpr double kLastFloat = 1 - 0x1p-24;

/// Quadrature cells per side of a triangle or texel: enough to see whether light arrives at all.
constexpr int kAnyLight = 8;

class LightSamplerPmf : public StrategyAndLights {
 protected:
  static std::size_t pointCount() { return sampleShare(byDepth(6, 64)); }
  /// \param check  called with lights, sampler and a point of the scene, for each number of lights
  void forEachPoint(std::span<const int> lightCounts, const auto& check) const {
    for (const int count : lightCounts) {
      SCOPED_TRACE(std::to_string(count) + " lights");
      const Scene scene = stage(mix(), count, seed());
      const Lights lights(scene);
      const auto sampler = samplerOf(lights);
      for (const ShadingPoint& point : pathVertices(scene, pointCount(), seed())) check(lights, *sampler, point);
    }
  }
};

TEST_P(LightSamplerPmf, SumsToOneOrNoLightReachesThePoint) {
  const std::array lightCounts{1, 2, 33, 1024};
  forEachPoint(lightCounts, [&](const Lights& lights, const LightSampler& sampler, const ShadingPoint& point) {
    expectSumToOne(variant(), sampler, point, allPmfs(sampler, lights, point), 40'000,
                   lightCounts.size() * pointCount());
  });
}

TEST_P(LightSamplerPmf, IsTheProbabilityThatASampleCarries) {
  forEachPoint(std::array{1, 2, 33, 1024},
               [&](const Lights& lights, const LightSampler& sampler, const ShadingPoint& point) {
                 Rng rng(seed());
                 std::vector<double> numbers{0, 0x1p-53, 0x1p-24, kLastFloat, kLastDouble};
                 // Every light costs time at every draw and every query: fewer of them by day.
                 const bool isSlow = variant().strategy == Strategy::kProportional && lights.size() > 100;
                 for (std::size_t i = 0; i < sampleShare(isSlow ? byDepth(20, 200) : 200); ++i)
                   numbers.push_back(rng.uniformDouble());
                 for (const double u : numbers) {
                   const auto sample = sampler.sample(point, u);
                   if (!sample) continue;
                   ASSERT_LT(static_cast<std::size_t>(sample->light), lights.size());
                   ASSERT_GT(sample->pmf, 0) << "u = " << u;
                   const float queried = sampler.pmf(point, sample->light);
                   // A few roundings in a different order of sums.
                   ASSERT_NEAR(queried / sample->pmf, 1, 1e-5) << "u = " << u;
                 }
               });
}

TEST_P(LightSamplerPmf, IsPositiveForEveryLightThatContributes) {
  forEachPoint(std::array{1, 2, 33, 1024}, [](const Lights& lights, const LightSampler& sampler,
                                              const ShadingPoint& point) {
    const std::vector<double> pmf = allPmfs(sampler, lights, point);
    for (std::size_t i = 0; i < pmf.size(); ++i) {
      ASSERT_GE(pmf[i], 0);
      if (pmf[i] > 0) continue;
      const glm::dvec3 contribution = referenceIrradiance(lights, static_cast<LightId>(i), point.p, point.n, kAnyLight);
      ASSERT_EQ(luminance(contribution), 0) << "light " << i << " of " << lights.size();
    }
  });
}

TEST_P(LightSamplerPmf, GivesNoSampleOnlyWhereNoLightContributes) {
  forEachPoint(std::array{1, 2, 33}, [&](const Lights& lights, const LightSampler& sampler, const ShadingPoint& point) {
    if (variant().canEndInNothing(point)) return;  // SumsToOneOrNoLightReachesThePoint
    if (sampler.sample(point, 0.5)) return;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      ASSERT_EQ(luminance(referenceIrradiance(lights, static_cast<LightId>(i), point.p, point.n, kAnyLight)), 0);
    }
  });
}

TEST_P(LightSamplerPmf, AgreesWithTheCountsOfSamples) {
  const Scene scene = stage(mix(), 33, seed());
  const Lights lights(scene);
  const auto sampler = samplerOf(lights);
  const std::vector<ShadingPoint> points = pathVertices(scene, byDepth(4, 64), seed());
  const std::size_t n =
      affordable(sampleShare(byDepth(400'000, std::max<std::size_t>(1'000'000, 100 * lights.size()))));
  // Over all points of all tests of this name: any change of the sampler draws anew in each.
  const double alpha = sidak(kAlpha, points.size() * kSamplerVariants.size() * kLightMixes.size());
  Rng rng(hashOf(seed(), 2));
  for (const ShadingPoint& point : points) {
    const std::vector<double> pmf = allPmfs(*sampler, lights, point);
    // The last outcome is that no light is drawn.
    std::vector<double> outcomes = pmf;
    outcomes.push_back(std::max(0.0, 1 - std::accumulate(pmf.begin(), pmf.end(), 0.0)));
    std::vector<std::uint64_t> counts(outcomes.size());
    for (std::size_t i = 0; i < n; ++i) {
      const auto sample = sampler->sample(point, rng.uniformDouble());
      ++counts[sample ? static_cast<std::size_t>(sample->light) : pmf.size()];
    }
    if (counts.back() == n) continue;
    const ChiSquare test = chiSquareTest(counts, outcomes);
    EXPECT_EQ(test.impossible, 0u);
    EXPECT_GT(test.p, alpha) << "chi square " << test.statistic << " with " << test.degreesOfFreedom
                             << " degrees of freedom";
  }
}

/// Red becomes green, green blue, blue red.
void turnChannels(Scene& scene) {
  const auto turn = [](Vec3& rgb) { rgb = {rgb.z, rgb.x, rgb.y}; };
  for (PointLight& light : scene.pointLights) turn(light.intensity);
  for (SpotLight& light : scene.spotLights) turn(light.intensity);
  for (DirectionalLight& light : scene.directionalLights) turn(light.irradiance);
  for (Material& material : scene.materials) turn(material.emission);
  if (scene.environment) std::for_each(scene.environment->radiance.begin(), scene.environment->radiance.end(), turn);
}

TEST_P(LightSamplerPmf, IsTheSameForEveryChannel) {
  const Scene scene = stage(mix(), 33, seed());
  Scene turned = scene;
  turnChannels(turned);
  const Lights lights(scene), turnedLights(turned);
  const auto sampler = samplerOf(lights), turnedSampler = samplerOf(turnedLights);
  for (const ShadingPoint& point : pathVertices(scene, pointCount(), seed())) {
    const std::vector<double> pmf = allPmfs(*sampler, lights, point);
    const std::vector<double> turnedPmf = allPmfs(*turnedSampler, turnedLights, point);
    ASSERT_EQ(turnedPmf.size(), pmf.size());
    // A sum of three squares in another order, and floats made of it.
    for (std::size_t i = 0; i < pmf.size(); ++i) ASSERT_NEAR(turnedPmf[i], pmf[i], 1e-5 * pmf[i]) << "light " << i;
  }
}

CELLCUT_FOR_ALL_STRATEGIES_AND_LIGHTS(LightSamplerPmf);

}  // namespace
}  // namespace cellcut::test
