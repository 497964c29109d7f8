#include "renderer/base/image_io.h"

#include "renderer/base/error.h"
#include "renderer/base/rng.h"
#include "renderer/base/tone_map.h"
#include "tests/support/bytes.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"
#include "tests/support/temporary_directory.h"

#include <algorithm>
#include <bit>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

ImageRgb noise(int width, int height) {
  Rng rng(7);
  ImageRgb image(width, height);
  for (Vec3& pixel : image) pixel = {rng.uniform(0, 10), rng.uniform(-1, 1), rng.uniform(0, 1e-30f)};
  return image;
}

void expectSame(const ImageRgb& a, const ImageRgb& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_EQ(std::bit_cast<std::uint32_t>(a[i][c]), std::bit_cast<std::uint32_t>(b[i][c]));
  }
}

LayeredImage oneLayer(const ImageRgb& image) {
  LayeredImage layered{image.width(), image.height(), {{"", {"R", "G", "B"}, {}}}, {}};
  for (const Vec3& p : image) layered.layers[0].values.insert(layered.layers[0].values.end(), {p.x, p.y, p.z});
  return layered;
}

std::string imageRefusal(std::span<const std::byte> encoded) {
  return refusalOf([&] { decodeImage(encoded, "picture"); });
}

std::string imageBytesRefusal(std::span<const std::byte> encoded) {
  return refusalOf([&] { decodeImage8(encoded, "picture"); });
}

TEST(ImageIo, PfmKeepsEveryBit) {
  const test::TemporaryDirectory folder;
  ImageRgb image = noise(5, 3);
  image.at(2, 1) = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -0.0f};
  writePfm(folder / "a.pfm", image);
  expectSame(readImage(folder / "a.pfm"), image);
}

TEST(ImageIo, ExrKeepsEveryBit) {
  const test::TemporaryDirectory folder;
  ImageRgb image = noise(37, 21);
  image.at(2, 1) = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -0.0f};
  writeExr(folder / "a.exr", oneLayer(image));
  expectSame(readImage(folder / "a.exr"), image);
}

TEST(ImageIo, PngHasToneMappedPixels) {
  const test::TemporaryDirectory folder;
  ImageRgb image(2, 2);
  image.at(1, 0) = {0.1f, 0.2f, 0.4f};
  image.at(0, 1) = {std::numeric_limits<float>::quiet_NaN(), 0.4f, -1};
  writePng(folder / "a.png", image, 2);
  const ImageRgba8 read = decodeImage8(readFile(folder / "a.png", 1 << 20), "a.png");
  ASSERT_EQ(read.width(), 2);
  ASSERT_EQ(read.height(), 2);
  const Vec3 shown = toneMap({0.2f, 0.4f, 0.8f});
  const auto rounded = [](float c) { return static_cast<int>(std::lround(255 * c)); };
  EXPECT_EQ(glm::ivec4(read.at(1, 0)), glm::ivec4(rounded(shown.x), rounded(shown.y), rounded(shown.z), 255));
  EXPECT_EQ(glm::ivec4(read.at(0, 1)), glm::ivec4(0, rounded(shown.z), 0, 255));
  EXPECT_EQ(glm::ivec4(read.at(0, 0)), glm::ivec4(0, 0, 0, 255));
}

TEST(ImageIo, Png8KeepsColorAndAlpha) {
  ImageRgba8 image(7, 5);
  Rng rng(3);
  for (auto& pixel : image) {
    for (int c = 0; c < 4; ++c) pixel[c] = static_cast<std::uint8_t>(rng.below(256));
  }
  const ImageRgba8 read = decodeImage8(encodePng(image), "noise");
  ASSERT_EQ(read.size(), image.size());
  for (std::size_t i = 0; i < image.size(); ++i) EXPECT_EQ(glm::ivec4(read[i]), glm::ivec4(image[i])) << i;
}

TEST(ImageIo, RefusesWhatIsNoPicture) {
  EXPECT_THAT(imageRefusal(bytesOf("")), HasSubstr("picture: is no"));
  EXPECT_THAT(imageRefusal(bytesOf("lamp")), HasSubstr("is no OpenEXR"));
  EXPECT_THROW(decodeImage8(bytesOf("lamp"), "texture"), InputError);
  EXPECT_THROW(decodeImage8({}, "texture"), InputError);
}

