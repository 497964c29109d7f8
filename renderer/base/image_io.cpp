#include "renderer/base/image_io.h"

#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"
#include "renderer/base/tone_map.h"

namespace cellcut {

namespace {

/// Four float channels of the largest picture, uncompressed, and room for headers.
constexpr std::uintmax_t kMaxFileBytes = static_cast<std::uintmax_t>(kMaxImagePixels) * 16 + (1u << 24);

}  // namespace

void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, std::int64_t pixelsPerByte,
                    const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width <= 0 || height <= 0) throw InputError(name, "its header says " + size + " pixels; the file is damaged");
  if (width > kMaxImagePixels / height) {
    throw InputError(name, size + " pixels are more than the limit of " + std::to_string(kMaxImagePixels) +
                               "; scale the picture down");
  }
  if (width * height / pixelsPerByte > static_cast<std::int64_t>(fileBytes)) {
    throw InputError(
        name, size + " pixels cannot be in a file of " + std::to_string(fileBytes) + " bytes; the file is damaged");
  }
}

void checkDecodedBytes(std::int64_t width, std::int64_t height, std::uint64_t maxBytes, const std::string& name) {
  const std::uint64_t bytes = static_cast<std::uint64_t>(width * height) * sizeof(Vec3);
  if (bytes <= maxBytes) return;
  throw InputError(name, std::to_string(width) + " x " + std::to_string(height) + " pixels have " +
                             std::to_string(bytes) + " bytes decoded, more than " + std::to_string(maxBytes) +
                             ", the limit (--max-texture-bytes)");
}

ImageRgb decodeImage(std::span<const std::byte> encoded, const std::string& name, std::uint64_t maxBytes) {
  if (isExr(encoded)) return decodeExr(encoded, name, maxBytes);
  if (isHdr(encoded)) return decodeHdr(encoded, name, maxBytes);
  if (isPfm(encoded)) return decodePfm(encoded, name, maxBytes);
  throw InputError(name, "is no OpenEXR, Radiance HDR or PFM picture; convert it to one of these");
}

ImageRgb readImage(const std::filesystem::path& file, std::uint64_t maxBytes) {
  return decodeImage(readFile(file, kMaxFileBytes), file.string(), maxBytes);
}

glm::ivec2 imageSize8(std::span<const std::byte> encoded, const std::string& name) {
  if (isPng(encoded)) return pngSize(encoded, name);
  if (isJpeg(encoded)) return jpegSize(encoded, name);
  throw InputError(name, "is no PNG or JPEG picture; convert it to one");
}

ImageRgba8 decodeImage8(std::span<const std::byte> encoded, const std::string& name, std::string* damage) {
  if (isPng(encoded)) return decodePng8(encoded, name);
  if (isJpeg(encoded)) return decodeJpeg8(encoded, name, damage);
  throw InputError(name, "is no PNG or JPEG picture; convert it to one");
}

std::vector<std::byte> encodePng(const ImageRgba8& image) {
  return encodePng8(image.width(), image.height(), 4, reinterpret_cast<const std::uint8_t*>(image.data()));
}

void writeExr(const std::filesystem::path& file, const LayeredImage& image) {
  writeFileAtomically(file, encodeExr(image));
}

void writePfm(const std::filesystem::path& file, const ImageRgb& image) {
  writeFileAtomically(file, encodePfm(image));
}

void writePng(const std::filesystem::path& file, const ImageRgb& image, float exposure) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.size() * 3);
  for (const Vec3& linear : image) {
    const Vec3 display = toneMap(exposure * linear);
    for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<std::uint8_t>(255 * display[c] + 0.5f));
  }
  writeFileAtomically(file, encodePng8(image.width(), image.height(), 3, pixels.data()));
}

}  // namespace cellcut
