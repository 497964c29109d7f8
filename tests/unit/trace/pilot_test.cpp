#include "renderer/trace/pilot.h"

#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(Pilot, HasNoVerticesWhereNoLightIsAskedFor) {
  Scene scene;
  addQuad(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  Material sky;
  sky.unlit = true;
  addSphere(scene, addMaterial(scene, sky), Vec3(0), 1000);
  scene.cameras.push_back(perspective({0, -3, 1}, Vec3(0), 0.8f));
  finish(scene);
  const std::vector<Vec3> vertices = pilotVertices(scene, Accel(scene), scene.cameras[0], 2);
  EXPECT_GT(vertices.size(), 100u);
  for (const Vec3& p : vertices) EXPECT_LT(glm::length(p), 2);
}

}  // namespace
}  // namespace cellcut::test
