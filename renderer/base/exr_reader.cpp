// decodeExr of image_codecs.h.
//
// The library trusts a file more than we may: it allocates what an attribute, a window, a tile or a list of channels
// asks for. So the attributes' sizes are checked before it sees the file, and the rest of the header before it is asked
// for pixels.
#include "renderer/base/error.h"
#include "renderer/base/exr_header_check.h"
#include "renderer/base/image_codecs.h"

#include <algorithm>
#include <new>

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescription.h>

namespace cellcut {

namespace {

constexpr std::uint32_t kMagic = 20000630;

std::uint32_t littleEndian32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::span<const std::byte> bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char c[], int n) override {
    if (n < 0 || at_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - at_) {
      throw Iex::InputExc("unexpected end of file");
    }
    std::copy_n(asText(bytes_).data() + at_, n, c);
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_ = 0;
};

/// What the library says is wrong, without the file's name, which it likes to repeat, and in one printable line.
std::string reason(const std::exception& problem) {
  const std::string_view text = problem.what();
  const std::size_t quoted = text.find("\". ");
  std::string line(quoted == std::string_view::npos ? text : text.substr(quoted + 3));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return line;
}

struct Window {
  std::int64_t x = 0, y = 0, width = 0, height = 0;
};

Window toWindow(const Imath::Box2i& box) {
  const std::int64_t x = box.min.x, y = box.min.y;
  return {x, y, box.max.x - x + 1, box.max.y - y + 1};
}

/// At most so many bytes of pixels come out of one byte of file.
std::int64_t expansionLimit(Imf::Compression compression) {
  // A flat 8 × 8 block of DWA is 2 numbers of 2 bytes for 128, which deflate then packs up to 1032 to one.
  if (compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION) return 32 * 1032;
  // Deflate's 1032, once more 4/3 for what PXR24 drops; PIZ reaches about 400, RLE 64, B44A 11.
  return 1376;
}

std::int64_t bytesPerPixel(const Imf::ChannelList& channels) {
  std::int64_t bytes = 0;
  for (auto c = channels.begin(); c != channels.end(); ++c) bytes += c.channel().type == Imf::HALF ? 2 : 4;
  return bytes;
}

void checkTiles(const Imf::TileDescription& tiles, const Window& data, std::int64_t pixelBytes,
                const std::string& name) {
  // The library buffers one row of tiles. Tiles may be larger than a small picture, but not by any amount.
  constexpr std::int64_t kAlwaysAllowed = std::int64_t{1} << 26;
  const std::int64_t limit = std::max(kAlwaysAllowed, data.width * data.height * pixelBytes);
  const std::int64_t rowOfTiles = data.width + tiles.xSize;
  if (tiles.xSize == 0 || tiles.ySize == 0 ||
      rowOfTiles > limit / pixelBytes / static_cast<std::int64_t>(tiles.ySize)) {
    throw InputError(name, "its tiles are larger than the picture; the file is damaged");
  }
}

/// It costs the file nothing: a small crop of a large picture is legal, a speck in a void is damage.
void checkDisplayWindow(const Window& display, std::int64_t dataPixels, const std::string& name) {
  constexpr std::int64_t kAlwaysAllowed = std::int64_t{1} << 24;
  const std::int64_t limit = std::min(kMaxImagePixels, std::max(kAlwaysAllowed, 16 * dataPixels));
  if (display.width <= 0 || display.height <= 0 || display.width > limit / display.height) {
    throw InputError(name, "its display window of " + std::to_string(display.width) + " x " +
                               std::to_string(display.height) +
                               " pixels does not fit its data; save it again uncropped");
  }
}

/// Everything that the library's memory depends on.
void checkHeader(const Imf::Header& header, std::size_t fileBytes, std::uint64_t maxBytes, const std::string& name) {
  const Window data = toWindow(header.dataWindow());
  const std::int64_t pixelBytes = bytesPerPixel(header.channels());
  const std::int64_t limit = expansionLimit(header.compression());
  // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): findPart() has chosen a part that has channels.
  checkImageSize(data.width, data.height, fileBytes, std::max<std::int64_t>(1, limit / pixelBytes), name);
  const Window display = toWindow(header.displayWindow());
  checkDisplayWindow(display, data.width * data.height, name);
  for (const Window& window : {data, display}) checkDecodedBytes(window.width, window.height, maxBytes, name);
  if (header.hasTileDescription()) checkTiles(header.tileDescription(), data, pixelBytes, name);
}

bool hasFullChannel(const Imf::ChannelList& channels, const char* name) {
  const Imf::Channel* channel = channels.findChannel(name);
  return channel && channel->xSampling == 1 && channel->ySampling == 1;
}

bool isColor(const Imf::ChannelList& channels) {
  return hasFullChannel(channels, "R") && hasFullChannel(channels, "G") && hasFullChannel(channels, "B");
}

bool isGrey(const Imf::ChannelList& channels) {
  return hasFullChannel(channels, "Y") && !channels.findChannel("RY") && !channels.findChannel("BY");
}

int findPart(const Imf::MultiPartInputFile& file, const std::string& name) {
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (header.hasType() && Imf::isDeepData(header.type())) continue;
    if (isColor(header.channels()) || isGrey(header.channels())) return part;
  }
  throw InputError(name, "has no flat picture with channels R, G and B, or Y alone; save one without a layer's prefix");
}

