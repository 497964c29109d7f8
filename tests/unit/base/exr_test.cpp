#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"
#include "renderer/base/rng.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"

#include <bit>
#include <cstring>
#include <filesystem>
#include <list>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

std::vector<std::byte> bytesIn(const Imf::StdOSStream& stream) {
  const std::string text = stream.str();
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Value of a channel at a pixel of the data window; small integers, exact in half.
float pattern(int channel, int x, int y) {
  return static_cast<float>(100 * channel + 10 * (y % 10) + x % 10);
}

/// A frame of one pattern per channel, in float, that covers `window`.
class FramedChannels {
 public:
  FramedChannels(const Imath::Box2i& window, std::initializer_list<const char*> channels) : window_(window) {
    int index = 0;
    for (const char* name : channels) insert(name, ++index);
  }
  const Imf::FrameBuffer& buffer() const { return buffer_; }

 private:
  void insert(const char* name, int index) {
    const int width = window_.max.x - window_.min.x + 1;
    auto& values = values_.emplace_back();
    for (int y = window_.min.y; y <= window_.max.y; ++y) {
      for (int x = window_.min.x; x <= window_.max.x; ++x) values.push_back(pattern(index, x, y));
    }
    buffer_.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), window_, sizeof(float),
                                          sizeof(float) * static_cast<std::size_t>(width)));
  }
  Imath::Box2i window_;
  std::list<std::vector<float>> values_;
  Imf::FrameBuffer buffer_;
};

void addChannels(Imf::Header& header, std::initializer_list<const char*> channels, Imf::PixelType type = Imf::FLOAT) {
  for (const char* name : channels) header.channels().insert(name, Imf::Channel(type));
}

std::vector<std::byte> scanLines(const Imf::Header& header, std::initializer_list<const char*> channels) {
  Imf::StdOSStream stream;
  {
    const FramedChannels frame(header.dataWindow(), channels);
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame.buffer());
    const Imath::Box2i& window = header.dataWindow();
    file.writePixels(window.max.y - window.min.y + 1);
  }
  return bytesIn(stream);
}

void expectPattern(const ImageRgb& image) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      ASSERT_EQ(image.at(x, y), Vec3(pattern(1, x, y), pattern(2, x, y), pattern(3, x, y))) << x << " " << y;
    }
  }
}

std::string exrRefusal(std::span<const std::byte> encoded) {
  return refusalOf([&] { decodeExr(encoded, "picture"); });
}

TEST(ExrReader, ReadsEveryCompression) {
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    const auto compression = static_cast<Imf::Compression>(c);
    if (compression == Imf::B44_COMPRESSION || compression == Imf::B44A_COMPRESSION) continue;  // below
    if (compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION) continue;
    Imf::Header header(33, 17);
    header.compression() = compression;
    addChannels(header, {"R", "G", "B"});
    expectPattern(decodeExr(scanLines(header, {"R", "G", "B"}), "compressed"));
  }
}

TEST(ExrReader, ConvertsOtherPrimariesToRec709) {
  Imf::Header header(2, 2);
  addChannels(header, {"R", "G", "B"});
  const Imf::Chromaticities rec2020({0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f});
  Imf::addChromaticities(header, rec2020);
  const Vec3 color = decodeExr(scanLines(header, {"R", "G", "B"}), "wide").at(0, 0);
  const Vec3 stored(pattern(1, 0, 0), pattern(2, 0, 0), pattern(3, 0, 0));
  // ITU-R BT.2407-0, the matrix of section 2. Half a unit of its four digits times what is stored is 0.03.
  EXPECT_NEAR(color.x, glm::dot(Vec3(1.6605f, -0.5876f, -0.0728f), stored), 0.03f);
  EXPECT_NEAR(color.y, glm::dot(Vec3(-0.1246f, 1.1329f, -0.0083f), stored), 0.03f);
  EXPECT_NEAR(color.z, glm::dot(Vec3(-0.0182f, -0.1006f, 1.1187f), stored), 0.03f);
}

