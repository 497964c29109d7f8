#version 330 core
// A rendering on the screen: exposure, channel, tone map, split between two pictures, overlay.
// The curve is renderer/base/tone_map.cpp's, formula by formula; tests/ui holds the two together.

uniform sampler2D imageA;   // linear Rec. 709, row 0 at the top
uniform sampler2D imageB;
uniform sampler2D overlay;  // sRGB-encoded, straight alpha
uniform float framebufferHeight;  // window coordinates here count from below
uniform vec2 origin;        // of the picture on the framebuffer, from the top left
uniform vec2 imageSize;     // of A, in image pixels
uniform float scale;        // framebuffer pixels per image pixel
uniform float gain;         // 2^EV
uniform float split;        // share of the width that shows A
uniform float overlayOpacity;
uniform int channel;        // 0 RGB, 1 R, 2 G, 3 B, 4 luminance
uniform int toneMapped;

out vec4 shown;

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

// At and above 1:1 the texel at `at`, in [0, 1]² over the picture; below, the mean over the area that the framebuffer's
// pixel covers, of at most about eight texels each way.
vec4 fetch(sampler2D image, vec2 at, bool premultiply) {
  ivec2 size = textureSize(image, 0);
  vec2 centre = at * vec2(size);
  if (scale >= 1.0) {
    vec4 texel = texelFetch(image, clamp(ivec2(floor(centre)), ivec2(0), size - 1), 0);
    return premultiply ? vec4(texel.rgb * texel.a, texel.a) : texel;
  }
  vec2 width = vec2(size) / (scale * imageSize);
  vec2 lower = max(centre - 0.5 * width, vec2(0.0));
  vec2 upper = min(centre + 0.5 * width, vec2(size));
  ivec2 stride = ivec2(ceil(width / 8.0));
  vec4 sum = vec4(0.0);
  float area = 0.0;
  for (int y = int(lower.y); float(y) < upper.y; y += stride.y) {
    float height = min(upper.y, float(y + 1)) - max(lower.y, float(y));
    for (int x = int(lower.x); float(x) < upper.x; x += stride.x) {
      vec4 texel = texelFetch(image, ivec2(x, y), 0);
      float weight = height * (min(upper.x, float(x + 1)) - max(lower.x, float(x)));
      sum += weight * (premultiply ? vec4(texel.rgb * texel.a, texel.a) : texel);
      area += weight;
    }
  }
  return sum / area;
}

vec3 selectChannel(vec3 c) {
  if (channel == 0) return c;
  if (channel == 4) return vec3(dot(c, vec3(0.2126, 0.7152, 0.0722)));
  return vec3(channel == 1 ? c.r : channel == 2 ? c.g : c.b);
}

void main() {
  vec2 position = vec2(gl_FragCoord.x, framebufferHeight - gl_FragCoord.y);
  vec2 at = (position - origin) / (scale * imageSize);
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) discard;

  vec4 texel = at.x < split ? fetch(imageA, at, false) : fetch(imageB, at, false);
  vec3 linear = gain * selectChannel(texel.rgb);
  vec3 clamped = vec3(clampChannel(linear.r), clampChannel(linear.g), clampChannel(linear.b));
  vec3 mapped = toneMapped != 0 ? compress(clamped) : clamped;
  vec3 display = vec3(encode(mapped.r), encode(mapped.g), encode(mapped.b));

  vec4 over = overlayOpacity > 0.0 ? overlayOpacity * fetch(overlay, at, true) : vec4(0.0);
  shown = vec4(display * (1.0 - over.a) + over.rgb, 1.0);
}