TEST(ImageIo, Png8CutOffAnywhereIsRefused) {
  const std::vector<std::byte> whole = encodePng(ImageRgba8(16, 16, {1, 2, 3, 4}));
  constexpr std::size_t kEndChunk = 12;  // nothing is missing when only the end mark is
  for (std::size_t size = 0; size < whole.size() - kEndChunk; ++size) {
    EXPECT_THROW(decodeImage8(std::span(whole).first(size), "cut"), InputError) << size;
  }
}

TEST(ImageIo, RandomlyDamagedPng8IsReadOrRefused) {
  ImageRgba8 image(24, 24);
  Rng rng(11);
  for (auto& pixel : image) pixel = {rng.below(256), rng.below(3), 7, 255};
  const std::vector<std::byte> whole = encodePng(image);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> png = whole;
    png[rng.below(static_cast<std::uint32_t>(png.size()))] = static_cast<std::byte>(rng.below(256));
    try {
      decodeImage8(png, "damaged");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);  // else the damage missed everything that matters
}

TEST(ImageIo, Png8RefusesSizeThatItsBytesCannotHoldBeforeAllocating) {
  std::vector<std::byte> png = encodePng(ImageRgba8(16, 16));
  png[17] = std::byte{0x10};  // width 0x00100010
  png[21] = std::byte{0x01};
  const test::AddressSpaceLimit limit(test::kPlentyForRefusal);
  EXPECT_THAT(imageBytesRefusal(png), HasSubstr("picture: has no valid header"));  // for stb
  png[17] = png[21] = std::byte{0};
  png[18] = png[22] = std::byte{0x3f};
  EXPECT_THAT(imageBytesRefusal(png), HasSubstr("picture: 16144 x 16144 pixels cannot be in a file of"));
}

TEST(ImageIo, Png8RefusesChunkPastTheFileBeforeAllocating) {
  std::vector<std::byte> png = encodePng(ImageRgba8(16, 16));
  png[33] = std::byte{0x40};  // length of the first chunk after the header: 1 GB
  const test::AddressSpaceLimit limit(test::kPlentyForRefusal);
  EXPECT_THAT(imageBytesRefusal(png), HasSubstr("picture: a PNG chunk reaches past the end of the file; copy"));
  constexpr std::size_t kFirstChunk = 33;
  for (std::size_t header = 8; header < 12; ++header) {  // nothing of it is there but its header
    EXPECT_THAT(imageBytesRefusal(std::span(png).first(kFirstChunk + header)), HasSubstr("a PNG chunk reaches past"));
  }
}

/// A PNG of one pixel with other data in place of its own.
std::vector<std::byte> pngOf(const std::vector<std::byte>& data) {
  std::vector<std::byte> png = encodePng(ImageRgba8(1, 1));
  constexpr std::ptrdiff_t kDataChunk = 33, kEndChunk = 12;
  png.erase(png.begin() + kDataChunk + 8, png.end() - kEndChunk - 4);
  png.insert(png.begin() + kDataChunk + 8, data.begin(), data.end());
  for (std::size_t i = 0; i < 4; ++i) png[kDataChunk + i] = static_cast<std::byte>(data.size() >> (24 - 8 * i));
  return png;
}

/// Deflate's shortest for so many zeros with the codes that every reader knows. Source: RFC 1951, section 3.2.6.
std::vector<std::byte> packedZeros(std::size_t count) {
  std::vector<std::byte> data{std::byte{0x78}, std::byte{0x01}};
  unsigned bits = 0, used = 0;
  const auto put = [&](std::string_view code) {
    for (const char bit : code) {
      bits |= static_cast<unsigned>(bit - '0') << used;
      if (++used < 8) continue;
      data.push_back(static_cast<std::byte>(bits));
      bits = used = 0;
    }
  };
  put("110");                                                         // the last block, fixed codes
  put("00110000");                                                    // a zero
  for (std::size_t i = 1; i < count; i += 258) put("1100010100000");  // 258 times the byte before
  put("0000000");                                                     // the end
  put("0000000");
  data.insert(data.end(), 4, std::byte{0});  // a checksum, which nobody reads
  return data;
}

