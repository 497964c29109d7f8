#include "renderer/base/exr_header_check.h"

#include "renderer/base/error.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cellcut {

namespace {

constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kMaxEntries = std::size_t{1} << 14;  // renderers write hundreds

struct FixedSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr std::array kFixedSizes{
    FixedSize{"box2f", 16},         FixedSize{"box2i", 16},    FixedSize{"chromaticities", 32},
    FixedSize{"compression", 1},    FixedSize{"double", 8},    FixedSize{"envmap", 1},
    FixedSize{"deepImageState", 1}, FixedSize{"float", 4},     FixedSize{"int", 4},
    FixedSize{"keycode", 28},       FixedSize{"lineOrder", 1}, FixedSize{"m33d", 72},
    FixedSize{"m33f", 36},          FixedSize{"m44d", 128},    FixedSize{"m44f", 64},
    FixedSize{"rational", 8},       FixedSize{"tiledesc", 9},  FixedSize{"timecode", 8},
    FixedSize{"v2d", 16},           FixedSize{"v2f", 8},       FixedSize{"v2i", 8},
    FixedSize{"v3d", 24},           FixedSize{"v3f", 12},      FixedSize{"v3i", 12},
};

/// Reads on from the front; nothing when the bytes end before.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : rest_(bytes) {}

  bool atEnd() const { return rest_.empty(); }

  std::optional<std::span<const std::byte>> take(std::size_t count) {
    if (count > rest_.size()) return std::nullopt;
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::optional<std::uint32_t> takeInt() {
    const auto bytes = take(4);
    if (!bytes) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>((*bytes)[i]) << (8 * i);
    return value;
  }

  /// Up to the terminating zero, which is taken too.
  std::optional<std::string_view> takeString() {
    const std::string_view text(reinterpret_cast<const char*>(rest_.data()), rest_.size());
    const std::size_t end = text.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    rest_ = rest_.subspan(end + 1);
    return text.substr(0, end);
  }

 private:
  std::span<const std::byte> rest_;
};

/// Of a list; nothing if it is damaged.
std::optional<std::size_t> channelCount(Cursor value) {
  constexpr std::size_t kChannel = 16;  // type, linearity and padding, two samplings
  std::size_t count = 0;
  for (auto name = value.takeString(); name; name = value.takeString(), ++count) {
    if (name->empty()) return value.atEnd() ? std::optional(count) : std::nullopt;
    if (!value.take(kChannel)) return std::nullopt;
  }
  return std::nullopt;
}

bool isPreview(Cursor value, std::size_t size) {
  const auto width = value.takeInt();
  const auto height = value.takeInt();
  // The product of two 32-bit numbers fits, and that of a true preview is far from where its fourfold would not.
  return width && height && std::uint64_t{*width} * *height == (size - 8) / 4 && size % 4 == 0;
}

bool isStringVector(Cursor value) {
  while (!value.atEnd()) {
    const auto length = value.takeInt();
    if (!length || !value.take(*length)) return false;
  }
  return true;
}

/// Is the value as long as one of its type? Types that we do not know the library skips by their size.
bool hasItsTypesSize(std::string_view type, std::span<const std::byte> value) {
  for (const FixedSize& fixed : kFixedSizes) {
    if (fixed.type == type) return value.size() == fixed.bytes;
  }
  if (type == "chlist") return channelCount(Cursor(value)).has_value();
  if (type == "preview") return isPreview(Cursor(value), value.size());
  if (type == "stringvector") return isStringVector(Cursor(value));
  if (type == "floatvector") return value.size() % 4 == 0;
  return true;
}

/// False when something is amiss. \param entries  attributes and channels so far, of all headers
bool skipHeader(Cursor& file, std::size_t& entries) {
  for (auto name = file.takeString(); name && entries <= kMaxEntries; name = file.takeString()) {
    if (name->empty()) return true;
    const auto type = file.takeString();
    const auto size = file.takeInt();
    if (!type || !size) return false;
    const auto value = file.take(*size);
    if (!value || !hasItsTypesSize(*type, *value)) return false;
    entries += 1 + (*type == "chlist" ? channelCount(Cursor(*value)).value_or(0) : 0);
  }
  return false;
}

}  // namespace

void checkExrAttributes(std::span<const std::byte> encoded, const std::string& name) {
  Cursor file(encoded);
  file.takeInt();  // the magic number
  const auto version = file.takeInt();
  std::size_t entries = 0;
  bool valid = version && skipHeader(file, entries);
  if (valid && (*version & kMultiPartFlag) != 0) {
    for (Cursor next = file; valid && next.takeString() != std::string_view(); next = file) {
      valid = skipHeader(file, entries);
    }
  }
  if (entries > kMaxEntries) {
    throw InputError(name, "has more than " + std::to_string(kMaxEntries) +
                               " attributes and channels in its EXR headers; save fewer layers");
  }
  if (!valid)
    throw InputError(name, "an attribute of its EXR header is cut off or has a wrong size; the file is damaged");
}

}  // namespace cellcut
