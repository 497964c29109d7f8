#include "app/stop_rule.h"

#include <algorithm>
#include <cmath>

namespace cellcut {

bool needsNoise(const StopRule& rule, std::uint64_t passes) {
  return rule.kind == StopRule::Kind::kNoise && passes >= kMinNoisePasses;
}

bool isReached(const StopRule& rule, const RenderState& state) {
  switch (rule.kind) {
    case StopRule::Kind::kPasses:
      return state.passes >= rule.passes;
    case StopRule::Kind::kSeconds:
      return state.passes > 0 && state.seconds >= rule.seconds;
    case StopRule::Kind::kNoise:
      break;
  }
  return needsNoise(rule, state.passes) && !(state.relativeError >= rule.noise);
}

double doneShare(const StopRule& rule, const RenderState& state) {
  double share = 0;
  switch (rule.kind) {
    case StopRule::Kind::kPasses:
      share = static_cast<double>(state.passes) / static_cast<double>(rule.passes);
      break;
    case StopRule::Kind::kSeconds:
      share = state.seconds / rule.seconds;
      break;
    case StopRule::Kind::kNoise: {
      const double ratio = rule.noise / state.relativeError;
      share = needsNoise(rule, state.passes) && state.relativeError > 0 ? ratio * ratio : 0;
      break;
    }
  }
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace cellcut
