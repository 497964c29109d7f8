#include "renderer/lights/triangle_light.h"

#include "renderer/base/warp.h"
#include "renderer/lights/scalar_emission.h"
#include "renderer/scene/material.h"

#include <oneapi/tbb/parallel_for.h>

namespace cellcut {
namespace {

/// Solid angles (sr) between which directions are sampled uniformly. Below, sampling by area is as good, but for a
/// triangle whose corners are not about as far away: a lamp of 60 m × 2 cm at 3 m (0.007 sr) has 50 times the variance by
/// area; the sample's own float direction places it across 0.002 sr to 10⁻⁴ of their width. Above, the triangle is all but
/// a hemisphere and Arvo's formulas divide by almost zero (pbrt's limit).
constexpr float kMinSolidAngle = 1e-2f;
constexpr float kMinStretchedSolidAngle = 2e-3f;
constexpr float kMaxSolidAngle = 6.22f;
/// A triangle is stretched when its farthest corner is more than 1.5 times as far away as its nearest.
constexpr float kStretched2 = 1.5f * 1.5f;
/// Cosine between corners below which points are sampled: from close to the middle of an edge its ends are all but
/// opposite, and the float direction of a sample no longer says where in the triangle it is. Here they are 4 · 10⁻³ short
/// of opposite.
constexpr double kMinCornerCosine = -1 + 1e-5;

/// A triangle as the observer sees it on the unit sphere.
struct SphericalTriangle {
  std::array<glm::dvec3, 3> directions;
  float solidAngle;
};

/// The spherical triangle if directions are to be sampled uniformly in it; nothing if points are.
std::optional<SphericalTriangle> sphericalTriangle(const TriangleGeometry& triangle, const Vec3& p) {
  const std::array<Vec3, 3> to{triangle.corners[0] - p, triangle.corners[1] - p, triangle.corners[2] - p};
  const auto [nearest2, farthest2] =
      std::minmax({glm::dot(to[0], to[0]), glm::dot(to[1], to[1]), glm::dot(to[2], to[2])});
  const float least = farthest2 > kStretched2 * nearest2 ? kMinStretchedSolidAngle : kMinSolidAngle;
  // All but slivers that far away span less than the limit: skip the square roots and the arctangent.
  if (triangle.area <= 0.25f * least * nearest2 || nearest2 == 0) return std::nullopt;
  // In double: float directions know the width of a sliver to 10⁻³.
  std::array<glm::dvec3, 3> directions;
  for (std::size_t i = 0; i < 3; ++i) directions[i] = glm::normalize(glm::dvec3(triangle.corners[i]) - glm::dvec3(p));
  const double widest = std::min({glm::dot(directions[0], directions[1]), glm::dot(directions[1], directions[2]),
                                  glm::dot(directions[2], directions[0])});
  if (widest < kMinCornerCosine) return std::nullopt;
  const float solidAngle = sphericalTriangleArea(directions);
  if (!(solidAngle > least && solidAngle < kMaxSolidAngle)) return std::nullopt;
  return SphericalTriangle{directions, solidAngle};
}

/// d² / (cosθ · A); 0 where that is no finite positive number.
float areaPdf(const TriangleGeometry& triangle, const Vec3& p, const Vec3& q) {
  const Vec3 d = q - p;
  const float distance2 = glm::dot(d, d);
  const float cosine = std::abs(glm::dot(d, triangle.normal)) / std::sqrt(distance2);
  const float pdf = distance2 / (cosine * triangle.area);
  return std::isfinite(pdf) ? pdf : 0.0f;
}

Vec3 pointAt(const TriangleGeometry& triangle, Vec2 barycentric) {
  return (1 - barycentric.x - barycentric.y) * triangle.corners[0] + barycentric.x * triangle.corners[1] +
         barycentric.y * triangle.corners[2];
}

}  // namespace

TriangleGeometry triangleGeometry(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const std::array<Vec3, 3> c{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  const glm::dvec3 origin(c[0]);
  const glm::dvec3 cross = glm::cross(glm::dvec3(c[1]) - origin, glm::dvec3(c[2]) - origin);
  const double length = glm::length(cross);
  return {c, Vec3(cross * (1 / length)), static_cast<float>(0.5 * length)};
}

std::optional<Vec2> intersectPlane(const TriangleGeometry& triangle, const Vec3& p, const Vec3& direction) {
  // In double: the products of micrometre edges would leave the range of a float.
  const glm::dvec3 edge1 = glm::dvec3(triangle.corners[1]) - glm::dvec3(triangle.corners[0]);
  const glm::dvec3 edge2 = glm::dvec3(triangle.corners[2]) - glm::dvec3(triangle.corners[0]);
  const glm::dvec3 cross = glm::cross(glm::dvec3(direction), edge2);
  const double determinant = glm::dot(edge1, cross);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 toOrigin = glm::dvec3(p) - glm::dvec3(triangle.corners[0]);
  double b1 = std::clamp(glm::dot(toOrigin, cross) / determinant, 0.0, 1.0);
  double b2 = std::clamp(glm::dot(glm::dvec3(direction), glm::cross(toOrigin, edge1)) / determinant, 0.0, 1.0);
  if (b1 + b2 > 1) {
    const double sum = b1 + b2;
    b1 /= sum;
    b2 /= sum;
  }
  return Vec2(b1, b2);
}

std::optional<TrianglePoint> sampleTriangle(const TriangleGeometry& triangle, const Vec3& p, Vec2 u) {
  if (const auto spherical = sphericalTriangle(triangle, p)) {
    const std::optional<Vec3> direction = uniformSphericalTriangle(spherical->directions, u);
    if (!direction) return std::nullopt;
    const std::optional<Vec2> barycentric = intersectPlane(triangle, p, *direction);
    if (!barycentric) return std::nullopt;
    return TrianglePoint{*barycentric, pointAt(triangle, *barycentric), 1 / spherical->solidAngle};
  }
  const Vec2 barycentric = uniformTriangle(u);
  const Vec3 position = pointAt(triangle, barycentric);
  const float pdf = areaPdf(triangle, p, position);
  if (pdf == 0) return std::nullopt;
  return TrianglePoint{barycentric, position, pdf};
}

float trianglePdf(const TriangleGeometry& triangle, const Vec3& p, const Vec3& q) {
  if (const auto spherical = sphericalTriangle(triangle, p)) return 1 / spherical->solidAngle;
  return areaPdf(triangle, p, q);
}

bool emitsTowards(const TriangleGeometry& triangle, bool doubleSided, const Vec3& p) {
  const float side = glm::dot(p - triangle.corners[0], triangle.normal);
  return side > 0 || (side < 0 && doubleSided);
}

double triangleFormFactor(const TriangleGeometry& triangle, const Vec3& p, const Vec3& n) {
  using DVec3 = glm::dvec3;
  // Clip to the horizon: a triangle becomes a polygon of at most four corners.
  std::array<DVec3, 4> polygon;
  std::size_t count = 0;
  const DVec3 normal(n);
  for (std::size_t i = 0; i < 3; ++i) {
    const DVec3 a = DVec3(triangle.corners[i]) - DVec3(p);
    const DVec3 b = DVec3(triangle.corners[(i + 1) % 3]) - DVec3(p);
    const double ha = glm::dot(a, normal), hb = glm::dot(b, normal);
    if (ha > 0) polygon[count++] = a;
    if ((ha > 0) != (hb > 0) && count < polygon.size()) polygon[count++] = a + (ha / (ha - hb)) * (b - a);
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const DVec3& a = polygon[i];
    const DVec3& b = polygon[(i + 1) % count];
    const DVec3 cross = glm::cross(a, b);
    const double length = glm::length(cross);
    // Edge angle over sine, times the component of the edge's normal: the limit at a zero angle is 1 / |a||b|.
    if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(cross, normal) / length;
  }
  return std::min(0.5 * std::abs(sum), std::numbers::pi);
}

double TriangleEmitter::irradiance(const Vec3& p, const Vec3& n) const {
  return emitsTowards(geometry, doubleSided, p) ? meanRadiance * triangleFormFactor(geometry, p, n) : 0.0;
}

namespace {

/// Scalar emission times coverage, averaged over a triangle; > 0 wherever some point of it emits.
float meanEmission(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, LitTexelsOfScene& lit) {
  const Material& material = scene.materials[indexOf(mesh.material)];
  const double factor = scalarEmission(material.emission);
  const bool textured = material.slot(TextureUse::kEmission).texture.has_value();
  const bool covered = material.alphaMode != AlphaMode::kOpaque;
  if (!textured && !covered) return static_cast<float>(factor);

  // Centroids of n² congruent parts; n follows the texture's resolution on the triangle.
  const int n = emissionResolution(scene, mesh, triangle);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const float third = (j % 2 == 0) ? 1.0f / 3 : 2.0f / 3;
      const Vec2 barycentric =
          Vec2(static_cast<float>(i) + third, static_cast<float>(j / 2) + third) / static_cast<float>(n);
      const SurfaceCoordinates at{&mesh, triangle, barycentric};
      sum += scalarEmission(emission(scene, at)) * static_cast<double>(coverage(scene, at));
    }
  }
  const auto mean = static_cast<float>(sum / (static_cast<double>(n) * n));
  if (mean > 0) return mean;
  // The centroids may all have missed it: ask for the brightest texel that an interpolation can touch.
  return canEmit(scene, mesh, triangle, lit) ? static_cast<float>(factor / (static_cast<double>(n) * n)) : 0.0f;
}

}  // namespace

std::vector<TriangleLight> collectTriangleLights(const Scene& scene) {
  std::vector<TriangleLight> lights;
  LitTexelsOfScene lit(scene);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Material& material = scene.materials[indexOf(mesh.material)];
    if (!canEmit(scene, material, lit)) continue;
    const std::size_t first = lights.size();
    lights.resize(first + mesh.triangles.size());
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
      const auto triangle = static_cast<std::uint32_t>(i);
      lights[first + i] = {static_cast<MeshId>(m), triangle, meanEmission(scene, mesh, triangle, lit)};
    });
  }
  std::erase_if(lights, [](const TriangleLight& light) { return !(light.meanRadiance > 0); });
  lights.shrink_to_fit();
  return lights;
}

}  // namespace cellcut