TEST(ExrReader, RefusesPrimariesThatAreNone) {
  Imf::Header header(2, 2);
  addChannels(header, {"R", "G", "B"});
  Imf::addChromaticities(header, Imf::Chromaticities({0, 0}, {0, 0}, {0, 0}, {0, 0}));
  EXPECT_THAT(exrRefusal(scanLines(header, {"R", "G", "B"})), HasSubstr("picture"));
}

TEST(ExrReader, ReadsLossyCompressions) {
  for (const auto compression :
       {Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    Imf::Header header(33, 17);
    header.compression() = compression;
    addChannels(header, {"R", "G", "B"}, Imf::FLOAT);
    const ImageRgb image = decodeExr(scanLines(header, {"R", "G", "B"}), "compressed");
    EXPECT_NEAR(image.at(5, 5).y, pattern(2, 5, 5), 10) << "compression " << compression;  // its neighbours' spread
  }
}

TEST(ExrReader, ReadsPixelTypes) {
  // HALF slices would need half values to write from; UINT is what the library converts on reading just the same.
  Imf::Header header(9, 9);
  addChannels(header, {"R", "G", "B"}, Imf::UINT);
  Imf::StdOSStream stream;
  std::vector<std::uint32_t> values(81, 4000000000u);
  {
    Imf::OutputFile file(stream, header, 0);
    Imf::FrameBuffer frame;
    for (const char* name : {"R", "G", "B"}) {
      frame.insert(name, Imf::Slice::Make(Imf::UINT, values.data(), header.dataWindow(), 4, 36));
    }
    file.setFrameBuffer(frame);
    file.writePixels(9);
  }
  EXPECT_EQ(decodeExr(bytesIn(stream), "uint").at(8, 8), Vec3(4e9f));
}

TEST(ExrReader, ReadsTiles) {
  Imf::Header header(50, 30);
  header.setTileDescription(Imf::TileDescription(16, 8, Imf::MIPMAP_LEVELS));
  addChannels(header, {"R", "G", "B"});
  Imf::StdOSStream stream;
  {
    const FramedChannels frame(header.dataWindow(), {"R", "G", "B"});
    Imf::TiledOutputFile file(stream, header, 0);
    file.setFrameBuffer(frame.buffer());
    for (int level = 0; level < file.numLevels(); ++level) {
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  const ImageRgb image = decodeExr(bytesIn(stream), "tiles");
  ASSERT_EQ(image.width(), 50);
  ASSERT_EQ(image.height(), 30);
  expectPattern(image);
}

TEST(ExrReader, LuminanceBecomesGrey) {
  Imf::Header header(3, 2);
  addChannels(header, {"Y"});
  EXPECT_EQ(decodeExr(scanLines(header, {"Y"}), "grey").at(2, 1), Vec3(pattern(1, 2, 1)));
}

TEST(ExrReader, IgnoresOtherLayers) {
  Imf::Header header(4, 4);
  addChannels(header, {"R", "G", "B", "A", "albedo.R", "normal.X", "Z"});
  expectPattern(decodeExr(scanLines(header, {"R", "G", "B", "A", "albedo.R", "normal.X", "Z"}), "layers"));
}

TEST(ExrReader, PictureIsTheDisplayWindow) {
  Imf::Header header(Imath::Box2i({-2, -3}, {7, 6}), Imath::Box2i({-4, 2}, {3, 20}));
  addChannels(header, {"R", "G", "B"});
  const ImageRgb image = decodeExr(scanLines(header, {"R", "G", "B"}), "crop");
  ASSERT_EQ(image.width(), 10);
  ASSERT_EQ(image.height(), 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      const bool stored = x - 2 <= 3 && y - 3 >= 2;
      EXPECT_EQ(image.at(x, y).x, stored ? pattern(1, x - 2, y - 3) : 0) << x << " " << y;
    }
  }
}

/// Depth without colour, a picture, and luminance, 5 × 4 pixels each.
std::vector<std::byte> threeParts() {
  std::vector<Imf::Header> headers(3, Imf::Header(5, 4));
  const char* names[] = {"depth", "beauty", "later"};
  for (std::size_t i = 0; i < 3; ++i) {
    headers[i].setName(names[i]);
    headers[i].setType(Imf::SCANLINEIMAGE);
  }
  addChannels(headers[0], {"Z"});
  addChannels(headers[1], {"R", "G", "B"});
  addChannels(headers[2], {"Y"});
  Imf::StdOSStream stream;
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), 3, false, 0);
    const FramedChannels depth(headers[0].dataWindow(), {"Z"}), beauty(headers[1].dataWindow(), {"R", "G", "B"}),
        later(headers[2].dataWindow(), {"Y"});
    const FramedChannels* frames[] = {&depth, &beauty, &later};
    for (int i = 0; i < 3; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(frames[i]->buffer());
      part.writePixels(4);
    }
  }
  return bytesIn(stream);
}

