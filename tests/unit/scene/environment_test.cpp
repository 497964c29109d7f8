#include "renderer/scene/environment.h"

#include "renderer/base/error.h"
#include "renderer/base/rng.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/vectors.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Environment turned(double degrees, ImageRgb image = ImageRgb(4, 2, Vec3(1.0f))) {
  Scene scene;
  setEnvironment(scene, std::move(image), 1, degrees, "picture");
  return *scene.environment;
}

TEST(Environment, MiddleOfThePictureLooksAlongXAndRightOfItAlongZ) {
  const Environment environment = turned(0);
  expectNear(directionFromLatLong(environment, {0.5f, 0.5f}), {1, 0, 0});
  expectNear(directionFromLatLong(environment, {0.75f, 0.5f}), {0, 0, 1});
  expectNear(directionFromLatLong(environment, {0.25f, 0.5f}), {0, 0, -1});
  expectNear(directionFromLatLong(environment, {0, 0.5f}), {-1, 0, 0});
  expectNear(directionFromLatLong(environment, {0.3f, 0}), {0, 1, 0});
  expectNear(directionFromLatLong(environment, {0.3f, 1}), {0, -1, 0});
}

TEST(Environment, RotationTurnsThePictureCounterClockwiseSeenFromAbove) {
  // Seen from above with +X to the right, −Z is up: a quarter turn brings what was at +X to −Z.
  expectNear(directionFromLatLong(turned(90), {0.5f, 0.5f}), {0, 0, -1});
  expectNear(directionFromLatLong(turned(-90), {0.5f, 0.5f}), {0, 0, 1});
  expectNear(directionFromLatLong(turned(360 * 1e6 + 90), {0.5f, 0.5f}), {0, 0, -1});
}

TEST(Environment, MappingInvertsItself) {
  Rng rng(1);
  for (const double rotation : {0.0, 37.0, -300.0}) {
    const Environment environment = turned(rotation);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 direction = randomUnit(rng);
      const Vec2 uv = latLongFromDirection(environment, direction);
      expectNear(directionFromLatLong(environment, uv), direction);
    }
  }
}

TEST(Environment, CoordinatesStayBelowOne) {
  for (const double rotation : {0.0, 180.0, 1e-6, -1e-6}) {
    const Environment environment = turned(rotation);
    for (const float z : {0.0f, -0.0f, 1e-30f, -1e-30f, 1e-8f, -1e-8f}) {
      for (const float y : {0.0f, 1.0f, -1.0f}) {
        for (const float x : {-1.0f, 0.0f, 1.0f}) {
          const Vec2 uv = latLongFromDirection(environment, {y == 0 ? x : 0, y, z});
          EXPECT_GE(uv.x, 0.0f);
          EXPECT_LT(uv.x, 1.0f);
          EXPECT_GE(uv.y, 0.0f);
          EXPECT_LT(uv.y, 1.0f);
        }
      }
    }
  }
}

TEST(Environment, AnglesNearThePolesAreExact) {
  for (const float angle : {1e-2f, 1e-4f, 1e-7f, 1e-20f}) {
    const Vec2 up = latLongFromDirection(turned(0), {std::sin(angle), std::cos(angle), 0});
    EXPECT_NEAR(up.y * kPi / angle, 1, kRounding) << angle;
  }
}

TEST(Environment, RadianceIsTheTexelAtItsCentre) {
  ImageRgb image(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) image.at(x, y) = Vec3(1 + x, 1 + y, 1);
  }
  for (const double rotation : {0.0, 30.0}) {
    const Environment environment = turned(rotation, image);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Vec2 centre((static_cast<float>(x) + 0.5f) / 8, (static_cast<float>(y) + 0.5f) / 4);
        // Rounding of the coordinate by 1e-7 times 8 texels times the step of up to 7 at the seam.
        expectNear(environmentRadiance(environment, directionFromLatLong(environment, centre)), image.at(x, y), 2e-5f);
      }
    }
  }
}

TEST(Environment, RadianceIsBilinearAndWrapsAtTheSeam) {
  ImageRgb image(4, 2);
  image.at(0, 0) = image.at(0, 1) = Vec3(2.0f);
  image.at(3, 0) = image.at(3, 1) = Vec3(6.0f);
  const Environment environment = turned(0, image);
  expectNear(environmentRadiance(environment, directionFromLatLong(environment, {0, 0.5f})), Vec3(4.0f), 1e-5f);
  expectNear(environmentRadiance(environment, {-1, 0, 0}), Vec3(4.0f), 1e-5f);
  expectNear(environmentRadiance(environment, {-1, 0, -0.0f}), Vec3(4.0f), 1e-5f);
  // A quarter of the way from texel 0 to the black texel 1.
  expectNear(environmentRadiance(environment, directionFromLatLong(environment, {0.75f / 4, 0.5f})), Vec3(1.5f), 1e-5f);
}

TEST(Environment, RadianceIsClampedAtThePoles) {
  ImageRgb image(4, 2, Vec3(1.0f));
  for (int x = 0; x < 4; ++x) image.at(x, 1) = Vec3(3.0f);
  const Environment environment = turned(0, image);
  expectNear(environmentRadiance(environment, {0, 1, 0}), Vec3(1.0f));
  expectNear(environmentRadiance(environment, {0, -1, 0}), Vec3(3.0f));
  expectNear(environmentRadiance(environment, {1, 0, 0}), Vec3(2.0f));
}

