#include "renderer/trace/pilot.h"

#include "renderer/base/pixel_sampler.h"
#include "renderer/base/warp.h"
#include "renderer/scene/camera.h"
#include "renderer/trace/surface.h"

namespace cellcut {
namespace {

/// Enough paths for 5 % quantiles to be sharp, few enough to take about a millisecond.
constexpr glm::ivec2 kSize(64, 36);

}  // namespace

std::vector<Vec3> pilotVertices(const Scene& scene, const Accel& accel, const Camera& camera, int maxDepth) {
  std::vector<Vec3> vertices;
  for (int y = 0; y < kSize.y; ++y) {
    for (int x = 0; x < kSize.x; ++x) {
      PixelSampler random(PixelSampling::kIndependent, 0, x, y, 0);
      Ray ray = cameraRay(camera, Vec2(x, y) + Vec2(0.5f), kSize);
      for (int depth = 0; depth < std::min(maxDepth, kPilotDepth); ++depth) {
        const Sample4 numbers = random.next();
        const std::optional<Hit> hit = accel.intersect(ray, static_cast<std::uint32_t>(numbers.extra));
        if (!hit) break;
        const SurfacePoint surface = surfaceAt(scene, *hit);
        if (scene.materials[indexOf(surface.at.mesh->material)].unlit) break;  // no light is asked for there
        vertices.push_back(surface.p);
        const Vec3 normal = glm::dot(surface.normal, ray.direction) < 0 ? surface.normal : -surface.normal;
        const Vec3 direction = Frame(normal).toWorld(cosineHemisphere({numbers[0], numbers[1]}));
        ray = {offsetRayOrigin(surface.p, surface.error, normal, direction), direction};
      }
    }
  }
  return vertices;
}

}  // namespace cellcut
