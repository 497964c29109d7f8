/// \file texture.h
/// Lookups in textures: wrap, filter, decode.
#pragma once

#include "renderer/scene/scene.h"

namespace cellcut {

enum class TexelEncoding : std::uint8_t { kLinear, kSrgb };  ///< of RGB; alpha is always linear

/// Bilinear (or nearest) lookup. Texel (0, 0) is at the top left and covers uv [0, 1/width) × [0, 1/height) as in glTF.
/// Colours are decoded before they are filtered. `uv` that is not finite reads texel (0, 0).
Vec4 lookup(const Scene& scene, const Texture& texture, TexelEncoding encoding, Vec2 uv);

/// A slot's own coordinates for a triangle's texture coordinates.
inline Vec2 slotUv(const TextureSlot& slot, Vec2 uv) {
  return slot.uvLinear * uv + slot.uvOffset;
}

}  // namespace cellcut
