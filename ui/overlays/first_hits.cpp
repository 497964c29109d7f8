#include "ui/overlays/first_hits.h"

#include "renderer/scene/camera.h"

namespace cellcut {

FirstHit firstHit(const Scene& scene, const Accel& accel, const Ray& ray) {
  const std::optional<Hit> hit = accel.intersect(ray, 0);
  if (!hit) return {};
  const SurfacePoint surface = surfaceAt(scene, *hit);
  const Vec3 normal = glm::dot(surface.normal, ray.direction) < 0 ? surface.normal : -surface.normal;
  const Vec3 shading = shadingNormalTowards(scene, surface.at, normal, -ray.direction);
  const GlossyLobe lobe = lobeOf(bsdfAt(scene, surface.at), Frame(shading), -ray.direction);
  return {{surface.p, shading, lobe}, normal, surface.error, hit->t};
}

std::optional<Image<FirstHit>> traceFirstHits(const Scene& scene, const Accel& accel, const Camera& camera,
                                              glm::ivec2 size, const std::atomic<bool>& cancel) {
  Image<FirstHit> hits(size.x, size.y);
  for (int y = 0; y < size.y; ++y) {
    if (cancel.load(std::memory_order_relaxed)) return std::nullopt;
    for (int x = 0; x < size.x; ++x) {
      hits.at(x, y) = firstHit(scene, accel, cameraRay(camera, Vec2(x, y) + Vec2(0.5f), size));
    }
  }
  return hits;
}

}  // namespace cellcut