TEST(ExrReader, ReadsTheFirstPartThatHasColor) {
  expectPattern(decodeExr(threeParts(), "parts"));
}

TEST(ExrReader, RefusesPicturesWithoutColor) {
  Imf::Header prefixed(2, 2), chroma(2, 2), partial(2, 2);
  addChannels(prefixed, {"diffuse.R", "diffuse.G", "diffuse.B"});
  addChannels(chroma, {"Y", "RY", "BY"});
  addChannels(partial, {"R", "G"});
  EXPECT_THAT(exrRefusal(scanLines(prefixed, {"diffuse.R", "diffuse.G", "diffuse.B"})), HasSubstr("prefix"));
  EXPECT_THAT(exrRefusal(scanLines(chroma, {"Y", "RY", "BY"})), HasSubstr("R, G and B"));
  EXPECT_THAT(exrRefusal(scanLines(partial, {"R", "G"})), HasSubstr("R, G and B"));
}

TEST(ExrReader, ReadsPlainPicturesHoweverWellTheyCompress) {
  // The check against giants must not refuse a picture of one colour, which packs best of all.
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    Imf::Header header(2048, 512);
    header.compression() = static_cast<Imf::Compression>(c);
    addChannels(header, {"R", "G", "B"}, Imf::HALF);
    Imf::StdOSStream stream;
    std::vector<std::uint16_t> blackRow(2048);
    {
      Imf::FrameBuffer frame;
      for (const char* name : {"R", "G", "B"}) {  // all rows are the same one
        frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(blackRow.data()), 2, 0));
      }
      Imf::OutputFile file(stream, header, 0);
      file.setFrameBuffer(frame);
      file.writePixels(512);
    }
    EXPECT_EQ(exrRefusal(bytesIn(stream)), "was not refused") << "compression " << c;
  }
}

/// A small valid file, to be damaged.
std::vector<std::byte> smallFile() {
  Imf::Header header(8, 8);
  header.compression() = Imf::NO_COMPRESSION;
  addChannels(header, {"R", "G", "B"});
  return scanLines(header, {"R", "G", "B"});
}

std::size_t find(const std::vector<std::byte>& file, std::string_view text, std::size_t from = 0) {
  const std::size_t at = asText(file).find(text, from);
  EXPECT_NE(at, std::string_view::npos);
  return at;
}

/// Where the value of an attribute begins, past its name, its type and its size.
std::size_t valueOf(const std::vector<std::byte>& file, const std::string& name, const std::string& type,
                    std::size_t from = 0) {
  const std::string head = name + '\0' + type + '\0';
  return find(file, head, from) + head.size() + 4;
}

void put32(std::vector<std::byte>& file, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::byte>(value >> (8 * i));
}

TEST(ExrReader, RefusesAttributeLargerThanTheFile) {
  std::vector<std::byte> file = smallFile();
  put32(file, valueOf(file, "screenWindowWidth", "float") - 4, 0x7fffffff);
  EXPECT_THAT(exrRefusal(file), HasSubstr("attribute"));
}

