// PNG by way of stb.
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

// Deflate packs at most 1032 bytes into one (zlib's documentation), and a byte of a 1-bit PNG is 8 pixels.
constexpr std::uint64_t kDeflateRatio = 1032;
constexpr std::int64_t kPngPixelsPerByte = kDeflateRatio * 8;

std::uint32_t bigEndian32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return number;
}

/// Calls visit(type, data) for each chunk but the last, after which stb reads nothing.
/// \throws InputError if one is not there: stb allocates what its length asks for before it looks
template <class Visit>
void forEachPngChunk(std::span<const std::byte> png, const std::string& name, const Visit& visit) {
  constexpr std::size_t kHeader = 8;  // length and type
  constexpr std::size_t kChecksum = 4;
  constexpr std::uint32_t kEnd = 0x49454e44;  // "IEND"
  std::size_t at = kPngSignature.size();
  while (png.size() - at >= kHeader) {
    const std::uint64_t length = bigEndian32(png, at);
    const std::uint32_t type = bigEndian32(png, at + 4);
    if (type == kEnd) return;
    at += kHeader;
    if (length + kChecksum > png.size() - at)
      throw InputError(name, "a PNG chunk reaches past the end of the file; copy it again");
    visit(type, png.subspan(at, length));
    at += length + kChecksum;
  }
}

/// stb unpacks all that the data hold, however small the picture is. Here they are unpacked before, into no more than
/// that, where they are long enough for more.
void checkPngData(std::span<const std::byte> png, glm::ivec2 size, const std::string& name) {
  constexpr std::uint32_t kData = 0x49444154;   // "IDAT"
  constexpr std::uint32_t kApple = 0x43674249;  // "CgBI": data without zlib's header
  std::vector<std::byte> data;
  bool hasHeader = true;
  forEachPngChunk(png, name, [&](std::uint32_t type, std::span<const std::byte> chunk) {
    if (type == kData) data.insert(data.end(), chunk.begin(), chunk.end());
    if (type == kApple) hasHeader = false;
  });
  // A pixel has eight bytes at most and a row one more, of which an interlaced picture has twice as many.
  constexpr std::uint64_t kTolerated = std::uint64_t{64} << 20;
  const glm::u64vec2 pixels(size);
  const std::uint64_t most = std::min<std::uint64_t>(8 * pixels.x * pixels.y + 2 * pixels.y + kTolerated, INT_MAX);
  if (data.size() * kDeflateRatio <= most) return;
  const auto unpack = hasHeader ? stbi_zlib_decode_buffer : stbi_zlib_decode_noheader_buffer;
  const auto unpacked = std::make_unique_for_overwrite<char[]>(most);  // what is not written is not touched
  const auto* packed = reinterpret_cast<const char*>(data.data());
  if (unpack(unpacked.get(), static_cast<int>(most), packed, static_cast<int>(data.size())) < 0) {
    throw InputError(name, "its data are damaged or unpack to more than " + std::to_string(size.x) + " x " +
                               std::to_string(size.y) + " pixels; save it again");
  }
}

struct StbFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

bool isPng(std::span<const std::byte> encoded) {
  return encoded.size() >= kPngSignature.size() &&
         std::memcmp(encoded.data(), kPngSignature.data(), kPngSignature.size()) == 0;
}

glm::ivec2 pngSize(std::span<const std::byte> encoded, const std::string& name) {
  if (encoded.size() > INT_MAX) throw InputError(name, "is larger than 2 GB; scale the picture down");
  forEachPngChunk(encoded, name, [](std::uint32_t, std::span<const std::byte>) {});
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  int width = 0, height = 0, components = 0;
  if (!stbi_info_from_memory(bytes, static_cast<int>(encoded.size()), &width, &height, &components)) {
    throw InputError(name, std::string("has no valid header (") + stbi_failure_reason() + "); save it again");
  }
  checkImageSize(width, height, encoded.size(), kPngPixelsPerByte, name);
  return {width, height};
}

ImageRgba8 decodePng8(std::span<const std::byte> encoded, const std::string& name) {
  checkPngData(encoded, pngSize(encoded, name), name);  // refuses what stb should not see
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
