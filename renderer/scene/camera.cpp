#include "renderer/scene/camera.h"

#include <cassert>
#include <tuple>

namespace cellcut {

Ray cameraRay(const Camera& camera, Vec2 film, glm::ivec2 size) {
  assert(size.x > 0 && size.y > 0);
  // Offset from the middle of the film in half heights, so that the vertical angle does not depend on the aspect.
  const Vec2 halfSize = 0.5f * Vec2(size);
  const Vec2 offset{(film.x - halfSize.x) / halfSize.y, 1 - film.y / halfSize.y};
  const Vec3 across = camera.halfHeight * (offset.x * camera.right + offset.y * camera.up);
  if (camera.orthographic) return {camera.position + across, -camera.back};
  return {camera.position, glm::normalize(across - camera.back)};
}

Camera defaultCamera(const Bounds& bounds) {
  const float radius = bounds.radius() > 0 ? bounds.radius() : 1.0f;
  const Vec3 centre = bounds.centre();
  Camera camera;
  camera.name = "default";
  camera.back = glm::normalize(Vec3{0.6f, 0.45f, 1.0f});
  camera.right = glm::normalize(glm::cross(Vec3{0, 1, 0}, camera.back));
  camera.up = glm::cross(camera.back, camera.right);
  // The sphere around the box just touches the top and the bottom of the picture.
  camera.position = centre + radius / std::sin(std::atan(camera.halfHeight)) * camera.back;
  return camera;
}

bool isSameView(const Camera& a, const Camera& b) {
  // The bindings stop to compile when a member is added. The name is no part of the picture.
  const auto& [name, orthographic, position, right, up, back, halfHeight] = a;
  return std::tie(orthographic, position, right, up, back, halfHeight) ==
         std::tie(b.orthographic, b.position, b.right, b.up, b.back, b.halfHeight);
}

}  // namespace cellcut