TEST(Environment, OnePixelIsTheSameEverywhere) {
  const Environment environment = turned(12, ImageRgb(1, 1, {1, 2, 3}));
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) expectNear(environmentRadiance(environment, randomUnit(rng)), {1, 2, 3});
}

TEST(Environment, RadianceIsNeverNegativeNorBadNearOneBrightTexel) {
  ImageRgb image(64, 32);
  image.at(63, 0) = Vec3(1e6f);
  const Environment environment = turned(77, image);
  Rng rng(6);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 radiance = environmentRadiance(environment, randomUnit(rng));
    EXPECT_TRUE(radiance.x >= 0 && radiance.x <= 1e6f);
  }
}

TEST(SetEnvironment, ScalesAndReplaces) {
  Scene scene;
  setEnvironment(scene, ImageRgb(2, 1, Vec3(1.0f)), 1, 0, "first");
  setEnvironment(scene, ImageRgb(2, 1, {1, 2, 3}), 2.5, 90, "second");
  EXPECT_EQ(scene.environment->radiance.at(1, 0), Vec3(2.5f, 5, 7.5f));
  EXPECT_FLOAT_EQ(scene.environment->rotation, kPi / 2);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(SetEnvironment, BadTexelsAreBlackAndCountedInOneWarning) {
  ImageRgb image(3, 2, Vec3(1.0f));
  image.at(0, 0).x = kNan;
  image.at(1, 0).y = kInfinity;
  Scene scene;
  setEnvironment(scene, image, 2, 0, "sky.exr");
  EXPECT_THAT(scene.warnings, ElementsAre(testing::AllOf(HasSubstr("sky.exr: 2 texels"), HasSubstr("black"))));
  EXPECT_EQ(scene.environment->radiance.at(0, 0), Vec3(0.0f));
  EXPECT_EQ(scene.environment->radiance.at(1, 0), Vec3(0.0f));
  EXPECT_EQ(scene.environment->radiance.at(2, 0), Vec3(2.0f));
}

TEST(SetEnvironment, ANegativeChannelIsTakenAsZeroAndTheOthersStay) {
  Scene scene;
  setEnvironment(scene, ImageRgb(2, 1, {10, 5, -0.001f}), 2, 0, "sky.exr");
  EXPECT_THAT(scene.warnings, ElementsAre(testing::AllOf(HasSubstr("sky.exr: 2 texels"), HasSubstr("negative"))));
  EXPECT_EQ(scene.environment->radiance.at(0, 0), Vec3(20, 10, 0));
}

TEST(SetEnvironment, RefusesBadArgumentsAndKeepsTheOldEnvironment) {
  Scene scene;
  setEnvironment(scene, ImageRgb(1, 1, Vec3(7.0f)), 1, 0, "old");
  const ImageRgb image(1, 1, Vec3(1e30f));
  for (const double scale :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e10}) {
    EXPECT_THROW(setEnvironment(scene, image, scale, 0, "new"), InputError) << scale;
  }
  EXPECT_THROW(setEnvironment(scene, image, 1, std::numeric_limits<double>::infinity(), "new"), InputError);
  EXPECT_THROW(setEnvironment(scene, ImageRgb(), 1, 0, "new"), InputError);
  EXPECT_EQ(scene.environment->radiance.at(0, 0), Vec3(7.0f));
}

/// Luminance of a radiance that is constant on each cell of a lat-long grid, over the sphere.
template <class Radiance>
double sphereIntegral(int columns, int rows, const Radiance& radiance) {
  double sum = 0;
  for (int y = 0; y < rows; ++y) {
    const double ring = std::cos(std::numbers::pi * y / rows) - std::cos(std::numbers::pi * (y + 1) / rows);
    for (int x = 0; x < columns; ++x) sum += 2 * std::numbers::pi / columns * ring * luminance(radiance(x, y));
  }
  return sum;
}

TEST(EnvironmentCorpus, RealEnvironmentsKeepTheirLight) {
  if (!std::filesystem::exists(CELLCUT_CORPUS)) GTEST_SKIP() << "no corpus beside this checkout";
  for (const char* name : {"city", "forest", "lobby", "night", "studio", "sunset"}) {
    const ImageRgb image = readImage(std::string(CELLCUT_CORPUS) + "/environments/" + name + ".exr");
    const Environment environment = turned(25, image);
    const double texels = sphereIntegral(image.width(), image.height(), [&](int x, int y) { return image.at(x, y); });
    const int columns = 2 * image.width(), rows = 2 * image.height();
    const double lookups = sphereIntegral(columns, rows, [&](int x, int y) {
      const Vec2 uv = (Vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) /
                      Vec2(static_cast<float>(columns), static_cast<float>(rows));
      return environmentRadiance(environment, directionFromLatLong(environment, uv));
    });
    // Bilinear filtering moves light between rings of different solid angle: most for the small lamps near the lobby's
    // zenith.
    EXPECT_NEAR(lookups / texels, 1, 0.02) << name;
  }
}

}  // namespace
}  // namespace cellcut::test
