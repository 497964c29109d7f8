#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

class UniformSampler final : public LightSampler {
 public:
  explicit UniformSampler(std::size_t lights) : lights_(lights) {}

  std::optional<SampledLight> sample(const ShadingPoint&, double u) const override {
    if (lights_ == 0) return std::nullopt;
    const auto i = std::min(static_cast<std::size_t>(u * static_cast<double>(lights_)), lights_ - 1);
    return SampledLight{static_cast<LightId>(i), 1 / static_cast<float>(lights_)};
  }
  float pmf(const ShadingPoint&, LightId) const override { return 1 / static_cast<float>(lights_); }
  std::size_t bytes() const override { return 0; }

 private:
  std::size_t lights_;
};

}  // namespace

std::unique_ptr<LightSampler> makeUniformSampler(const Lights& lights) {
  return std::make_unique<UniformSampler>(lights.size());
}

}  // namespace cellcut
