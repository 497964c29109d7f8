#include "renderer/base/tone_map.h"

#include "renderer/base/srgb.h"

namespace cellcut {

namespace {

constexpr float kShoulder = 0.8f;  // where compression starts: Khronos PBR Neutral's F90 − F0 with the toe left out
constexpr float kDesaturation = 0.15f;  // Khronos PBR Neutral
constexpr float kBrightest = 0x1p60f;   // shown as white long before; keeps the quotients below finite

/// NaN compares false and becomes 0.
float clampChannel(float c) {
  return c > 0 ? std::min(c, kBrightest) : 0.0f;
}

Vec3 compress(const Vec3& color) {
  const float peak = maxComponent(color);
  if (peak <= kShoulder) return color;
  constexpr float range = 1 - kShoulder;
  const float newPeak = 1 - range * range / (peak + range - kShoulder);
  const float fade = 1 / (kDesaturation * (peak - newPeak) + 1);
  return newPeak + (color * (newPeak / peak) - newPeak) * fade;
}

}  // namespace

Vec3 toneMap(const Vec3& linear) {
  const Vec3 shown = compress({clampChannel(linear.x), clampChannel(linear.y), clampChannel(linear.z)});
  const auto encode = [](float c) { return std::clamp(linearToSrgb(c), 0.0f, 1.0f); };
  return {encode(shown.x), encode(shown.y), encode(shown.z)};
}

}  // namespace cellcut
