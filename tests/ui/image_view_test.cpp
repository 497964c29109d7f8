#include "ui/image_view.h"

#include "renderer/base/rng.h"
#include "renderer/base/srgb.h"
#include "renderer/base/tone_map.h"
#include "tests/support/vectors.h"
#include "tests/ui/canvas.h"

#include <cmath>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

using test::Canvas;
using test::Rgba8;

constexpr Rgba8 kBlack(0, 0, 0, 255);
const ImageViewSettings kPlain{.toneMap = false};

/// Each pixel has a colour of its own that sRGB keeps: every channel is 0 or 1.
ImageRgb cornerColors() {
  ImageRgb image(3, 2);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = Vec3((i + 1) & 1, ((i + 1) >> 1) & 1, ((i + 1) >> 2) & 1);
  return image;
}
Rgba8 shownCorner(int x, int y) {
  const int i = y * 3 + x + 1;
  return Rgba8((i & 1) * 255, ((i >> 1) & 1) * 255, ((i >> 2) & 1) * 255, 255);
}

int quantised(float display) {
  return static_cast<int>(std::lround(display * 255));
}

TEST(ImageView, OneToOneIsExactWithRowZeroAtTheTop) {
  Canvas canvas({5, 4});
  ImageView view;
  view.setImage(ImageSlot::kA, cornerColors());
  const ImageRgba8 picture = canvas.draw(view, {Vec2(1, 1), 1}, kPlain);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) {
      const bool inside = x >= 1 && x < 4 && y >= 1 && y < 3;
      EXPECT_EQ(picture.at(x, y), inside ? shownCorner(x - 1, y - 1) : kBlack) << x << ' ' << y;
    }
}

TEST(ImageView, MagnifiedPixelsAreSquares) {
  Canvas canvas({24, 16});
  ImageView view;
  view.setImage(ImageSlot::kA, cornerColors());
  const ImageRgba8 picture = canvas.draw(view, {Vec2(0), 8}, kPlain);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) EXPECT_EQ(picture.at(x, y), shownCorner(x / 8, y / 8)) << x << ' ' << y;
}

TEST(ImageView, AnOddMagnificationShowsEveryPixelWhereItsPlacementSays) {
  Canvas canvas({20, 20});
  ImageView view;
  view.setImage(ImageSlot::kA, cornerColors());
  const ImagePlacement placement{Vec2(-1.25f, 3.5f), 5.3f};
  const ImageRgba8 picture = canvas.draw(view, placement, kPlain);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const auto pixel = imagePixelAt(placement, view.imageSize(), Vec2(x, y) + 0.5f);
      EXPECT_EQ(picture.at(x, y), pixel ? shownCorner(pixel->x, pixel->y) : kBlack) << x << ' ' << y;
    }
}

/// White on every second column.
ImageRgb stripes(int size) {
  ImageRgb image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) image.at(x, y) = Vec3(static_cast<float>(x % 2));
  return image;
}

TEST(ImageView, AShrunkPixelIsTheMeanOverItsArea) {
  Canvas canvas({4, 4});
  ImageView view;
  view.setImage(ImageSlot::kA, stripes(8));
  const ImageRgba8 half = canvas.draw(view, {Vec2(0), 0.5f}, kPlain);
  for (const Rgba8& pixel : half) EXPECT_EQ(pixel, Rgba8(Vec3(188), 255));  // 0.5, encoded: 187.5
  // Two thirds: the first pixel covers columns 0 and half of 1, the second half of 1 and all of 2.
  view.setImage(ImageSlot::kA, stripes(6));
  const ImageRgba8 thirds = canvas.draw(view, {Vec2(0), 2 / 3.0f}, kPlain);
  const auto third = quantised(linearToSrgb(1 / 3.0f));
  const auto twoThirds = quantised(linearToSrgb(2 / 3.0f));
  const int expected[] = {third, third, twoThirds, twoThirds};
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(thirds.at(x, 2).r, expected[x], 1) << x;
}

TEST(ImageView, AMuchShrunkPictureKeepsItsBrightness) {
  Canvas canvas({64, 64});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(2048, 2048, Vec3(1)));
  const ImageRgba8 picture = canvas.draw(view, {Vec2(0), 1 / 64.0f}, kPlain);
  EXPECT_EQ(picture.at(31, 31), Rgba8(255));
  EXPECT_EQ(picture.at(32, 31), kBlack);
}

TEST(ImageView, AShrunkOverlayDoesNotMixTheColorOfWhatIsTransparent) {
  Canvas canvas({1, 1});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(2, 1, Vec3(0)));
  ImageRgba8 overlay(2, 1);
  overlay[0] = Rgba8(200, 0, 0, 255);
  overlay[1] = Rgba8(0, 255, 0, 0);
  view.setOverlay(overlay);
  const Rgba8 pixel = canvas.draw(view, {Vec2(0, 0.25f), 0.5f}, kPlain).at(0, 0);
  EXPECT_NEAR(pixel.r, 100, 1);
  EXPECT_EQ(pixel.g, 0);
}

