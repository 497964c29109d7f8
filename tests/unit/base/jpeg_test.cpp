#include "renderer/base/image_io.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::Each;
using testing::HasSubstr;
using Texel = ImageRgba8::value_type;

// The parts of JPEGs of 8 × 8 pixels. Source: ITU-T T.81, appendix B.
using Bytes = std::vector<int>;
constexpr int kBaseline = 0xc0, kProgressive = 0xc2;
const Bytes kStart{0xff, 0xd8}, kEnd{0xff, 0xd9};

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes whole;
  for (const Bytes& part : parts) whole.insert(whole.end(), part.begin(), part.end());
  return whole;
}

Bytes quantization() {
  return joined({{0xff, 0xdb, 0, 67, 0}, Bytes(64, 8)});
}

/// \param sampling  of the first component, horizontal and vertical in four bits each
Bytes frame(int marker, int components, int sampling = 0x11) {
  Bytes segment{0xff, marker, 0, 8 + 3 * components, 8, 0, 8, 0, 8, components};
  for (int i = 1; i <= components; ++i) segment.insert(segment.end(), {i, i == 1 ? sampling : 0x11, 0});
  return segment;
}

/// For DC: 0 is no difference, 10 one of seven bits. For AC: 0 ends a block.
Bytes huffman() {
  return joined({{0xff, 0xc4, 0, 39, 0x00, 1, 1}, Bytes(14, 0), {0, 7}, {0x10, 1}, Bytes(15, 0), {0}});
}

/// \param last  coefficient in it; what it says of all of them is 0 but for `bits`, the first of its bytes
Bytes scan(int components, const Bytes& bits = {0}, int last = 63) {
  Bytes segment{0xff, 0xda, 0, 6 + 2 * components, components};
  for (int i = 1; i <= components; ++i) segment.insert(segment.end(), {i, 0});
  return joined({segment, {0, last, 0}, bits});
}

std::vector<std::byte> jpegOf(const std::vector<Bytes>& parts) {
  const Bytes whole = joined(parts);
  std::vector<std::byte> file(whole.size());
  std::transform(whole.begin(), whole.end(), file.begin(), [](int byte) { return static_cast<std::byte>(byte); });
  return file;
}

std::vector<std::byte> greyJpeg() {
  return jpegOf({kStart, quantization(), frame(kBaseline, 1), huffman(), scan(1), kEnd});
}

std::string refusal(std::span<const std::byte> encoded) {
  return refusalOf([&] { decodeImage8(encoded, "picture"); });
}

TEST(Jpeg, IsReadAsRgba) {
  const ImageRgba8 grey = decodeImage8(greyJpeg(), "grey");
  EXPECT_EQ(grey.width(), 8);
  EXPECT_EQ(grey.height(), 8);
  EXPECT_THAT(grey, Each(Texel(128, 128, 128, 255)));
  // Y and Cb of 128; 64 more of Cr are 64 · 1.402 of red and −64 · 0.714 of green.
  const auto red = jpegOf({kStart, quantization(), frame(kBaseline, 3), huffman(), scan(3, {0x0a, 0x03}), kEnd});
  EXPECT_THAT(decodeImage8(red, "red"), Each(Texel(218, 82, 128, 255)));
}

TEST(Jpeg, OfFourInksIsReadAsWhatTheyLeaveOfTheLight) {
  const auto inks = jpegOf({kStart, quantization(), frame(kBaseline, 4), huffman(), scan(4), kEnd});
  EXPECT_THAT(decodeImage8(inks, "inks"), Each(Texel(64, 64, 64, 255)));  // 128 · 128 / 255
}

TEST(Jpeg, IsReadWhateverItsSubsampling) {
  for (const int sampling : {0x22, 0x21, 0x12, 0x41, 0x31, 0x14}) {
    const auto file =
        jpegOf({kStart, quantization(), frame(kBaseline, 3, sampling), huffman(), scan(3, Bytes(3, 0)), kEnd});
    EXPECT_THAT(decodeImage8(file, "picture"), Each(Texel(128, 128, 128, 255))) << sampling;
  }
}

TEST(Jpeg, CutOffAnywhereIsRefusedOrGreyWhereItEndsAndSaidToBeDamaged) {
  const auto whole = jpegOf({kStart, quantization(), frame(kProgressive, 3), huffman(), scan(1, {0}, 0), kEnd});
  int shown = 0;
  for (std::size_t size = 0; size < whole.size() - kEnd.size(); ++size) {
    std::string damage;
    try {
      EXPECT_THAT(decodeImage8(std::span(whole).first(size), "cut", &damage), Each(Texel(128, 128, 128, 255)));
      EXPECT_THAT(damage, HasSubstr("Premature end of JPEG file")) << size;
      ++shown;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(shown, 0);
}

TEST(Jpeg, PartsThatNoScanHoldsAreGreyInEveryRun) {
  // Two of three components come in no scan. Nothing of what lay in memory before is seen.
  const auto file = jpegOf({kStart, quantization(), frame(kProgressive, 3), huffman(), scan(1, {0}, 0), kEnd});
  for (int run = 0; run < 8; ++run) {
    std::vector<std::byte>(std::size_t{1} << (8 + run), std::byte{0xa5}).clear();
    EXPECT_THAT(decodeImage8(file, "picture"), Each(Texel(128, 128, 128, 255)));
  }
}

TEST(Jpeg, WithoutQuantizationIsRefused) {
  EXPECT_EQ(refusal(jpegOf({kStart, frame(kBaseline, 1), huffman(), scan(1), kEnd})),
            "picture: cannot be decoded (Quantization table 0x00 was not defined); save it again");
}

TEST(Jpeg, OfMoreScansThanAnyoneMakesIsRefused) {
  // Each of them goes over the whole picture.
  std::vector<Bytes> parts{kStart, quantization(), frame(kProgressive, 1), huffman()};
  parts.insert(parts.end(), 128, scan(1, {0}, 0));
  parts.push_back(kEnd);
  EXPECT_EQ(refusal(jpegOf(parts)), "was not refused");
  parts.insert(parts.end() - 1, scan(1, {0}, 0));
  EXPECT_EQ(refusal(jpegOf(parts)), "picture: has more than 128 JPEG scans; save it again");
}

TEST(Jpeg, SizeThatItsBytesCannotHoldIsRefusedBeforeAllocating) {
  std::vector<std::byte> jpeg = greyJpeg();
  const auto size = jpeg.begin() + static_cast<std::ptrdiff_t>(kStart.size() + quantization().size() + 5);
  size[0] = size[2] = std::byte{0x3f};
  const AddressSpaceLimit limit(kPlentyForRefusal);
  EXPECT_THAT(refusal(jpeg), HasSubstr("picture: 16136 x 16136 pixels cannot be in a file of"));
}

TEST(Jpeg, WithoutAFrameHasNoHeader) {
  EXPECT_THAT(refusal(jpegOf({kStart, quantization(), kEnd})), HasSubstr("picture: has no valid header ("));
}

}  // namespace
}  // namespace cellcut::test
