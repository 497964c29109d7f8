#version 330 core
// A rendering on the screen: exposure, channel, tone map.
// The curve is renderer/base/tone_map.cpp's, formula by formula; tests/ui holds the two together.

uniform float gain;   // 2^EV
uniform int channel;  // 0 RGB, 1 R, 2 G, 3 B, 4 luminance
uniform int toneMapped;

out vec4 shown;

vec4 shownTexel();  // texel.frag: linear Rec. 709, alpha 1

const float kShoulder = 0.8;
const float kDesaturation = 0.15;
const float kBrightest = 1152921504606846976.0;  // 2^60

// NaN compares false and becomes 0; written as the C++ is, because max() and clamp() may return either.
float clampChannel(float c) { return c > 0.0 ? (c < kBrightest ? c : kBrightest) : 0.0; }

vec3 compress(vec3 color) {
  float peak = max(color.r, max(color.g, color.b));
  if (peak <= kShoulder) return color;
  const float range = 1.0 - kShoulder;
  float newPeak = 1.0 - range * range / (peak + range - kShoulder);
  float fade = 1.0 / (kDesaturation * (peak - newPeak) + 1.0);
  return newPeak + (color * (newPeak / peak) - newPeak) * fade;
}

float encode(float c) {
  return clamp(c <= 0.0031308 ? c * 12.92 : 1.055 * pow(c, 1.0 / 2.4) - 0.055, 0.0, 1.0);
}

vec3 selectChannel(vec3 c) {
  if (channel == 0) return c;
  if (channel == 4) return vec3(dot(c, vec3(0.2126, 0.7152, 0.0722)));
  return vec3(channel == 1 ? c.r : channel == 2 ? c.g : c.b);
}

void main() {
  vec3 linear = gain * selectChannel(shownTexel().rgb);
  vec3 clamped = vec3(clampChannel(linear.r), clampChannel(linear.g), clampChannel(linear.b));
  vec3 mapped = toneMapped != 0 ? compress(clamped) : clamped;
  shown = vec4(encode(mapped.r), encode(mapped.g), encode(mapped.b), 1.0);
}
