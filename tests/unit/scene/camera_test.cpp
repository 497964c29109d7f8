#include "renderer/scene/camera.h"

#include "tests/support/vectors.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(Camera, LooksAlongMinusZThroughTheMiddleOfTheFilm) {
  Camera camera;
  camera.position = {1, 2, 3};
  const Ray ray = cameraRay(camera, {320, 180}, {640, 360});
  expectNear(ray.origin, {1, 2, 3});
  expectNear(ray.direction, {0, 0, -1});
}

TEST(Camera, KeepsTheVerticalAngleWhateverTheAspect) {
  Camera camera;
  camera.halfHeight = std::tan(0.6f);
  for (const int width : {100, 360, 2000}) {
    const Ray top = cameraRay(camera, {0.5f * static_cast<float>(width), 0}, {width, 360});
    expectNear(top.direction, {0, std::sin(0.6f), -std::cos(0.6f)});
  }
}

TEST(Camera, HasSquarePixels) {
  Camera camera;
  const auto slope = [&](Vec2 film) {
    const Vec3 d = cameraRay(camera, film, {640, 360}).direction;
    return Vec2(d) / -d.z;
  };
  const Vec2 right = slope({420, 180}), down = slope({320, 280});
  EXPECT_GT(right.x, 0);
  EXPECT_LT(down.y, 0);
  EXPECT_NEAR(right.x, -down.y, kRounding);
}

TEST(Camera, OrthographicRaysAreParallelAndSpanItsHeight) {
  Camera camera;
  camera.orthographic = true;
  camera.halfHeight = 2;
  const Ray corner = cameraRay(camera, {0, 0}, {200, 100});
  expectNear(corner.origin, {-4, 2, 0});
  expectNear(corner.direction, {0, 0, -1});
}

TEST(DefaultCamera, SeesTheWholeBoxAtAnyScale) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    Bounds box;
    box.add(scale * Vec3(-1, -2, -3));
    box.add(scale * Vec3(3, 2, 1));
    const Camera camera = defaultCamera(box);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? box.lower.x : box.upper.x, corner & 2 ? box.lower.y : box.upper.y,
                   corner & 4 ? box.lower.z : box.upper.z};
      const Vec3 d = p - camera.position;
      EXPECT_GT(-glm::dot(d, camera.back), std::abs(glm::dot(d, camera.up)) / camera.halfHeight);
    }
  }
}

TEST(DefaultCamera, OfAnEmptySceneIsValid) {
  const Camera camera = defaultCamera(Bounds{});
  EXPECT_TRUE(isFinite(camera.position));
  expectNear(glm::cross(camera.right, camera.up), camera.back);
}

}  // namespace
}  // namespace cellcut::test