TEST(ImageView, ClipsToItsRectangle) {
  Canvas canvas({6, 4});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(6, 4, Vec3(1)));
  view.draw({6, 4}, {Vec2(2, 1), Vec2(3, 2)}, {}, kPlain);
  const ImageRgba8 picture = canvas.framebuffer.read();
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_EQ(picture.at(x, y) != kBlack, x >= 2 && x < 5 && y >= 1 && y < 3) << x << ' ' << y;
}

/// Colours of all brightnesses and saturations, and every number that is none.
ImageRgb manyColors() {
  ImageRgb image(128, 128);
  Rng rng(7);
  for (Vec3& color : image) {
    const float brightness = std::exp2(rng.uniform() * 40 - 20);
    color = brightness * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
  }
  const float odd[] = {0, -1, test::kNan, kInfinity, -kInfinity, 1e38f, 1e-40f, 0.0031308f, 0.8f, 1};
  std::size_t i = 0;
  for (const float r : odd)
    for (const float g : odd)
      for (const float b : odd) image[i++] = Vec3(r, g, b);
  return image;
}

/// The largest difference between what is drawn and what `expected` says, in steps of 8 bits.
template <class Function>
int worstDifference(const ImageRgb& image, const ImageViewSettings& settings, const Function& expected) {
  Canvas canvas({image.width(), image.height()});
  ImageView view;
  view.setImage(ImageSlot::kA, image);
  const ImageRgba8 picture = canvas.draw(view, {}, settings);
  int worst = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3 display = expected(image[i]);
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(int{picture[i][c]} - quantised(display[c])));
  }
  return worst;
}

// 1: the driver's pow() may land on the other side of a rounding to 8 bits.
TEST(ImageView, ToneMapIsThatOfTheFiles) {
  const ImageRgb image = manyColors();
  EXPECT_LE(worstDifference(image, {}, [](const Vec3& c) { return toneMap(c); }), 1);
  EXPECT_LE(worstDifference(image, {.exposure = 2}, [](const Vec3& c) { return toneMap(4.0f * c); }), 1);
  EXPECT_LE(worstDifference(image, {.exposure = -3.5f}, [](const Vec3& c) { return toneMap(std::exp2(-3.5f) * c); }),
            1);
}

TEST(ImageView, WithoutToneMapColorsAreClippedSrgb) {
  const auto clipped = [](float c) { return c > 0 ? std::min(1.0f, linearToSrgb(std::min(c, 1.0f))) : 0.0f; };
  EXPECT_LE(worstDifference(manyColors(), kPlain,
                            [&](const Vec3& c) { return Vec3(clipped(c.x), clipped(c.y), clipped(c.z)); }),
            1);
}

TEST(ImageView, AChannelIsShownAsGrey) {
  ImageRgb image(1, 1, Vec3(0.1f, 0.3f, 0.6f));
  const std::pair<ImageChannel, float> cases[] = {{ImageChannel::kRed, 0.1f},
                                                  {ImageChannel::kGreen, 0.3f},
                                                  {ImageChannel::kBlue, 0.6f},
                                                  {ImageChannel::kLuminance, luminance(image[0])}};
  for (const auto& [channel, value] : cases)
    EXPECT_LE(worstDifference(image, {.channel = channel}, [v = value](const Vec3&) { return toneMap(Vec3(v)); }), 1);
}

TEST(ImageView, TheOverlayIsMixedByItsAlphaAndItsOpacity) {
  Canvas canvas({2, 1});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(2, 1, Vec3(1, 0, 0)));
  ImageRgba8 overlay(2, 1);
  overlay[0] = Rgba8(0, 200, 100, 255);
  overlay[1] = Rgba8(0, 200, 100, 0);
  view.setOverlay(overlay);
  EXPECT_EQ(canvas.draw(view, {}, kPlain).at(0, 0), Rgba8(0, 200, 100, 255)) << "opaque colours are exact";
  EXPECT_EQ(canvas.draw(view, {}, kPlain).at(1, 0), Rgba8(255, 0, 0, 255));
  const Rgba8 half = canvas.draw(view, {}, {.toneMap = false, .overlayOpacity = 0.5f}).at(0, 0);
  EXPECT_NEAR(half.r, 127.5, 1);
  EXPECT_NEAR(half.g, 100, 1);
  EXPECT_EQ(canvas.draw(view, {}, {.toneMap = false, .overlayOpacity = 0}).at(0, 0), Rgba8(255, 0, 0, 255));
  view.clearOverlay();
  EXPECT_EQ(canvas.draw(view, {}, kPlain).at(0, 0), Rgba8(255, 0, 0, 255));
}

