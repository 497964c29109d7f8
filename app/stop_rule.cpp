#include "app/stop_rule.h"

#include <algorithm>

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
      if (needsNoise(rule, state.passes)) share = isReached(rule, state) ? 1 : ratio * ratio;
      break;
    }
  }
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace cellcut
