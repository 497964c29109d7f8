#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

/// Weighs every light at every point: two walks over all lights for a sample, one for a pmf, and no memory.
class ProportionalSampler final : public LightSampler {
 public:
  explicit ProportionalSampler(const Lights& lights) : lights_(lights) {}

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override {
    const double sum = totalIrradiance(point);
    if (!(sum > 0)) return std::nullopt;
    double left = u * sum;
    std::optional<SampledLight> last;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const auto light = static_cast<LightId>(i);
      const double weight = lights_.irradiance(light, point.p, point.n);
      const std::optional<SampledLight> drawn = sampledLight(light, weight / sum);
      if (!drawn) continue;
      last = drawn;
      left -= weight;
      if (left < 0) break;
    }
    return last;
  }

  float pmf(const ShadingPoint& point, LightId light) const override {
    const double sum = totalIrradiance(point);
    return sum > 0 ? static_cast<float>(lights_.irradiance(light, point.p, point.n) / sum) : 0.0f;
  }
  std::size_t bytes() const override { return 0; }

 private:
  double totalIrradiance(const ShadingPoint& point) const {
    double sum = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i)
      sum += lights_.irradiance(static_cast<LightId>(i), point.p, point.n);
    return sum;
  }

  const Lights& lights_;
};

}  // namespace

std::unique_ptr<LightSampler> makeProportionalSampler(const Lights& lights) {
  return std::make_unique<ProportionalSampler>(lights);
}

}  // namespace cellcut
