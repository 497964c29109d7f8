#include "tests/support/probabilities.h"

#include "renderer/base/rng.h"
#include "renderer/lights/scalar_emission.h"
#include "tests/support/depth.h"
#include "tests/support/reference.h"
#include "tests/support/statistics.h"

#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {

std::vector<double> allPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point) {
  std::vector<double> pmf(lights.size());
  for (std::size_t i = 0; i < pmf.size(); ++i) pmf[i] = sampler.pmf(point, static_cast<LightId>(i));
  return pmf;
}

namespace {

/// Of probabilities that are rounded to floats, each by 6e-8 of itself; and of sums of some thousand floats.
constexpr double kSumRounding = 1e-5;

/// Whether a point is a corner of a triangle light. It lies in its plane and gets nothing, but for a quadrature's
/// rounding.
bool isCornerOf(const Lights& lights, LightId light, const Vec3& p) {
  if (lights.kind(light) != LightKind::kTriangle) return false;
  const TriangleLight& triangle = lights.triangles()[lights.indexInKind(light)];
  const auto corners = triangleGeometry(lights.scene().meshes[indexOf(triangle.mesh)], triangle.triangle).corners;
  return std::find(corners.begin(), corners.end(), p) != corners.end();
}

/// Irradiance, as lights are weighed by.
double contribution(const Lights& lights, LightId light, const ShadingPoint& point) {
  constexpr int kQuadrature = 4;  // cells per side: whether light arrives at all
  if (lights.liesAt(light, point.p) || isCornerOf(lights, light, point.p)) return 0;
  return scalarEmission(referenceIrradiance(lights, light, point.p, point.n, kQuadrature));
}

}  // namespace

void expectSumToOne(const SamplerVariant& variant, const LightSampler& sampler, const ShadingPoint& point,
                    std::span<const double> pmf, std::size_t draws, std::size_t comparisons) {
  const double sum = std::accumulate(pmf.begin(), pmf.end(), 0.0);
  if (!variant.canEndInNothing(point)) {
    EXPECT_NEAR(sum, sampler.sample(point, 0.5) ? 1 : 0, kSumRounding);
    return;
  }
  EXPECT_LE(sum, 1 + kSumRounding);
  const std::size_t n = variant.affordable(sampleShare(draws));
  const auto samples = static_cast<double>(n);
  // One number from each n-th of the unit interval: varies less than the binomial that is allowed for.
  std::size_t none = 0;
  Rng rng(5);
  for (std::size_t i = 0; i < n; ++i) {
    none += !sampler.sample(point, (static_cast<double>(i) + rng.uniformDouble()) / samples);
  }
  const double missing = std::max(0.0, 1 - sum), limit = criticalZ(comparisons);
  // Of few that are expected the tails are longer than a normal variable's: Bernstein's inequality.
  EXPECT_NEAR(static_cast<double>(none), missing * samples,
              limit * std::sqrt(samples * missing * (1 - std::min(1.0, missing))) +
                  (missing > 0 ? limit * limit / 3 : 0) + kSumRounding * samples);
}

void expectSoundPmfs(const SamplerVariant& variant, const LightSampler& sampler, const Lights& lights,
                     const ShadingPoint& point, double reach) {
  // Of the points of all tests together, about.
  constexpr std::size_t kDraws = 1000, kComparisons = 10'000;
  const std::vector<double> pmf = allPmfs(sampler, lights, point);
  expectSumToOne(variant, sampler, point, pmf, kDraws, kComparisons);
  const bool allReached = std::all_of(pmf.begin(), pmf.end(), [](double p) { return p > 0; });
  std::vector<double> contributions(pmf.size());
  for (std::size_t i = 0; !allReached && i < pmf.size(); ++i) {
    if (reach > 0 || !(pmf[i] > 0)) contributions[i] = contribution(lights, static_cast<LightId>(i), point);
  }
  const double reached = reach * std::accumulate(contributions.begin(), contributions.end(), 0.0);
  for (std::size_t i = 0; i < pmf.size(); ++i) {
    ASSERT_GE(pmf[i], 0) << "light " << i;
    if (pmf[i] > 0) continue;
    ASSERT_LE(contributions[i], reached) << "light " << i;
  }
  for (const double u : {0.0, 0x1p-53, 0.1, 0.25, 0.5, 0.7, 0.9, 1 - 0x1p-24, 1 - 0x1p-53}) {
    const auto sample = sampler.sample(point, u);
    if (!sample) continue;
    ASSERT_LT(static_cast<std::size_t>(sample->light), lights.size());
    ASSERT_GT(sample->pmf, 0) << "u = " << u;
    ASSERT_NEAR(pmf[static_cast<std::size_t>(sample->light)] / static_cast<double>(sample->pmf), 1, kSumRounding);
  }
}

}  // namespace cellcut::test
