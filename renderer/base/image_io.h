/// \file image_io.h
/// Pictures in and out of files. Every header is checked before anything of the size that it asks for is allocated.
/// Files are written beside their name and renamed, so that a name never holds half a picture.
#pragma once

#include "renderer/base/image.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cellcut {

/// Largest picture that is read, in pixels (16384 × 16384: a 4 GB environment map as float RGBA).
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 28;
/// Of the same as linear RGB.
inline constexpr std::uint64_t kMaxImageBytes = kMaxImagePixels * sizeof(Vec3);

/// 8-bit RGBA as stored in a PNG or JPEG; the meaning (sRGB or linear) is the user's.
using ImageRgba8 = Image<glm::vec<4, std::uint8_t>>;

/// A named layer of a multi-layer picture. With one channel the layer is a scalar, with three it is RGB or XYZ.
struct ImageLayer {
  std::string name;  ///< "" for the beauty (channels R, G, B), else the prefix: "normal" → normal.X …
  std::vector<std::string> channels;  ///< suffixes, one per component: {"R","G","B"}, {"X","Y","Z"}, {"Z"}
  std::vector<float> values;          ///< pixel-interleaved, width · height · channels.size()
};

/// A picture of one or more layers with what is known of how it was made.
struct LayeredImage {
  int width = 0;
  int height = 0;
  std::vector<ImageLayer> layers;
  std::map<std::string, std::string> metadata;
};

/// Reads linear RGB from .exr (the layer without a name, as 32-bit float; luminance-only files become grey; the display
/// window, black where there is no data), .pfm or .hdr. Rec. 709: converted from an EXR's primaries without adapting the
/// white point; other files are taken as that.
/// \param maxBytes  of the picture, decoded: less than what any may have only where --max-texture-bytes says so
/// \throws InputError if the file cannot be read, is damaged, has no RGB or Y, or is larger than maxBytes or
/// kMaxImagePixels.
ImageRgb readImage(const std::filesystem::path& file, std::uint64_t maxBytes = kMaxImageBytes);

/// The same from memory; the kind is known by its first bytes. `name` is used in messages only.
ImageRgb decodeImage(std::span<const std::byte> encoded, const std::string& name,
                     std::uint64_t maxBytes = kMaxImageBytes);

/// Width and height that the header of a PNG or JPEG tells.
/// \throws InputError as decodeImage8 does for headers
glm::ivec2 imageSize8(std::span<const std::byte> encoded, const std::string& name);

/// Decodes a PNG or JPEG that lies in memory. `name` is used in messages only.
/// \param damage  set to what is wrong with a JPEG that can be shown all the same, such as one that was cut off
/// \throws InputError as readImage.
ImageRgba8 decodeImage8(std::span<const std::byte> encoded, const std::string& name, std::string* damage = nullptr);

/// Encodes 8-bit RGBA as PNG.
std::vector<std::byte> encodePng(const ImageRgba8& image);

/// All layers as 32-bit float OpenEXR, ZIP-compressed.
std::vector<std::byte> encodeExr(const LayeredImage& image);

/// encodeExr into a file.
/// \throws InputError if the file cannot be written; the old file then stays.
void writeExr(const std::filesystem::path& file, const LayeredImage& image);

/// Writes raw linear RGB as little-endian PFM.
void writePfm(const std::filesystem::path& file, const ImageRgb& image);

/// Writes toneMap(exposure · c) of tone_map.h, 8 bits.
void writePng(const std::filesystem::path& file, const ImageRgb& image, float exposure = 1);

/// The file that a person means by a name: where its symbolic links lead, whether anything is there yet or not.
/// \throws InputError if something is there and no regular file, or cannot be looked at
std::filesystem::path writtenFile(const std::filesystem::path& file);

/// Writes `bytes` beside `file` and renames: a link of that name is replaced; writtenFile() follows it.
/// \throws InputError if that fails; the old file then stays.
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Whole file in memory.
/// \throws InputError if it is no regular file, cannot be read, or is larger than `maxBytes`.
std::vector<std::byte> readFile(const std::filesystem::path& file, std::uintmax_t maxBytes);

/// The extension with its dot, A to Z as a to z: ".exr" of "a.EXR".
std::string lowerExtension(const std::filesystem::path& file);

}  // namespace cellcut