TEST(ImageView, TheSplitShowsAAtTheLeftAndBAtTheRight) {
  Canvas canvas({8, 1});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(8, 1, Vec3(1, 0, 0)));
  ImageViewSettings settings = kPlain;
  settings.split = 0.25f;
  EXPECT_EQ(canvas.draw(view, {}, settings).at(7, 0), Rgba8(255, 0, 0, 255)) << "B is empty";
  view.setImage(ImageSlot::kB, ImageRgb(4, 1, Vec3(0, 0, 1)));  // half the size, stretched
  const ImageRgba8 picture = canvas.draw(view, {}, settings);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(picture.at(x, 0), x < 2 ? Rgba8(255, 0, 0, 255) : Rgba8(0, 0, 255, 255)) << x;
  settings.split = 0;
  EXPECT_EQ(canvas.draw(view, {}, settings).at(0, 0), Rgba8(0, 0, 255, 255));
  settings.split = 1;
  EXPECT_EQ(canvas.draw(view, {}, settings).at(7, 0), Rgba8(255, 0, 0, 255));
  view.clearImage(ImageSlot::kB);
  settings.split = 0;
  EXPECT_EQ(canvas.draw(view, {}, settings).at(0, 0), Rgba8(255, 0, 0, 255));
}

TEST(ImageView, TheOverlayIsOfALone) {
  Canvas canvas({4, 1});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(4, 1, Vec3(1, 0, 0)));
  view.setOverlay(ImageRgba8(4, 1, Rgba8(0, 255, 0, 255)));
  ImageViewSettings settings = kPlain;
  settings.split = 0.5f;
  EXPECT_EQ(canvas.draw(view, {}, settings).at(3, 0), Rgba8(0, 255, 0, 255)) << "B is empty";
  view.setImage(ImageSlot::kB, ImageRgb(4, 1, Vec3(0, 0, 1)));
  const ImageRgba8 picture = canvas.draw(view, {}, settings);
  for (int x = 0; x < 4; ++x) EXPECT_EQ(picture.at(x, 0), x < 2 ? Rgba8(0, 255, 0, 255) : Rgba8(0, 0, 255, 255)) << x;
}

TEST(ImageView, ANewPictureReplacesTheOldOfAnySize) {
  Canvas canvas({4, 4});
  ImageView view;
  EXPECT_TRUE(view.imageSize().empty());
  EXPECT_EQ(canvas.draw(view, {}, kPlain).at(0, 0), kBlack) << "nothing to show yet";
  for (const int size : {4, 4, 2, 3}) {
    view.setImage(ImageSlot::kA, ImageRgb(size, size, Vec3(size == 2 ? 1.0f : 0.0f, 1, 0)));
    EXPECT_EQ(view.imageSize(), (PixelSize{size, size}));
    EXPECT_EQ(canvas.draw(view, {}, kPlain).at(size - 1, size - 1), Rgba8(size == 2 ? 255 : 0, 255, 0, 255));
  }
}

TEST(FitImage, IsCentredAndKeepsItsShape) {
  const ImagePlacement wide = fitImage({200, 100}, {Vec2(10, 20), Vec2(100, 100)});
  EXPECT_EQ(wide.scale, 0.5f);
  EXPECT_EQ(wide.origin, Vec2(10, 45));
  const ImagePlacement equal = fitImage({640, 480}, {Vec2(0), Vec2(640, 480)});
  EXPECT_EQ(equal.scale, 1);
  EXPECT_EQ(equal.origin, Vec2(0));
  const ImagePlacement odd = fitImage({2, 2}, {Vec2(0), Vec2(5, 2)});
  EXPECT_EQ(odd.origin, Vec2(2, 0)) << "on a whole pixel";
}

TEST(FitImage, AnswersWhichPixelIsUnderThePointer) {
  const ImagePlacement placement{Vec2(10, 20), 4};
  EXPECT_EQ(imagePixelAt(placement, {3, 2}, Vec2(10, 20)), glm::ivec2(0, 0));
  EXPECT_EQ(imagePixelAt(placement, {3, 2}, Vec2(21.9f, 27.9f)), glm::ivec2(2, 1));
  EXPECT_EQ(imagePixelAt(placement, {3, 2}, Vec2(22, 20)), std::nullopt);
  EXPECT_EQ(imagePixelAt(placement, {3, 2}, Vec2(9.9f, 20)), std::nullopt);
  EXPECT_EQ(imagePixelAt(placement, {3, 2}, Vec2(test::kNan, 1e30f)), std::nullopt);
  EXPECT_EQ(placement.toFramebuffer(placement.toImage(Vec2(13, 37))), Vec2(13, 37));
}

}  // namespace
}  // namespace cellcut
