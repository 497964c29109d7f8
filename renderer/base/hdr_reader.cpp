// Radiance RGBE. stb has a reader, but that of Debian 12 never returns from a file cut off inside a run
// (CVE-2021-42715) and shows uninitialised memory after one cut off in flat data.
#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"

#include <array>
#include <charconv>

namespace cellcut {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// A run of 127 equal bytes takes two: 4 · 2 bytes for 127 pixels, next to 4 bytes per row; an old-style run of 2²⁴ rows
// is not written by anybody.
constexpr std::int64_t kPixelsPerByte = 16;

class HdrReader {
 public:
  HdrReader(std::span<const std::byte> encoded, const std::string& name) : bytes_(encoded), name_(name) {}

  ImageRgb read(std::uint64_t maxBytes) {
    readHeader();
    const auto [width, height] = readResolution();
    checkImageSize(width, height, bytes_.size(), kPixelsPerByte, name_);
    checkDecodedBytes(width, height, maxBytes, name_);
    ImageRgb image(static_cast<int>(width), static_cast<int>(height));
    std::vector<Rgbe> row(static_cast<std::size_t>(width));
    for (int y = 0; y < image.height(); ++y) {
      readRow(row);
      for (int x = 0; x < image.width(); ++x) image.at(x, y) = toLinear(row[static_cast<std::size_t>(x)]);
    }
    return image;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const { throw InputError(name_, problem); }

  std::uint8_t nextByte() {
    if (at_ == bytes_.size()) refuse("ends before its last pixel; the file is damaged");
    return std::to_integer<std::uint8_t>(bytes_[at_++]);
  }

  std::string_view nextLine() {
    const std::string_view rest = asText(bytes_.subspan(at_));
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) refuse("ends inside its header; the file is damaged");
    at_ += end + 1;
    return rest.substr(0, end);
  }

  void readHeader() {
    for (std::string_view line = nextLine(); !line.empty(); line = nextLine()) {
      if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
        refuse("is in Radiance's " + std::string(line.substr(7)) + "; convert it to 32-bit_rle_rgbe");
      }
    }
  }

  /// "-Y height +X width": rows from the top, pixels from the left; the other seven orders are legal and nobody writes
  /// them.
  std::array<std::int64_t, 2> readResolution() {
    const std::string_view line = nextLine();
    const std::size_t x = line.find(" +X ");
    if (!line.starts_with("-Y ") || x == std::string_view::npos) refuse("is turned or mirrored; save it as -Y +X");
    return {parse(line.substr(x + 4)), parse(line.substr(3, x - 3))};
  }

  std::int64_t parse(std::string_view word) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      refuse("has no size in its header; the file is damaged");
    return value;
  }

  void readRow(std::vector<Rgbe>& row) {
    const Rgbe first{nextByte(), nextByte(), nextByte(), nextByte()};
    // Only rows of 8 … 32767 pixels are run-length encoded by component, and they begin with this mark.
    const bool runs = row.size() >= 8 && row.size() < 32768 && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!runs) return readFlat(first, row);
    if (static_cast<std::size_t>(first[2] << 8 | first[3]) != row.size())
      refuse("has a row of another length; the file is damaged");
    for (std::size_t component = 0; component < 4; ++component) readRuns(component, row);
  }

  void readRuns(std::size_t component, std::vector<Rgbe>& row) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = nextByte();
      const bool run = code > 128;
      const std::size_t count = run ? code - 128u : code;
      if (count == 0 || count > row.size() - x) refuse("has a run past the end of its row; the file is damaged");
      const std::uint8_t value = run ? nextByte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) row[x++][component] = run ? value : nextByte();
    }
  }

  /// Pixel after pixel; (1, 1, 1, n) repeats the last one n times, and the next such one counts in multiples of 256.
  void readFlat(Rgbe pixel, std::vector<Rgbe>& row) {
    int shift = 0;
    for (std::size_t x = 0;;) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        const std::size_t count = shift < 24 ? static_cast<std::size_t>(pixel[3]) << shift : row.size() + 1;
        if (x == 0 || count > row.size() - x) refuse("has a run past the end of its row; the file is damaged");
        for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
        shift += 8;
      } else {
        row[x++] = pixel;
        shift = 0;
      }
      if (x == row.size()) return;
      pixel = {nextByte(), nextByte(), nextByte(), nextByte()};
    }
  }

  static Vec3 toLinear(const Rgbe& pixel) {
    if (pixel[3] == 0) return Vec3(0.0f);
    const float unit = std::ldexp(1.0f, pixel[3] - (128 + 8));
    return unit * Vec3(pixel[0], pixel[1], pixel[2]);
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

bool isHdr(std::span<const std::byte> encoded) {
  const std::string_view text = asText(encoded);
  return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

ImageRgb decodeHdr(std::span<const std::byte> encoded, const std::string& name, std::uint64_t maxBytes) {
  return HdrReader(encoded, name).read(maxBytes);
}

}  // namespace cellcut