TEST(ExrReader, RefusesAttributeOfAnotherSizeThanItsType) {
  // The library would take the next attribute from the middle of this one, and its size from anywhere.
  std::vector<std::byte> file = smallFile();
  const std::size_t size = find(file, "channels") + 9 + 7;  // past the name and "chlist", each with its end
  std::vector<std::byte> longer = file, shorter = file;
  longer[size] = static_cast<std::byte>(std::to_integer<int>(file[size]) + 4);
  shorter[size] = static_cast<std::byte>(std::to_integer<int>(file[size]) - 4);
  EXPECT_THAT(exrRefusal(longer), HasSubstr("attribute"));
  EXPECT_THAT(exrRefusal(shorter), HasSubstr("attribute"));
  file[find(file, "screenWindowWidth") + 17 + 1 + 6] = std::byte{5};  // a float of five bytes
  EXPECT_THAT(exrRefusal(file), HasSubstr("attribute"));
}

TEST(ExrReader, RefusesWindowsThatTheFileCannotHold) {
  const struct {
    const char* name;
    std::size_t axis;
    const char* refusal;  ///< of 2²⁴ pixels on that axis
  } windows[] = {{"dataWindow", 0, "16777216 x 8"},
                 {"dataWindow", 1, "unexpected end of file"},  // inside the table of its rows, which comes first
                 {"displayWindow", 0, "16777216 x 8"},
                 {"displayWindow", 1, "8 x 16777216"}};
  for (const auto& [name, axis, refusal] : windows) {
    const std::string what = std::string(name) + (axis == 0 ? " in x" : " in y");
    const test::HostileBudget budget(what);
    std::vector<std::byte> file = smallFile();
    const std::size_t lower = valueOf(file, name, "box2i") + 4 * axis, upper = lower + 8;
    put32(file, upper, (1 << 24) - 1);
    EXPECT_THAT(exrRefusal(file), HasSubstr(refusal)) << what;
    for (const std::uint32_t end : {0x7ffffffeu, 0xffffffffu}) {  // 2³¹ − 1 pixels, none
      put32(file, upper, end);
      EXPECT_NE(exrRefusal(file), "was not refused") << what;
    }
    put32(file, lower, 0x80000000);
    put32(file, upper, 0x7fffffff);
    EXPECT_NE(exrRefusal(file), "was not refused") << what;
  }
}

