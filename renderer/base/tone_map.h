/// \file tone_map.h
/// From scene-linear colour to what a display shows.
#pragma once

#include "renderer/base/math.h"

namespace cellcut {

/// Linear Rec. 709 [0, ∞) → display [0, 1], sRGB-encoded. Up to 0.8 a colour is shown exactly as it is; above, its
/// largest channel is rolled off towards 1 with the hue kept, and very bright colours fade to white. NaN and negative
/// channels become 0.
///
/// Source: Khronos PBR Neutral Tone Mapper (2024), without its toe: that one takes the 4 % of a dielectric's Fresnel
/// reflection off again, which suits products under studio light and crushes the shadows of a night scene.
Vec3 toneMap(const Vec3& linear);

}  // namespace cellcut
