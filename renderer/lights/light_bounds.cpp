#include "renderer/lights/light_bounds.h"

#include "renderer/lights/scalar_emission.h"

#include <oneapi/tbb/parallel_for.h>

namespace cellcut {
namespace {

/// For point lights: every direction.
constexpr Cone kAllDirections{{0, 0, 1}, -1, 0};

LightBounds pointBounds(const PointLight& light) {
  LightBounds bounds{.axes = kAllDirections};
  bounds.box.add(light.position);
  return bounds;
}

LightBounds spotBounds(const SpotLight& light) {
  const float sinInner = safeSqrt(1 - light.cosInner * light.cosInner);
  const float sinOuter = safeSqrt(1 - light.cosOuter * light.cosOuter);
  LightBounds bounds{.axes = {light.axis, light.cosInner, sinInner},
                     .cosThetaE = cosSubClamped(light.cosOuter, sinOuter, light.cosInner, sinInner)};
  bounds.box.add(light.position);
  return bounds;
}

LightBounds triangleBounds(const Scene& scene, const TriangleLight& light) {
  const Mesh& mesh = scene.meshes[indexOf(light.mesh)];
  const TriangleGeometry triangle = triangleGeometry(mesh, light.triangle);
  LightBounds bounds{.axes = {triangle.normal, 1, 0}, .twoSided = scene.materials[indexOf(mesh.material)].doubleSided};
  for (const Vec3& corner : triangle.corners) bounds.box.add(corner);
  return bounds;
}

/// Emission of a distant light does not spread past its axes.
LightBounds infiniteBounds(const Vec3& axis, float theta) {
  // The sine of the float next to π is negative, and the angle would be −π.
  return {.axes = {axis, std::cos(theta), std::max(0.0f, std::sin(theta))}, .cosThetaE = 1};
}

LightBounds boundsOf(const Lights& lights, LightId light) {
  const Scene& scene = lights.scene();
  const std::size_t i = lights.indexInKind(light);
  switch (lights.kind(light)) {
    case LightKind::kPoint:
      return pointBounds(scene.pointLights[i]);
    case LightKind::kSpot:
      return spotBounds(scene.spotLights[i]);
    case LightKind::kTriangle:
      return triangleBounds(scene, lights.triangles()[i]);
    case LightKind::kDirectional:
      return infiniteBounds(scene.directionalLights[i].axis, 0);
    case LightKind::kEnvironment:
      break;
  }
  const EnvironmentTile& tile = lights.environment()->tiles()[i];
  return infiniteBounds(-tile.axis, tile.halfAngle);
}

std::vector<LightBounds> boundsOfRange(const Lights& lights, std::size_t first, std::size_t last, int exponent) {
  std::vector<LightBounds> bounds(last - first);
  tbb::parallel_for(first, last, [&](std::size_t i) {
    LightBounds& b = bounds[i - first];
    const auto light = static_cast<LightId>(i);
    b = boundsOf(lights, light);
    b.intensity = static_cast<float>(std::ldexp(peakIntensity(lights, light), -exponent));
  });
  return bounds;
}

std::size_t localCount(const Lights& lights) {
  return lights.count(LightKind::kPoint) + lights.count(LightKind::kSpot) + lights.count(LightKind::kTriangle);
}

}  // namespace

Cone coneUnion(const Cone& a, const Cone& b) {
  // Angles and not cosines are compared: every cosine of less than 2.4e-4 rad is 1.
  const float angleOfA = std::atan2(a.sinTheta, a.cosTheta), angleOfB = std::atan2(b.sinTheta, b.cosTheta);
  const bool aIsWide = angleOfA >= angleOfB;
  const Cone& wide = aIsWide ? a : b;
  const Cone& narrow = aIsWide ? b : a;
  if (wide.cosTheta <= -1) return kAllDirections;
  const float between = std::atan2(glm::length(glm::cross(wide.axis, narrow.axis)), glm::dot(wide.axis, narrow.axis));
  const float wideAngle = std::max(angleOfA, angleOfB), narrowAngle = std::min(angleOfA, angleOfB);
  if (between + narrowAngle <= wideAngle) return wide;
  const float angle = 0.5f * (wideAngle + between + narrowAngle);
  // Opposite axes have no plane to turn in; any cone around both is all directions or nearly so.
  const Vec3 across = narrow.axis - glm::dot(narrow.axis, wide.axis) * wide.axis;
  const float acrossLength = glm::length(across);
  if (angle >= kPi || !(acrossLength > 0)) return kAllDirections;
  const float turn = angle - wideAngle;
  const Vec3 axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) / acrossLength * across);
  return {axis, std::cos(angle), std::sin(angle)};
}

LightBounds merge(const LightBounds& a, const LightBounds& b) {
  LightBounds result = a;
  result.box.add(b.box);
  result.axes = coneUnion(a.axes, b.axes);
  result.cosThetaE = std::min(a.cosThetaE, b.cosThetaE);
  result.intensity = a.intensity + b.intensity;
  result.twoSided = a.twoSided || b.twoSided;
  return result;
}

double peakIntensity(const Lights& lights, LightId light) {
  const Scene& scene = lights.scene();
  const std::size_t i = lights.indexInKind(light);
  switch (lights.kind(light)) {
    case LightKind::kPoint:
      return scalarEmission(scene.pointLights[i].intensity);
    case LightKind::kSpot:
      return scalarEmission(scene.spotLights[i].intensity);
    case LightKind::kTriangle: {
      const TriangleLight& t = lights.triangles()[i];
      return static_cast<double>(t.meanRadiance) * triangleGeometry(scene.meshes[indexOf(t.mesh)], t.triangle).area;
    }
    case LightKind::kDirectional:
      return scalarEmission(scene.directionalLights[i].irradiance);
    case LightKind::kEnvironment:
      break;
  }
  return lights.environment()->tiles()[i].weight;
}

std::vector<LightBounds> localBounds(const Lights& lights, int exponent) {
  return boundsOfRange(lights, 0, localCount(lights), exponent);
}

std::vector<LightBounds> distantBounds(const Lights& lights, int exponent) {
  return boundsOfRange(lights, localCount(lights), lights.size(), exponent);
}

int intensityExponent(const Lights& lights) {
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += peakIntensity(lights, static_cast<LightId>(i));
  return sum > 0 ? std::ilogb(sum) : 0;
}

}  // namespace cellcut