/// Colors of the file's primaries as those of Rec. 709, linear. The white point is not adapted, as in pbrt.
void convertToRec709(const Imf::Header& header, ImageRgb& image) {
  const Imf::Chromaticities rec709;  // what a file without the attribute has
  if (!Imf::hasChromaticities(header) || Imf::chromaticities(header) == rec709) return;
  const Imath::M44f matrix = Imf::RGBtoXYZ(Imf::chromaticities(header), 1) * Imf::XYZtoRGB(rec709, 1);
  for (Vec3& pixel : image) {
    const Imath::V3f converted = Imath::V3f(pixel.x, pixel.y, pixel.z) * matrix;
    pixel = {converted.x, converted.y, converted.z};
  }
}

ImageRgb readWindow(Imf::MultiPartInputFile& file, int part, const Window& data) {
  ImageRgb image(static_cast<int>(data.width), static_cast<int>(data.height));
  const bool color = isColor(file.header(part).channels());
  constexpr std::size_t kPixel = sizeof(Vec3);
  const std::size_t row = kPixel * static_cast<std::size_t>(data.width);
  Imf::FrameBuffer frame;
  for (int c = 0; c < (color ? 3 : 1); ++c) {
    const char* channel = color ? (c == 0 ? "R" : c == 1 ? "G" : "B") : "Y";
    // Slices are addressed by the window's coordinates, so their base lies outside of the buffer: Imf::Slice::Make does
    // the sum.
    frame.insert(channel,
                 Imf::Slice::Make(Imf::FLOAT, &image.data()->x + c, file.header(part).dataWindow(), kPixel, row));
  }
  Imf::InputPart input(file, part);
  input.setFrameBuffer(frame);
  input.readPixels(static_cast<int>(data.y), static_cast<int>(data.y + data.height - 1));
  if (color) {
    convertToRec709(file.header(part), image);
  } else {
    for (Vec3& pixel : image) pixel = Vec3(pixel.x);
  }
  return image;
}

/// The display window of a picture that was stored as its data window.
ImageRgb placeInDisplay(ImageRgb stored, const Window& data, const Window& display) {
  if (data.x == display.x && data.y == display.y && data.width == display.width && data.height == display.height) {
    return stored;
  }
  ImageRgb image(static_cast<int>(display.width), static_cast<int>(display.height));
  const std::int64_t left = std::max(data.x, display.x);
  const std::int64_t right = std::min(data.x + data.width, display.x + display.width);
  const std::int64_t top = std::max(data.y, display.y);
  const std::int64_t bottom = std::min(data.y + data.height, display.y + display.height);
  for (std::int64_t y = top; y < bottom; ++y) {
    for (std::int64_t x = left; x < right; ++x) {
      image.at(static_cast<int>(x - display.x), static_cast<int>(y - display.y)) =
          stored.at(static_cast<int>(x - data.x), static_cast<int>(y - data.y));
    }
  }
  return image;
}

}  // namespace

bool isExr(std::span<const std::byte> encoded) {
  return encoded.size() >= 4 && littleEndian32(encoded, 0) == kMagic;
}

ImageRgb decodeExr(std::span<const std::byte> encoded, const std::string& name, std::uint64_t maxBytes) {
  checkExrAttributes(encoded, name);
  try {
    MemoryInput stream(encoded, name);
    Imf::MultiPartInputFile file(stream, 0);
    const int part = findPart(file, name);
    const Imf::Header& header = file.header(part);
    checkHeader(header, encoded.size(), maxBytes, name);
    const Window data = toWindow(header.dataWindow());
    return placeInDisplay(readWindow(file, part, data), data, toWindow(header.displayWindow()));
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {  // the library throws Iex::BaseExc and what the standard library throws
    throw InputError(name, "cannot be decoded (" + reason(problem) + "); save it again");
  }
}

}  // namespace cellcut
