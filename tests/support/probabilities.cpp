#include "tests/support/probabilities.h"

#include "tests/support/reference.h"

#include <numeric>

#include <gtest/gtest.h>

namespace cellcut::test {

std::vector<double> allPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point) {
  std::vector<double> pmf(lights.size());
  for (std::size_t i = 0; i < pmf.size(); ++i) pmf[i] = sampler.pmf(point, static_cast<LightId>(i));
  return pmf;
}

namespace {

/// Irradiance, luminance.
double contribution(const Lights& lights, LightId light, const ShadingPoint& point) {
  constexpr int kQuadrature = 4;  // cells per side: whether light arrives at all
  return lights.liesAt(light, point.p) ? 0
                                       : luminance(referenceIrradiance(lights, light, point.p, point.n, kQuadrature));
}

}  // namespace

void expectSoundPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point, double reach) {
  // Of each of at most some thousand probabilities that are rounded to floats: 6e-8 of it.
  constexpr double kRounding = 1e-5;
  const std::vector<double> pmf = allPmfs(sampler, lights, point);
  EXPECT_LE(std::accumulate(pmf.begin(), pmf.end(), 0.0), 1 + kRounding);
  double all = 0;
  for (std::size_t i = 0; reach > 0 && i < pmf.size(); ++i) all += contribution(lights, static_cast<LightId>(i), point);
  for (std::size_t i = 0; i < pmf.size(); ++i) {
    ASSERT_GE(pmf[i], 0) << "light " << i;
    if (pmf[i] > 0) continue;
    ASSERT_LE(contribution(lights, static_cast<LightId>(i), point), reach * all) << "light " << i;
  }
  for (const double u : {0.0, 0x1p-53, 0.1, 0.25, 0.5, 0.7, 0.9, 1 - 0x1p-24, 1 - 0x1p-53}) {
    const auto sample = sampler.sample(point, u);
    if (!sample) continue;
    ASSERT_LT(static_cast<std::size_t>(sample->light), lights.size());
    ASSERT_GT(sample->pmf, 0) << "u = " << u;
    ASSERT_NEAR(pmf[static_cast<std::size_t>(sample->light)] / static_cast<double>(sample->pmf), 1, kRounding);
  }
}

}  // namespace cellcut::test
