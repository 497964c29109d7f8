/// \file image_codecs.h
/// One decoder and encoder per picture format, bytes to pixels and back. For image_io.cpp and its tests; users include
/// image_io.h.
///
/// Every decoder throws InputError naming `name` on bytes it cannot use, and allocates at most a fixed multiple of what
/// the file's own size makes plausible: a hundred bytes never ask for a gigabyte. `maxBytes` limits what comes out.
#pragma once

#include "renderer/base/image.h"
#include "renderer/base/image_io.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

/// Do the first bytes say that this is the format?
bool isExr(std::span<const std::byte> encoded);
bool isHdr(std::span<const std::byte> encoded);
bool isPfm(std::span<const std::byte> encoded);
bool isPng(std::span<const std::byte> encoded);
bool isJpeg(std::span<const std::byte> encoded);

/// OpenEXR: scan lines or tiles, half, float or uint; the first part that has R, G and B, or Y, without a layer's
/// prefix. The picture is the display window; pixels outside of the data window are black. Deep data and subsampled
/// chroma are refused.
ImageRgb decodeExr(std::span<const std::byte> encoded, const std::string& name,
                   std::uint64_t maxBytes = kMaxImageBytes);

/// Radiance RGBE, flat or run-length encoded (old and new), top row first.
/// Source: Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's color.c.
ImageRgb decodeHdr(std::span<const std::byte> encoded, const std::string& name,
                   std::uint64_t maxBytes = kMaxImageBytes);

/// PFM, colour (PF) or grey (Pf), either byte order; a scale other than ±1 multiplies. Source: Debevec's HDR Shop
/// documentation.
ImageRgb decodePfm(std::span<const std::byte> encoded, const std::string& name,
                   std::uint64_t maxBytes = kMaxImageBytes);

/// Little-endian colour PFM.
std::vector<std::byte> encodePfm(const ImageRgb& image);

/// What imageSize8 and decodeImage8 do for each kind.
glm::ivec2 pngSize(std::span<const std::byte> encoded, const std::string& name);
glm::ivec2 jpegSize(std::span<const std::byte> encoded, const std::string& name);
ImageRgba8 decodePng8(std::span<const std::byte> encoded, const std::string& name);
ImageRgba8 decodeJpeg8(std::span<const std::byte> encoded, const std::string& name, std::string* damage);

/// 8-bit PNG of `components` (3: RGB, 4: RGBA) interleaved components.
std::vector<std::byte> encodePng8(int width, int height, int components, const std::uint8_t* pixels);

/// The bytes as text, for formats whose headers are.
inline std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// \throws InputError unless both sides are positive, the picture has at most kMaxImagePixels, and `fileBytes` could
/// hold it when the format packs at most `pixelsPerByte` pixels into a byte.
void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, std::int64_t pixelsPerByte,
                    const std::string& name);

/// \throws InputError that names --max-texture-bytes if linear RGB of a size that checkImageSize lets through has more
/// than `maxBytes`
void checkDecodedBytes(std::int64_t width, std::int64_t height, std::uint64_t maxBytes, const std::string& name);

}  // namespace cellcut
