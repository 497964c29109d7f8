#include "renderer/scene/texture.h"

#include "renderer/base/srgb.h"

#include <array>

namespace cellcut {
namespace {

/// Every 8-bit code decoded: a lookup costs twelve decodes, and pow() in each of them would dominate shading.
struct DecodeTables {
  std::array<float, 256> srgb;
  std::array<float, 256> linear;

  DecodeTables() {
    for (std::size_t code = 0; code < 256; ++code) {
      linear[code] = static_cast<float>(code) / 255.0f;
      srgb[code] = srgbToLinear(linear[code]);
    }
  }
};

const DecodeTables& decodeTables() {
  static const DecodeTables tables;
  return tables;
}

/// Texel index of an integer coordinate of any size, in [0, count).
int wrapped(double coordinate, int count, Wrap wrap) {
  const double n = count;
  switch (wrap) {
    case Wrap::kClamp:
      return static_cast<int>(std::clamp(coordinate, 0.0, n - 1));
    case Wrap::kRepeat:
      return static_cast<int>(coordinate - n * std::floor(coordinate / n));
    case Wrap::kMirror: {
      const double inPair = coordinate - 2 * n * std::floor(coordinate / (2 * n));
      return static_cast<int>(inPair < n ? inPair : 2 * n - 1 - inPair);
    }
  }
  return 0;
}

/// The two texels that a filtered coordinate lies between, and the share of the second.
struct Footprint {
  int first, second;
  float share;
};

Footprint footprint(float coordinate, int count, Wrap wrap, bool nearest) {
  // Double: in float, u · count would lose the fraction of a texel at coordinates that tile a large floor.
  const double texel = static_cast<double>(coordinate) * count;
  if (nearest) {
    const int index = wrapped(std::floor(texel), count, wrap);
    return {index, index, 0};
  }
  const double low = std::floor(texel - 0.5);
  return {wrapped(low, count, wrap), wrapped(low + 1, count, wrap), static_cast<float>(texel - 0.5 - low)};
}

Vec4 decode(const glm::vec<4, std::uint8_t>& texel, const std::array<float, 256>& rgb, const DecodeTables& tables) {
  return {rgb[texel.x], rgb[texel.y], rgb[texel.z], tables.linear[texel.w]};
}

}  // namespace

Vec4 lookup(const Scene& scene, const Texture& texture, TexelEncoding encoding, Vec2 uv) {
  const ImageRgba8& image = scene.texels[indexOf(texture.texels)];
  const DecodeTables& tables = decodeTables();
  const std::array<float, 256>& rgb = encoding == TexelEncoding::kSrgb ? tables.srgb : tables.linear;
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return decode(image.at(0, 0), rgb, tables);

  const Footprint s = footprint(uv.x, image.width(), texture.wrapS, texture.nearest);
  const Footprint t = footprint(uv.y, image.height(), texture.wrapT, texture.nearest);
  if (s.share == 0 && t.share == 0) return decode(image.at(s.first, t.first), rgb, tables);
  const Vec4 top = (1 - s.share) * decode(image.at(s.first, t.first), rgb, tables) +
                   s.share * decode(image.at(s.second, t.first), rgb, tables);
  const Vec4 bottom = (1 - s.share) * decode(image.at(s.first, t.second), rgb, tables) +
                      s.share * decode(image.at(s.second, t.second), rgb, tables);
  return (1 - t.share) * top + t.share * bottom;
}

}  // namespace cellcut
