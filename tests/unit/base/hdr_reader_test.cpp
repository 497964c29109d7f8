#include "renderer/base/error.h"
#include "renderer/base/image_codecs.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"

#include <initializer_list>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

std::vector<std::byte> hdr(std::string_view resolution, std::initializer_list<int> pixels) {
  const std::string text = "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n\n" + std::string(resolution) + "\n";
  const auto header = std::as_bytes(std::span(text));
  std::vector<std::byte> file(header.begin(), header.end());
  for (const int byte : pixels) file.push_back(static_cast<std::byte>(byte));
  return file;
}

std::string hdrRefusal(std::span<const std::byte> encoded) {
  return refusalOf([&] { decodeHdr(encoded, "picture"); });
}

/// One row of eight pixels: red in a run, green one by one, blue in two runs, exponent 128 in one.
const std::initializer_list<int> kRow{2,       2,  0,       8,                  //
                                      128 + 8, 64,                              //
                                      8,       0,  1,       2,  3, 4, 5, 6, 7,  //
                                      128 + 3, 10, 128 + 5, 20,                 //
                                      128 + 8, 136};

TEST(HdrReader, ReadsRunsOfEachComponent) {
  const ImageRgb image = decodeHdr(hdr("-Y 1 +X 8", kRow), "row");
  ASSERT_EQ(image.width(), 8);
  ASSERT_EQ(image.height(), 1);
  for (int x = 0; x < 8; ++x) {  // exponent 136: mantissas are the values
    EXPECT_EQ(image.at(x, 0), Vec3(64, x, x < 3 ? 10 : 20)) << x;
  }
}

TEST(HdrReader, ReadsFlatPixelsAndOldRuns) {
  const ImageRgb image =
      decodeHdr(hdr("-Y 2 +X 3", {128, 0, 0, 129, 1, 1, 1, 2, 0, 0, 0, 0, 9, 9, 9, 136, 0, 0, 1, 1}), "old");
  ASSERT_EQ(image.width(), 3);
  ASSERT_EQ(image.height(), 2);
  for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(x, 0), Vec3(1, 0, 0));
  EXPECT_EQ(image.at(0, 1), Vec3(0.0f));
  EXPECT_EQ(image.at(1, 1), Vec3(9.0f));
  EXPECT_EQ(image.at(2, 1), Vec3(0, 0, 0x1p-135f));  // the smallest number of the format is kept, though denormal
}

TEST(HdrReader, FileCutOffAnywhereIsRefused) {
  const std::vector<std::byte> whole = hdr("-Y 1 +X 8", kRow);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(decodeHdr(std::span(whole).first(size), "cut"), InputError) << size;
  }
}

TEST(HdrReader, RefusesRunsPastTheirRow) {
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 8", {2, 2, 0, 8, 128 + 9, 64})), HasSubstr("run past"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 8", {2, 2, 0, 8, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9})), HasSubstr("run past"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 8", {2, 2, 0, 8, 0, 0, 0, 0})), HasSubstr("run past"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 3", {1, 1, 1, 1})), HasSubstr("run past"));  // nothing before it
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 3", {9, 9, 9, 128, 1, 1, 1, 3})), HasSubstr("run past"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 1 +X 8", {2, 2, 0, 9})), HasSubstr("another length"));
}

TEST(HdrReader, RefusesHeadersBeforeAllocating) {
  const test::AddressSpaceLimit limit(test::kPlentyForRefusal);
  EXPECT_THAT(hdrRefusal(hdr("-Y 16384 +X 16384", {0})), HasSubstr("cannot be in a file"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 2000000000 +X 2000000000", {0})), HasSubstr("limit"));
  EXPECT_THAT(hdrRefusal(hdr("-Y -1 +X 1", {0})), HasSubstr("damaged"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 0 +X 0", {0})), HasSubstr("damaged"));
  EXPECT_THAT(hdrRefusal(hdr("-Y 99999999999999999999 +X 1", {0})), HasSubstr("size"));
  EXPECT_THAT(hdrRefusal(hdr("+Y 1 +X 1", {0, 0, 0, 0})), HasSubstr("-Y +X"));
}

}  // namespace
}  // namespace cellcut::test
