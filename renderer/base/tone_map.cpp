#include "renderer/base/tone_map.h"

namespace cellcut {

namespace {

constexpr float kShoulder = 0.8f;  // where compression starts: Khronos PBR Neutral's F90 − F0 with the toe left out
constexpr float kDesaturation = 0.15f;  // Khronos PBR Neutral
constexpr float kBrightest = 0x1p60f;   // shown as white long before; keeps the quotients below finite

/// NaN compares false and becomes 0.
float clampChannel(float c) {
  return c > 0 ? std::min(c, kBrightest) : 0.0f;
}

/// sRGB opto-electronic transfer function, IEC 61966-2-1.
float encodeSrgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
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
  const auto encode = [](float c) { return std::clamp(encodeSrgb(c), 0.0f, 1.0f); };
  return {encode(shown.x), encode(shown.y), encode(shown.z)};
}

}  // namespace cellcut