TEST(ExrReader, RefusesAMillionChannels) {
  std::string list;
  for (int i = 0; i < 1'000'000; ++i) {
    // FLOAT, its linearity and padding, every pixel in x and in y.
    list += std::string("c") + std::to_string(i) + std::string("\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 17);
  }
  list += '\0';
  std::vector<std::byte> file = smallFile();
  const std::size_t old = valueOf(file, "channels", "chlist");
  const std::size_t end = find(file, "compression") - 1;  // of the list that is there
  put32(file, old - 4, static_cast<std::uint32_t>(list.size()));
  const auto bytes = std::as_bytes(std::span(list));
  file.erase(file.begin() + static_cast<std::ptrdiff_t>(old), file.begin() + static_cast<std::ptrdiff_t>(end + 1));
  file.insert(file.begin() + static_cast<std::ptrdiff_t>(old), bytes.begin(), bytes.end());
  const test::HostileBudget budget("channels");
  EXPECT_THAT(exrRefusal(file), HasSubstr("picture: has more than 16384 attributes and channels"));
}

TEST(ExrReader, RefusesAMillionAttributes) {
  std::string attributes;
  for (int i = 0; i < 1'000'000; ++i) {
    attributes += std::string("a") + std::to_string(i) + std::string("\0int\0\4\0\0\0\7\0\0\0", 13);
  }
  std::vector<std::byte> file = smallFile();
  const auto bytes = std::as_bytes(std::span(attributes));
  file.insert(file.begin() + 8, bytes.begin(), bytes.end());
  const test::HostileBudget budget("attributes");
  EXPECT_THAT(exrRefusal(file), HasSubstr("picture: has more than 16384 attributes and channels"));
}

TEST(ExrReader, RefusesAHundredThousandParts) {
  std::vector<std::byte> file = threeParts();
  const std::size_t second = find(file, "channels", find(file, "channels") + 1);
  const std::vector<std::byte> header(file.begin() + 8, file.begin() + static_cast<std::ptrdiff_t>(second));
  std::vector<std::byte> headers;
  for (int i = 0; i < 100'000; ++i) headers.insert(headers.end(), header.begin(), header.end());
  file.insert(file.begin() + 8, headers.begin(), headers.end());
  const test::HostileBudget budget("parts");
  EXPECT_THAT(exrRefusal(file), HasSubstr("picture: has more than 16384 attributes and channels"));
}

TEST(ExrReader, ChecksTheHeaderOfEveryPart) {
  const std::vector<std::byte> whole = threeParts();
  std::size_t from = 0;
  for (const char* part : {"first", "second", "third"}) {
    const test::HostileBudget budget(part);
    std::vector<std::byte> file = whole;
    const std::size_t window = valueOf(file, "dataWindow", "box2i", from);
    put32(file, window - 4, 0x7fffffff);
    EXPECT_THAT(exrRefusal(file), HasSubstr("attribute")) << part;
    file = whole;
    put32(file, window + 8, (1 << 24) - 1);
    put32(file, window + 12, (1 << 24) - 1);
    EXPECT_NE(exrRefusal(file), "was not refused") << part;
    from = window;
  }
  EXPECT_EQ(asText(whole).find("dataWindow", from), std::string_view::npos) << "there is a fourth";
}

TEST(ExrReader, ADamagedSecondHeaderIsReadOrRefused) {
  const std::vector<std::byte> whole = threeParts();
  const std::size_t begin = find(whole, "channels", find(whole, "channels") + 1);
  const std::size_t end = find(whole, "channels", begin + 1);
  Rng rng(5);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const test::HostileBudget budget(std::to_string(i));
    std::vector<std::byte> file = whole;
    file[begin + rng.below(static_cast<std::uint32_t>(end - begin))] = static_cast<std::byte>(rng.below(256));
    refused += exrRefusal(file) != "was not refused";
  }
  EXPECT_GT(refused, 500);  // else the damage missed everything that matters
}

TEST(ExrReader, NumbersThatAreNoneDoNotReachThePixels) {
  const struct {
    const char* name;
    const char* type;
  } attributes[] = {{"pixelAspectRatio", "float"}, {"screenWindowWidth", "float"}, {"screenWindowCenter", "v2f"}};
  for (const auto& [name, type] : attributes) {
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, -1.0f, 0.0f, 1e-45f}) {
      std::vector<std::byte> file = smallFile();
      put32(file, valueOf(file, name, type), std::bit_cast<std::uint32_t>(value));
      const std::string message = exrRefusal(file);
      if (message == "was not refused") {
        expectPattern(decodeExr(file, name));
      } else {
        EXPECT_THAT(message, testing::MatchesRegex("picture: cannot be decoded \\(.*\\); save it again"));
      }
    }
  }
}

TEST(ExrReader, RefusesTilesFarLargerThanThePicture) {
  Imf::Header header(8, 8);
  header.setTileDescription(Imf::TileDescription(16, 8));
  addChannels(header, {"R", "G", "B"});
  Imf::StdOSStream stream;
  {
    const FramedChannels frame(header.dataWindow(), {"R", "G", "B"});
    Imf::TiledOutputFile output(stream, header, 0);
    output.setFrameBuffer(frame.buffer());
    output.writeTile(0, 0);
  }
  std::vector<std::byte> file = bytesIn(stream);
  const std::size_t at = find(file, "tiledesc") + 9 + 4;
  ASSERT_EQ(exrRefusal(file), "was not refused");
  put32(file, at, 1 << 14);
  put32(file, at + 4, 1 << 14);
  EXPECT_THAT(exrRefusal(file), HasSubstr("tiles"));
}

