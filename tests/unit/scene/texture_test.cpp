#include "renderer/scene/texture.h"

#include "renderer/base/srgb.h"

#include <gtest/gtest.h>

namespace cellcut {
namespace {

/// A scene with one picture of width × height whose red is 10 · x, green 10 · y, alpha 255 − x.
Scene sceneWithPicture(int width, int height) {
  Scene scene;
  scene.texels.emplace_back(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      scene.texels[0].at(x, y) = {static_cast<std::uint8_t>(10 * x), static_cast<std::uint8_t>(10 * y), 0,
                                  static_cast<std::uint8_t>(255 - x)};
    }
  }
  return scene;
}

float redAt(const Scene& scene, const Texture& texture, Vec2 uv) {
  return lookup(scene, texture, TexelEncoding::kLinear, uv).x * 255 / 10;
}

TEST(Texture, IsExactAtTexelCentres) {
  const Scene scene = sceneWithPicture(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const Vec2 uv{(static_cast<float>(x) + 0.5f) / 8, (static_cast<float>(y) + 0.5f) / 4};
      const Vec4 value = lookup(scene, Texture{}, TexelEncoding::kLinear, uv);
      EXPECT_EQ(value.x, static_cast<float>(10 * x) / 255);
      EXPECT_EQ(value.y, static_cast<float>(10 * y) / 255);
      EXPECT_EQ(value.w, static_cast<float>(255 - x) / 255);
    }
  }
}

TEST(Texture, IsLinearBetweenTexelCentres) {
  const Scene scene = sceneWithPicture(8, 1);
  // One rounding of each of the two weighted texels.
  EXPECT_NEAR(redAt(scene, Texture{}, {(2 + 0.75f) / 8, 0.5f}), 2.25f, 1e-5f);
}

TEST(Texture, WrapsAsItsModeSays) {
  const Scene scene = sceneWithPicture(4, 1);
  const auto texelAt = [&](Wrap wrap, int x) {
    return redAt(scene, {TexelsId{0}, wrap, wrap}, {(static_cast<float>(x) + 0.5f) / 4, 0.5f});
  };
  const int repeated[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1}, clamped[] = {0, 0, 0, 0, 0, 1, 2, 3, 3, 3},
            mirrored[] = {3, 2, 1, 0, 0, 1, 2, 3, 3, 2};
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(texelAt(Wrap::kRepeat, i - 4), static_cast<float>(repeated[i]), 1e-5f) << i - 4;
    EXPECT_NEAR(texelAt(Wrap::kClamp, i - 4), static_cast<float>(clamped[i]), 1e-5f) << i - 4;
    EXPECT_NEAR(texelAt(Wrap::kMirror, i - 4), static_cast<float>(mirrored[i]), 1e-5f) << i - 4;
  }
}

TEST(Texture, FiltersAcrossTheSeamOnlyWhereItRepeats) {
  const Scene scene = sceneWithPicture(4, 1);
  EXPECT_NEAR(redAt(scene, {TexelsId{0}, Wrap::kRepeat}, {0, 0.5f}), 1.5f, 1e-5f);
  EXPECT_NEAR(redAt(scene, {TexelsId{0}, Wrap::kClamp}, {0, 0.5f}), 0, 1e-5f);
}

TEST(Texture, NearestTakesTheTexelThatCoversTheCoordinate) {
  const Scene scene = sceneWithPicture(4, 1);
  Texture texture;
  texture.nearest = true;
  EXPECT_NEAR(redAt(scene, texture, {0.49f, 0.5f}), 1, 1e-5f);
  EXPECT_NEAR(redAt(scene, texture, {0.51f, 0.5f}), 2, 1e-5f);
}

TEST(Texture, DecodesSrgbBeforeItFilters) {
  Scene scene;
  scene.texels.emplace_back(2, 1);
  scene.texels[0].at(1, 0) = {255, 255, 255, 255};
  const Vec4 middle = lookup(scene, Texture{}, TexelEncoding::kSrgb, {0.5f, 0.5f});
  EXPECT_NEAR(middle.x, 0.5f, 1e-6f);  // half of the light, not of the code
  EXPECT_NEAR(middle.w, 0.5f, 1e-6f);
}

TEST(Texture, HugeAndNonFiniteCoordinatesReadSomeTexel) {
  const Scene scene = sceneWithPicture(4, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float u : {nan, kInfinity, -kInfinity, 3e38f, -3e38f, 1e-45f, -1e-45f}) {
    for (const Wrap wrap : {Wrap::kRepeat, Wrap::kClamp, Wrap::kMirror}) {
      const Vec4 value = lookup(scene, {TexelsId{0}, wrap, wrap}, TexelEncoding::kLinear, {u, 0.3f});
      EXPECT_GE(value.x, 0);
      EXPECT_LE(value.x, 30.0f / 255 * 1.000001f);
    }
  }
  EXPECT_EQ(redAt(scene, Texture{}, {nan, 0.9f}), 0);
}

}  // namespace
}  // namespace cellcut
