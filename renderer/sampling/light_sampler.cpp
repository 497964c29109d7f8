#include "renderer/sampling/light_sampler.h"

#include "renderer/sampling/strategies.h"

#include <cassert>

namespace cellcut {

std::unique_ptr<LightSampler> makeLightSampler(Strategy strategy, const Lights& lights, const SamplerSettings& settings,
                                               std::span<const Vec3> pilot) {
  // One light is no choice: trees, a grid and cells for it would be 13 % of a pass and megabytes for nothing.
  if (lights.size() == 1) return makeUniformSampler(lights);
  switch (strategy) {
    case Strategy::kUniform:
      return makeUniformSampler(lights);
    case Strategy::kPower:
      return makePowerSampler(lights);
    case Strategy::kProportional:
      return makeProportionalSampler(lights);
    case Strategy::kCellCut:
      return makeCellCutSampler(lights, settings, pilot);
    case Strategy::kPointCut:
      return makePointCutSampler(lights, settings);
    case Strategy::kLightTree:
      return makeLightTreeSampler(lights);
  }
  assert(false);
  return nullptr;
}

}  // namespace cellcut
