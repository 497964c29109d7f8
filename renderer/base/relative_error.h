/// \file relative_error.h
/// The ε of relative squared errors: (picture − truth)² / (truth² + ε).
#pragma once

namespace cellcut {

/// ε as a share of the square of the picture's mean: without it, pixels that are nearly black would be all that counts.
inline constexpr double kRelativeEpsilon = 0.01;

}  // namespace cellcut
