#include "renderer/sampling/alias_table.h"
#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

std::vector<double> fluxes(const Lights& lights) {
  std::vector<double> flux(lights.size());
  for (std::size_t i = 0; i < flux.size(); ++i) flux[i] = lights.flux(static_cast<LightId>(i));
  return flux;
}

class PowerSampler final : public LightSampler {
 public:
  explicit PowerSampler(const Lights& lights) : table_(fluxes(lights)) {}

  std::optional<SampledLight> sample(const ShadingPoint&, double u) const override {
    if (table_.empty()) return std::nullopt;
    const std::size_t i = table_.sample(u).index;
    return sampledLight(static_cast<LightId>(i), static_cast<double>(table_.pmf(i)));
  }
  float pmf(const ShadingPoint&, LightId light) const override { return table_.pmf(static_cast<std::size_t>(light)); }
  std::size_t bytes() const override { return table_.bytes(); }

 private:
  AliasTable table_;
};

}  // namespace

std::unique_ptr<LightSampler> makePowerSampler(const Lights& lights) {
  return std::make_unique<PowerSampler>(lights);
}

}  // namespace cellcut
