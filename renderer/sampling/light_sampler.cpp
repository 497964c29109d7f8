#include "renderer/sampling/light_sampler.h"

#include "renderer/sampling/strategies.h"

#include <cassert>

namespace cellcut {

std::unique_ptr<LightSampler> makeLightSampler(Strategy strategy, const Lights& lights) {
  switch (strategy) {
    case Strategy::kUniform:
      return makeUniformSampler(lights);
    case Strategy::kPower:
      return makePowerSampler(lights);
    case Strategy::kProportional:
      return makeProportionalSampler(lights);
  }
  assert(false);
  return nullptr;
}

}  // namespace cellcut
