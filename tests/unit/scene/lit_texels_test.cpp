#include "renderer/scene/lit_texels.h"

#include "renderer/base/rng.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

bool anyByLooking(const ImageRgba8& image, TexelRange columns, TexelRange rows, ColorChannels channels) {
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      for (int c = 0; c < 3; ++c) {
        if ((channels >> c & 1) && image.at(x, y)[c] > 0) return true;
      }
    }
  }
  return false;
}

TEST(LitTexels, AreThoseThatALookAtEachFinds) {
  Rng rng(5);
  const auto upTo = [&](int most) { return static_cast<int>(rng.below(static_cast<std::uint32_t>(most) + 1)); };
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(31, 33), glm::ivec2(32, 64), glm::ivec2(200, 100)}) {
    ImageRgba8 image(size.x, size.y, {0, 0, 0, 255});  // alpha is no light
    EXPECT_FALSE(LitTexels(image).any(7));
    for (int i = 0; i < 4; ++i) image.at(upTo(size.x - 1), upTo(size.y - 1))[upTo(2)] = 1;
    const LitTexels lit(image);
    EXPECT_TRUE(lit.any(7));
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
      const int x = upTo(size.x - 1), y = upTo(size.y - 1);
      const TexelRange columns{x, x + upTo(size.x - 1 - x)}, rows{y, y + upTo(size.y - 1 - y)};
      const auto channels = static_cast<ColorChannels>(1 + upTo(6));
      const bool expected = anyByLooking(image, columns, rows, channels);
      EXPECT_EQ(lit.any(columns, rows, channels), expected);
      found += expected;
    }
    EXPECT_GT(found, 0);
  }
}

}  // namespace
}  // namespace cellcut::test
