#include "renderer/sampling/cut_choice.h"
#include "renderer/sampling/facing.h"
#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

/// A cut found anew at every point, without cells. Source: Wang and Åkerlund 2009, "Bidirectional Importance Sampling
/// for Unstructured Direct Illumination".
class PointCutSampler final : public LightSampler {
 public:
  PointCutSampler(const Lights& lights, const SamplerSettings& settings) : trees_(lights), settings_(settings) {}

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override {
    const Cut cut = cutAt(point.p);
    return sampleCut(trees_, cut, cut.makeFarChoice(facingOf(point.n)), settings_.inCluster, point, u);
  }
  float pmf(const ShadingPoint& point, LightId light) const override {
    const Cut cut = cutAt(point.p);
    return pmfInCut(trees_, cut, cut.makeFarChoice(facingOf(point.n)), settings_.inCluster, point, light);
  }
  bool usesLobe() const override { return true; }
  std::size_t bytes() const override { return trees_.bytes(); }
  SamplerStatistics statistics() const override { return {.tree = trees_.statistics()}; }
  std::optional<CutStrategy> cutStrategy() const override { return CutStrategy{&trees_, nullptr, nullptr, settings_}; }

 private:
  Cut cutAt(const Vec3& p) const { return makeCut(trees_, {p, 0}, {settings_.threshold, settings_.maxCut}); }

  LightTrees trees_;
  SamplerSettings settings_;
};

}  // namespace

std::unique_ptr<LightSampler> makePointCutSampler(const Lights& lights, const SamplerSettings& settings) {
  return std::make_unique<PointCutSampler>(lights, settings);
}

}  // namespace cellcut