TEST(ImageIo, RefusesPngsWhoseDataUnpackToMoreThanTheirPixels) {
  EXPECT_EQ(decodeImage8(pngOf(packedZeros(5)), "one").width(), 1);
  const std::vector<std::byte> bomb = pngOf(packedZeros(700'000'000));
  const test::HostileBudget budget("bomb");
  EXPECT_EQ(imageBytesRefusal(bomb),
            "picture: its data are damaged or unpack to more than 1 x 1 pixels; save it again");
}

TEST(ImageIo, ReadsPngsThatPackBadly) {
  // Long enough to be unpacked before.
  ImageRgba8 image(300, 200);
  Rng rng(4);
  for (auto& pixel : image) {
    for (int c = 0; c < 4; ++c) pixel[c] = static_cast<std::uint8_t>(rng.below(256));
  }
  const std::vector<std::byte> png = encodePng(image);
  ASSERT_GT(png.size(), std::size_t{200'000});
  EXPECT_EQ(decodeImage8(png, "noise").at(299, 199), image.at(299, 199));
}

TEST(ImageIo, Png8IgnoresWhatFollowsItsLastChunk) {
  std::vector<std::byte> png = encodePng(ImageRgba8(16, 16));
  png.resize(png.size() + 100, std::byte{0x7f});
  EXPECT_EQ(decodeImage8(png, "followed").width(), 16);
}

TEST(Pfm, ReadsBothByteOrdersFromTheBottomRow) {
  // Two grey pixels above each other, 1 at the bottom and 2 at the top.
  const auto little = bytesOf(std::string_view("Pf\n1 2\n-1\n\0\0\x80\x3f\0\0\0\x40", 18));
  const auto big = bytesOf(std::string_view("Pf\n1 2\n1\n\x3f\x80\0\0\x40\0\0\0", 17));
  for (const auto& encoded : {little, big}) {
    const ImageRgb image = decodeImage(encoded, "grey");
    ASSERT_EQ(image.height(), 2);
    EXPECT_EQ(image.at(0, 0), Vec3(2.0f));
    EXPECT_EQ(image.at(0, 1), Vec3(1.0f));
  }
}

TEST(Pfm, ScaleMultiplies) {
  const ImageRgb image = decodeImage(bytesOf(std::string_view("Pf 1 1 -2.5 \0\0\x80\x3f", 16)), "scaled");
  EXPECT_EQ(image.at(0, 0), Vec3(2.5f));
}

TEST(Pfm, RefusesHeadersBeforeAllocating) {
  const test::AddressSpaceLimit limit(test::kPlentyForRefusal);
  EXPECT_THAT(imageRefusal(bytesOf("PF\n16384 16384\n-1\n")), HasSubstr("cannot be in a file of 18 bytes"));
  EXPECT_THAT(imageRefusal(bytesOf("PF\n16384 16385\n-1\n")), HasSubstr("more than the limit"));
}

TEST(ImageIo, RefusesPicturesPastALimitOfDecodedBytes) {
  const test::TemporaryDirectory folder;
  const ImageRgb image(32, 16);
  writePfm(folder / "a.pfm", image);
  writeExr(folder / "a.exr", oneLayer(image));
  std::string hdr = "#?RADIANCE\n\n-Y 16 +X 32\n" + std::string(32 * 16 * 4, '\0');
  test::writeFile(folder / "a.hdr", hdr);
  for (const char* name : {"a.pfm", "a.exr", "a.hdr"}) {
    EXPECT_EQ(readImage(folder / name, 32 * 16 * 12).width(), 32) << name;
    try {
      readImage(folder / name, 32 * 16 * 12 - 1);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(name) + ": 32 x 16 pixels have 6144 bytes decoded"));
      EXPECT_THAT(error.what(), HasSubstr("--max-texture-bytes"));
    }
  }
}

TEST(Pfm, RefusesBadHeaders) {
  for (const char* text :
       {"PF", "PF\n", "PF\n1", "PF\n1 1\n", "PF\n1 1\n-1", "PF\n-1 1\n-1\n", "PF\n0 1\n-1\n", "PF\nx 1\n-1\n",
        "PF\n1 1\n0\n", "PF\n1 1\nnan\n", "PF\n1 1\n-1\n123456789ab", "PF\n99999999999999999999 1\n-1\n",
        "PF\n9223372036854775807 9223372036854775807\n-1\n", "PF\n16384 16385\n-1\n"}) {
    EXPECT_THAT(imageRefusal(bytesOf(text)), HasSubstr("picture: ")) << text;
  }
}

}  // namespace
}  // namespace cellcut::test
