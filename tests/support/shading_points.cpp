#include "tests/support/shading_points.h"

#include "renderer/base/rng.h"
#include "renderer/base/warp.h"
#include "renderer/lights/triangle_light.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/material.h"

#include <cmath>

namespace cellcut::test {
namespace {

struct Arrival {
  ShadingPoint point;
  Vec3 wo;  ///< where the path came from
};

/// The vertex after `bounces` bounces of one path, if it gets that far.
std::optional<Arrival> vertexAfter(const Scene& scene, const Accel& accel, std::size_t bounces, Rng& rng) {
  constexpr int kFilm = 64;
  Ray ray = cameraRay(scene.cameras[0], {kFilm * rng.uniform(), kFilm * rng.uniform()}, {kFilm, kFilm});
  for (std::size_t depth = 0;; ++depth) {
    const auto hit = accel.intersect(ray, 0);
    if (!hit) return std::nullopt;
    const Mesh& mesh = scene.meshes[indexOf(hit->mesh)];
    const TriangleGeometry triangle = triangleGeometry(mesh, hit->triangle);
    const Vec3 normal = glm::dot(triangle.normal, ray.direction) < 0 ? triangle.normal : -triangle.normal;
    const Vec3 p = ray.origin + hit->t * ray.direction;
    const Vec3 shading = shadingNormal(scene, {&mesh, hit->triangle, hit->barycentric}, normal);
    if (depth == bounces) return Arrival{{p, shading, {}, depth > 0}, -ray.direction};
    const Vec3 direction = Frame(normal).toWorld(cosineHemisphere({rng.uniform(), rng.uniform()}));
    ray = {offsetRayOrigin(p, triangleError(triangle.corners[0], triangle.corners[1], triangle.corners[2]), normal,
                           direction),
           direction};
  }
}

}  // namespace

std::vector<ShadingPoint> pathVertices(const Scene& scene, std::size_t count, std::uint64_t seed) {
  const Accel accel(scene);
  Rng rng(seed);
  // Lobes have numbers of their own: what asks for none goes the same ways.
  Rng lobes(hashOf(seed, 4));
  std::vector<ShadingPoint> points;
  for (std::size_t tries = 0; points.size() < count && tries < 100 * count; ++tries) {
    const auto arrival = vertexAfter(scene, accel, points.size() % 3, rng);
    if (!arrival) continue;
    points.push_back(arrival->point);
    // Every other point mirrors, sharply or not.
    const bool mirrors = points.size() % 2 == 0 && glm::dot(arrival->point.n, arrival->wo) > 0;
    if (mirrors) points.back().lobe = {arrival->wo, std::exp2(-9 * lobes.uniform()), lobes.uniform(0.1f, 0.9f)};
  }
  return points;
}

}  // namespace cellcut::test