TEST(ExrReader, FileCutOffAnywhereIsRefused) {
  const std::vector<std::byte> whole = smallFile();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(decodeExr(std::span(whole).first(size), "cut"), InputError) << size;
  }
}

TEST(ExrReader, RandomlyDamagedFilesAreReadOrRefused) {
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
                                 Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    Imf::Header header(40, 24);
    header.compression() = compression;
    addChannels(header, {"R", "G", "B"}, Imf::FLOAT);
    const std::vector<std::byte> whole = scanLines(header, {"R", "G", "B"});
    Rng rng(static_cast<std::uint64_t>(compression));
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
      const test::HostileBudget budget("compression " + std::to_string(compression) + ", file " + std::to_string(i));
      std::vector<std::byte> file = whole;
      for (std::uint32_t k = 0; k <= rng.below(4); ++k) {
        file[rng.below(static_cast<std::uint32_t>(file.size()))] = static_cast<std::byte>(rng.below(256));
      }
      refused += exrRefusal(file) != "was not refused";
    }
    EXPECT_GT(refused, 0) << "compression " << compression;  // else the damage missed everything that matters
  }
}

TEST(ExrReader, MessagesAreOneLine) {
  std::vector<std::byte> file = smallFile();
  file[find(file, "lineOrder") + 10] = std::byte{'\n'};  // of its type, which the library's message quotes
  const std::string message = exrRefusal(file);
  EXPECT_NE(message, "was not refused");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(ExrWriter, NamesLayersAndKeepsMetadata) {
  LayeredImage image{2, 1, {}, {{"strategy", "power"}, {"spp", "16"}}};
  image.layers.push_back({"", {"R", "G", "B"}, {1, 2, 3, 4, 5, 6}});
  image.layers.push_back({"normal", {"X", "Y", "Z"}, {7, 8, 9, 10, 11, 12}});
  image.layers.push_back({"depth", {"Z"}, {13, 14}});
  const std::vector<std::byte> encoded = encodeExr(image);
  Imf::StdISStream stream;
  stream.str(std::string(asText(encoded)));
  Imf::InputFile file(stream, 0);
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("strategy").value(), "power");
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("spp").value(), "16");
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);

  const std::map<std::string, std::array<float, 2>> expected{
      {"R", {1, 4}},         {"G", {2, 5}},         {"B", {3, 6}},        {"normal.X", {7, 10}},
      {"normal.Y", {8, 11}}, {"normal.Z", {9, 12}}, {"depth.Z", {13, 14}}};
  std::map<std::string, std::array<float, 2>> read;
  Imf::FrameBuffer frame;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
    EXPECT_EQ(c.channel().type, Imf::FLOAT);
    frame.insert(c.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read[c.name()].data()), 4, 8));
  }
  file.setFrameBuffer(frame);
  file.readPixels(0);
  EXPECT_EQ(read, expected);
}

class ExrCorpus : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(CELLCUT_CORPUS)) GTEST_SKIP() << "no corpus beside this checkout";
  }
};

TEST_F(ExrCorpus, DamagedFilesAreReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CELLCUT_CORPUS "/exr-damaged")) {
    const test::HostileBudget budget(entry.path().filename());
    try {
      readImage(entry.path());
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(entry.path().string()));
    }
    ++files;
  }
  EXPECT_GT(files, 80u);
}

TEST_F(ExrCorpus, EnvironmentsHaveLight) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CELLCUT_CORPUS "/environments")) {
    const ImageRgb image = readImage(entry.path());
    EXPECT_EQ(image.width(), 512);
    EXPECT_EQ(image.height(), 256);
    glm::dvec3 sum(0.0);
    for (const Vec3& pixel : image) sum += glm::dvec3(pixel);
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(sum[c])) << entry.path();
      EXPECT_GT(sum[c], 0) << entry.path();
    }
    ++files;
  }
  EXPECT_EQ(files, 6u);
}

}  // namespace
}  // namespace cellcut::test
