// Portable float maps.
#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>

namespace cellcut {

namespace {

struct PfmHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::size_t channels = 0;
  float scale = 0;  ///< > 0
  bool littleEndian = false;
  std::size_t bytes = 0;
};

/// Next word and the one space after it.
/// \throws InputError when there is none
std::string_view nextWord(std::string_view text, std::size_t& at, const std::string& name) {
  const auto space = [&](std::size_t i) { return std::isspace(static_cast<unsigned char>(text[i])) != 0; };
  while (at < text.size() && space(at)) ++at;
  const std::size_t begin = at;
  while (at < text.size() && !space(at)) ++at;
  if (at == text.size()) throw InputError(name, "ends inside its PFM header; the file is damaged");
  return text.substr(begin, at++ - begin);
}

template <class T>
T parseNumber(std::string_view word, const std::string& name) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    throw InputError(name, "has no number where its PFM header needs one; the file is damaged");
  }
  return value;
}

PfmHeader parseHeader(std::span<const std::byte> encoded, const std::string& name) {
  PfmHeader header;
  const std::string_view text = asText(encoded.first(std::min<std::size_t>(encoded.size(), 256)));
  std::size_t at = 0;
  header.channels = nextWord(text, at, name) == "PF" ? 3 : 1;
  header.width = parseNumber<std::int64_t>(nextWord(text, at, name), name);
  header.height = parseNumber<std::int64_t>(nextWord(text, at, name), name);
  const auto scale = parseNumber<float>(nextWord(text, at, name), name);
  if (!std::isfinite(scale) || scale == 0) throw InputError(name, "has a PFM scale of 0 or none; write 1 or -1 there");
  header.littleEndian = scale < 0;
  header.scale = std::abs(scale);
  header.bytes = at;
  return header;
}

float loadFloat(const std::byte* bytes, bool littleEndian) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * (littleEndian ? i : 3 - i));
  }
  return std::bit_cast<float>(bits);
}

}  // namespace

bool isPfm(std::span<const std::byte> encoded) {
  const std::string_view text = asText(encoded);
  return text.size() > 2 && (text.starts_with("PF") || text.starts_with("Pf")) &&
         std::isspace(static_cast<unsigned char>(text[2]));
}

ImageRgb decodePfm(std::span<const std::byte> encoded, const std::string& name, std::uint64_t maxBytes) {
  const PfmHeader header = parseHeader(encoded, name);
  checkImageSize(header.width, header.height, encoded.size(), 1, name);
  checkDecodedBytes(header.width, header.height, maxBytes, name);
  ImageRgb image;
  const std::size_t pixels = static_cast<std::size_t>(header.width * header.height);
  if (encoded.size() - header.bytes < pixels * header.channels * sizeof(float)) {
    throw InputError(name, "ends before its last pixel; the file is damaged");
  }
  image = ImageRgb(static_cast<int>(header.width), static_cast<int>(header.height));
  const std::byte* at = encoded.data() + header.bytes;
  for (int y = image.height() - 1; y >= 0; --y) {  // the file begins with the bottom row
    for (int x = 0; x < image.width(); ++x) {
      Vec3 pixel;
      for (int c = 0; c < 3; ++c) {
        pixel[c] = header.scale * loadFloat(at, header.littleEndian);
        if (header.channels == 3 || c == 2) at += sizeof(float);
      }
      image.at(x, y) = pixel;
    }
  }
  return image;
}

std::vector<std::byte> encodePfm(const ImageRgb& image) {
  const std::string header = "PF\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n-1.0\n";
  std::vector<std::byte> encoded(header.size() + image.size() * 12);
  std::memcpy(encoded.data(), header.data(), header.size());
  std::byte* at = encoded.data() + header.size();
  for (int y = image.height() - 1; y >= 0; --y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto bits = std::bit_cast<std::uint32_t>(image.at(x, y)[c]);
        for (int i = 0; i < 4; ++i) *at++ = static_cast<std::byte>(bits >> (8 * i));
      }
    }
  }
  return encoded;
}

}  // namespace cellcut
