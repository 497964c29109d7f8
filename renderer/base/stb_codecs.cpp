// PNG and JPEG by way of stb.
#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include <climits>
#include <stb_image.h>
#include <stb_image_write.h>

namespace cellcut {

namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> kJpegSignature{0xff, 0xd8, 0xff};

// Deflate packs at most 1032 bytes into one (zlib's documentation), and a byte of a 1-bit PNG is 8 pixels.
constexpr std::int64_t kPngPixelsPerByte = 1032 * 8;
// A JPEG block of 8 × 8 pixels takes at least one bit.
constexpr std::int64_t kJpegPixelsPerByte = 8 * 64;

bool startsWith(std::span<const std::byte> bytes, std::span<const std::uint8_t> signature) {
  return bytes.size() >= signature.size() && std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
}

std::uint32_t bigEndian32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

/// stb allocates what a chunk's length asks for before it looks whether the chunk is there. What comes after the last
/// chunk it does not read.
void checkPngChunks(std::span<const std::byte> png, const std::string& name) {
  constexpr std::size_t kHeader = 8;  // length and type
  constexpr std::size_t kChecksum = 4;
  constexpr std::uint32_t kEnd = 0x49454e44;  // "IEND"
  std::size_t at = kPngSignature.size();
  while (png.size() - at >= kHeader) {
    const std::uint64_t length = bigEndian32(png, at);
    if (bigEndian32(png, at + 4) == kEnd) return;
    at += kHeader;
    if (length + kChecksum > png.size() - at)
      throw InputError(name, "a PNG chunk reaches past the end of the file; copy it again");
    at += length + kChecksum;
  }
}

struct StbFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

glm::ivec2 imageSize8(std::span<const std::byte> encoded, const std::string& name) {
  const bool png = startsWith(encoded, kPngSignature);
  if (!png && !startsWith(encoded, kJpegSignature))
    throw InputError(name, "is no PNG or JPEG picture; convert it to one");
  if (encoded.size() > INT_MAX) throw InputError(name, "is larger than 2 GB; scale the picture down");
  if (png) checkPngChunks(encoded, name);

  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  int width = 0, height = 0, components = 0;
  if (!stbi_info_from_memory(bytes, static_cast<int>(encoded.size()), &width, &height, &components)) {
    throw InputError(name, std::string("has no valid header (") + stbi_failure_reason() + "); save it again");
  }
  checkImageSize(width, height, encoded.size(), png ? kPngPixelsPerByte : kJpegPixelsPerByte, name);
  return {width, height};
}

ImageRgba8 decodeImage8(std::span<const std::byte> encoded, const std::string& name) {
  imageSize8(encoded, name);  // refuses what stb should not see
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  const int size = static_cast<int>(encoded.size());
  int width = 0, height = 0, components = 0;
  const std::unique_ptr<stbi_uc, StbFree> pixels(stbi_load_from_memory(bytes, size, &width, &height, &components, 4));
  if (!pixels) throw InputError(name, std::string("cannot be decoded (") + stbi_failure_reason() + "); save it again");
  ImageRgba8 image(width, height);
  std::memcpy(static_cast<void*>(image.data()), pixels.get(), image.size() * sizeof(*image.data()));
  return image;
}

std::vector<std::byte> encodePng8(int width, int height, int components, const std::uint8_t* pixels) {
  std::vector<std::byte> encoded;
  const auto append = [](void* context, void* data, int size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    auto& out = *static_cast<std::vector<std::byte>*>(context);
    out.insert(out.end(), bytes, bytes + size);
  };
  const bool done = stbi_write_png_to_func(append, &encoded, width, height, components, pixels, width * components);
  if (!done) throw std::bad_alloc();  // stb fails here for want of memory only
  return encoded;
}

}  // namespace cellcut
