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
constexpr std::uint64_t kDeflateRatio = 1032;
constexpr std::int64_t kPngPixelsPerByte = kDeflateRatio * 8;
// A JPEG block of 8 × 8 pixels takes at least one bit.
constexpr std::int64_t kJpegPixelsPerByte = 8 * 64;

bool startsWith(std::span<const std::byte> bytes, std::span<const std::uint8_t> signature) {
  return bytes.size() >= signature.size() && std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
}

std::uint32_t bigEndian16(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<std::uint32_t>(bytes[at]) << 8 | std::to_integer<std::uint32_t>(bytes[at + 1]);
}

std::uint32_t bigEndian32(std::span<const std::byte> bytes, std::size_t at) {
  return bigEndian16(bytes, at) << 16 | bigEndian16(bytes, at + 2);
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

/// The tables that a JPEG has defined so far. stb decodes a scan whose tables are missing by memory that nobody wrote, and
/// reads anywhere. Source: ITU-T T.81, section B.2.
class JpegTables {
 public:
  /// \param segment  after its length
  void read(unsigned marker, std::span<const std::byte> segment) {
    constexpr unsigned kBaseline = 0xc0, kExtended = 0xc1, kProgressive = 0xc2, kHuffman = 0xc4, kQuantization = 0xdb;
    const auto byte = [&](std::size_t at) { return byteOf(segment, at); };
    if (marker == kBaseline || marker == kExtended || marker == kProgressive) {
      progressive_ = marker == kProgressive;
      for (std::size_t i = 0; i < byte(5); ++i) quantizationOf_[byte(6 + 3 * i)] = byte(8 + 3 * i) % 4;
    } else if (marker == kQuantization) {
      for (std::size_t at = 0; at < segment.size();) {
        quantization_[byte(at) % 4] = true;
        const bool isWide = byte(at) >= 16;
        at += isWide ? 129 : 65;
      }
    } else if (marker == kHuffman) {
      for (std::size_t at = 0; at < segment.size();) {
        huffman_[byte(at) / 16 % 2][byte(at) % 4] = true;
        std::size_t codes = 0;
        for (std::size_t i = 1; i <= 16; ++i) codes += byte(at + i);
        at += 17 + codes;
      }
    }
  }
  /// Whether all are there that a scan needs.
  bool suffice(std::span<const std::byte> scan) const {
    const auto byte = [&](std::size_t at) { return byteOf(scan, at); };
    const std::size_t components = byte(0);
    const unsigned firstCoefficient = byte(1 + 2 * components), refined = byte(3 + 2 * components) / 16;
    const bool needsDc = !progressive_ || (firstCoefficient == 0 && refined == 0);
    const bool needsAc = !progressive_ || firstCoefficient > 0;
    for (std::size_t i = 0; i < components; ++i) {
      const unsigned tables = byte(2 + 2 * i);
      if (needsDc && !huffman_[0][tables / 16 % 4]) return false;
      if (needsAc && !huffman_[1][tables % 4]) return false;
      if (!quantization_[quantizationOf_[byte(1 + 2 * i)]]) return false;
    }
    return true;
  }

 private:
  /// What is missing at the end is 0, as stb takes it.
  static unsigned byteOf(std::span<const std::byte> segment, std::size_t at) {
    return at < segment.size() ? std::to_integer<unsigned>(segment[at]) : 0;
  }
  bool progressive_ = false;
  std::array<unsigned, 256> quantizationOf_{};    ///< by component
  std::array<bool, 4> quantization_{};            ///< by number
  std::array<std::array<bool, 4>, 2> huffman_{};  ///< of DC, of AC coefficients, by number
};

/// stb goes over the whole picture for every scan, of which a small file may have thousands.
void checkJpegScans(std::span<const std::byte> jpeg, const std::string& name) {
  // A component is in one scan but in progressive pictures. Most of those have 10, and many in a picture are quick.
  constexpr int kMaxScans = 4, kMaxProgressiveScans = 128;
  constexpr unsigned kStuffed = 0x00, kProgressive = 0xc2, kRestart0 = 0xd0, kStart = 0xd8, kEnd = 0xd9, kScan = 0xda;
  int scans = 0, most = kMaxScans;
  JpegTables tables;
  for (std::size_t at = 0; at + 3 < jpeg.size();) {
    const unsigned first = std::to_integer<unsigned>(jpeg[at]), marker = std::to_integer<unsigned>(jpeg[at + 1]);
    ++at;
    if (first != 0xff || marker == 0xff) continue;
    ++at;
    if (marker == kEnd) return;
    if (marker == kStuffed || (marker >= kRestart0 && marker <= kStart)) continue;  // no segment
    if (marker == kProgressive) most = kMaxProgressiveScans;
    if (marker == kScan && ++scans > most) {
      throw InputError(name, "has more than " + std::to_string(most) + " JPEG scans; save it again");
    }
    const std::size_t length = std::clamp<std::size_t>(bigEndian16(jpeg, at), 2, jpeg.size() - at);
    const std::span<const std::byte> segment = jpeg.subspan(at + 2, length - 2);
    if (marker == kScan && !tables.suffice(segment)) {
      throw InputError(name, "a JPEG scan comes before its tables; save it again");
    }
    tables.read(marker, segment);
    at += length;
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
  if (png) forEachPngChunk(encoded, name, [](std::uint32_t, std::span<const std::byte>) {});

  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  int width = 0, height = 0, components = 0;
  if (!stbi_info_from_memory(bytes, static_cast<int>(encoded.size()), &width, &height, &components)) {
    throw InputError(name, std::string("has no valid header (") + stbi_failure_reason() + "); save it again");
  }
  checkImageSize(width, height, encoded.size(), png ? kPngPixelsPerByte : kJpegPixelsPerByte, name);
  return {width, height};
}

ImageRgba8 decodeImage8(std::span<const std::byte> encoded, const std::string& name) {
  const glm::ivec2 checked = imageSize8(encoded, name);  // refuses what stb should not see
  if (startsWith(encoded, kPngSignature)) {
    checkPngData(encoded, checked, name);
  } else {
    checkJpegScans(encoded, name);
  }
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
