/// \file ray.h
#pragma once

#include "renderer/base/math.h"

namespace cellcut {

/// Points origin + t · direction for 0 < t < tMax. The direction need not be unit.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float tMax = kInfinity;
};

}  // namespace cellcut
