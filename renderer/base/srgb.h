/// \file srgb.h
/// The transfer function of sRGB. Source: IEC 61966-2-1.
#pragma once

namespace cellcut {

/// Encoded → linear, [0, 1] → [0, 1].
float srgbToLinear(float encoded);
/// Its inverse; above 1 the curve goes on.
float linearToSrgb(float linear);

}  // namespace cellcut
