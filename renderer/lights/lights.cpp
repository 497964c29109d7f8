#include "renderer/lights/lights.h"

#include "renderer/base/capabilities.h"
#include "renderer/base/ray.h"
#include "renderer/lights/scalar_emission.h"
#include "renderer/scene/material.h"

#include <cassert>

namespace cellcut {
namespace {

/// KHR_lights_punctual's falloff, [0, 1].
float spotFalloff(const SpotLight& spot, float cosine) {
  const float t = std::clamp((cosine - spot.cosOuter) / (spot.cosInner - spot.cosOuter), 0.0f, 1.0f);
  return t * t;
}

/// A delta light at a position: intensity / d². The division is in two steps, so that neither d² nor the quotient
/// leaves the range of a float while the result is in it.
std::optional<LightSample> samplePosition(const Vec3& position, const Vec3& intensity, const Vec3& p) {
  const Vec3 d = position - p;
  const float distance = glm::length(d);
  if (!(distance > 0)) return std::nullopt;
  return LightSample{.radiance = intensity / distance / distance,
                     .wi = d / distance,
                     .pdf = 1,
                     .delta = true,
                     .distant = false,
                     .end = position};
}

std::optional<LightSample> sampleSpot(const SpotLight& spot, const Vec3& p) {
  auto sample = samplePosition(spot.position, spot.intensity, p);
  if (!sample) return sample;
  const float falloff = spotFalloff(spot, -glm::dot(sample->wi, spot.axis));
  if (falloff == 0) return std::nullopt;
  sample->radiance *= falloff;
  return sample;
}

std::optional<LightSample> sampleTriangleLight(const Scene& scene, const TriangleLight& light, const Vec3& p, Vec2 u) {
  const Mesh& mesh = scene.meshes[indexOf(light.mesh)];
  const Material& material = scene.materials[indexOf(mesh.material)];
  const TriangleGeometry triangle = triangleGeometry(mesh, light.triangle);
  if (!emitsTowards(triangle, material.doubleSided, p)) return std::nullopt;
  const std::optional<TrianglePoint> point = sampleTriangle(triangle, p, u);
  if (!point) return std::nullopt;

  const SurfaceCoordinates at{&mesh, light.triangle, point->barycentric};
  Vec3 radiance = emission(scene, at);
  if (kCanHaveAlpha && material.alphaMode != AlphaMode::kOpaque) radiance *= coverage(scene, at);
  if (isBlack(radiance)) return std::nullopt;
  const Vec3 toLight = point->position - p;
  const Vec3 error = triangleError(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
  return LightSample{.radiance = radiance,
                     .wi = glm::normalize(toLight),
                     .pdf = point->pdf,
                     .delta = false,
                     .distant = false,
                     .end = offsetRayOrigin(point->position, error, triangle.normal, -toLight)};
}

double cosineAt(const Vec3& n, const glm::dvec3& direction) {
  return std::max(0.0, glm::dot(glm::dvec3(n), direction));
}

/// ∫ falloff dω over a spot's cone: the plateau, and the quadratic ramp in cosθ.
double spotSolidAngle(const SpotLight& spot) {
  const double inner = spot.cosInner, outer = spot.cosOuter;
  return 2 * std::numbers::pi * ((1 - inner) + (inner - outer) / 3);
}

}  // namespace

Lights::Lights(const Scene& scene) : scene_(scene), triangles_(collectTriangleLights(scene)) {
  if (scene.environment) {
    environment_.emplace(*scene.environment);
    if (environment_->tiles().empty()) environment_.reset();
  }
  const std::array<std::size_t, kLightKinds> counts{scene.pointLights.size(), scene.spotLights.size(),
                                                    triangles_.size(), scene.directionalLights.size(),
                                                    environment_ ? environment_->tiles().size() : 0};
  std::size_t sum = 0;
  for (std::size_t kind = 0; kind < kLightKinds; ++kind) {
    sum += counts[kind];
    assert(sum <= std::numeric_limits<std::uint32_t>::max());
    first_[kind + 1] = static_cast<std::uint32_t>(sum);
  }
}

LightKind Lights::kind(LightId light) const {
  const auto id = static_cast<std::uint32_t>(light);
  assert(id < size());
  std::size_t kind = 0;
  while (id >= first_[kind + 1]) kind += !kCanHaveSpots && kind == 0 ? 2 : 1;
  return static_cast<LightKind>(kind);
}

std::size_t Lights::indexInKind(LightId light) const {
  return static_cast<std::uint32_t>(light) - first_[static_cast<std::size_t>(kind(light))];
}

std::optional<LightSample> Lights::sample(LightId light, const Vec3& p, Vec2 u) const {
  const LightKind k = kind(light);
  const std::size_t i = indexInKind(light);
  switch (k) {
    case LightKind::kPoint:
      return samplePosition(scene_.pointLights[i].position, scene_.pointLights[i].intensity, p);
    case LightKind::kSpot:
      if constexpr (!kCanHaveSpots) break;
      return sampleSpot(scene_.spotLights[i], p);
    case LightKind::kTriangle:
      return sampleTriangleLight(scene_, triangles_[i], p, u);
    case LightKind::kDirectional:
    case LightKind::kEnvironment:
      break;
  }
  return sampleDistant(k, i, u);
}

std::optional<LightSample> Lights::sampleDistant(LightKind kind, std::size_t index, Vec2 u) const {
  LightSample sample{.radiance = Vec3(0), .wi = Vec3(0), .pdf = 1, .delta = true, .distant = true, .end = Vec3(0)};
  if constexpr (!kCanHaveDistantLights) return std::nullopt;
  if (!kCanHaveEnvironment || kind == LightKind::kDirectional) {
    const DirectionalLight& light = scene_.directionalLights[index];
    sample.radiance = light.irradiance;
    sample.wi = -light.axis;
    return sample;
  }
  const EnvironmentLight::Sample direction = environment_->sample(index, u);
  sample.radiance = environmentRadiance(environment_->environment(), direction.uv);
  sample.wi = direction.direction;
  sample.pdf = direction.pdf;
  sample.delta = false;
  // The density of a texel of less than 10⁻⁴⁵ of its tile is none: no float holds it.
  if (isBlack(sample.radiance) || !(sample.pdf > 0)) return std::nullopt;
  return sample;
}

bool Lights::liesAt(LightId light, const Vec3& p) const {
  const std::size_t i = indexInKind(light);
  if (kind(light) == LightKind::kPoint) return scene_.pointLights[i].position == p;
  return kind(light) == LightKind::kSpot && scene_.spotLights[i].position == p;
}

std::optional<LightId> Lights::lightAt(MeshId mesh, std::uint32_t triangle) const {
  const auto before = [](const TriangleLight& light, std::pair<MeshId, std::uint32_t> key) {
    return std::pair(light.mesh, light.triangle) < key;
  };
  const auto found = std::lower_bound(triangles_.begin(), triangles_.end(), std::pair(mesh, triangle), before);
  if (found == triangles_.end() || found->mesh != mesh || found->triangle != triangle) return std::nullopt;
  return idOf(LightKind::kTriangle, static_cast<std::size_t>(found - triangles_.begin()));
}

std::optional<LightId> Lights::environmentLightAt(Vec2 uv) const {
  if (!environment_) return std::nullopt;
  const std::optional<std::size_t> tile = environment_->tileAt(uv);
  if (!tile) return std::nullopt;
  return idOf(LightKind::kEnvironment, *tile);
}

float Lights::trianglePdf(LightId light, const Vec3& p, const Vec3& q) const {
  const TriangleLight& t = triangles_[indexInKind(light)];
  return cellcut::trianglePdf(triangleGeometry(scene_.meshes[indexOf(t.mesh)], t.triangle), p, q);
}

float Lights::environmentPdf(LightId light, Vec2 uv) const {
  return environment_->pdf(indexInKind(light), uv);
}

double Lights::flux(LightId light) const {
  constexpr double pi = std::numbers::pi;
  const std::size_t i = indexInKind(light);
  const double radius = scene_.bounds.radius();
  switch (kind(light)) {
    case LightKind::kPoint:
      return 4 * pi * scalarEmission(scene_.pointLights[i].intensity);
    case LightKind::kSpot:
      return spotSolidAngle(scene_.spotLights[i]) * scalarEmission(scene_.spotLights[i].intensity);
    case LightKind::kTriangle: {
      const Mesh& mesh = scene_.meshes[indexOf(triangles_[i].mesh)];
      const double sides = scene_.materials[indexOf(mesh.material)].doubleSided ? 2 : 1;
      return sides * pi * triangles_[i].meanRadiance * triangleGeometry(mesh, triangles_[i].triangle).area;
    }
    case LightKind::kDirectional:
      return scalarEmission(scene_.directionalLights[i].irradiance) * pi * radius * radius;
    case LightKind::kEnvironment:
      return environment_->tiles()[i].weight * pi * radius * radius;
  }
  return 0;
}

TriangleEmitter Lights::triangleEmitter(LightId light) const {
  assert(kind(light) == LightKind::kTriangle);
  const TriangleLight& triangle = triangles_[indexInKind(light)];
  const Mesh& mesh = scene_.meshes[indexOf(triangle.mesh)];
  return {triangleGeometry(mesh, triangle.triangle), triangle.meanRadiance,
          scene_.materials[indexOf(mesh.material)].doubleSided};
}

double Lights::irradiance(LightId light, const Vec3& p, const Vec3& n) const {
  const std::size_t i = indexInKind(light);
  const auto fromPosition = [&](const Vec3& position, const Vec3& intensity) {
    const glm::dvec3 d = glm::dvec3(position) - glm::dvec3(p);
    const double distance = glm::length(d);
    return distance > 0 ? scalarEmission(intensity) * cosineAt(n, d / distance) / distance / distance : 0.0;
  };
  switch (kind(light)) {
    case LightKind::kPoint:
      return fromPosition(scene_.pointLights[i].position, scene_.pointLights[i].intensity);
    case LightKind::kSpot: {
      const SpotLight& spot = scene_.spotLights[i];
      const Vec3 d = p - spot.position;
      const float distance = glm::length(d);
      if (!(distance > 0)) return 0;
      return fromPosition(spot.position, spot.intensity) * spotFalloff(spot, glm::dot(d / distance, spot.axis));
    }
    case LightKind::kTriangle:
      return triangleEmitter(light).irradiance(p, n);
    case LightKind::kDirectional: {
      const DirectionalLight& directional = scene_.directionalLights[i];
      return scalarEmission(directional.irradiance) * cosineAt(n, -glm::dvec3(directional.axis));
    }
    case LightKind::kEnvironment: {
      // The largest cosine that any direction of the tile can have; the margin is the rounding of its float cone.
      const EnvironmentTile& tile = environment_->tiles()[i];
      const double toAxis = std::acos(std::clamp<double>(glm::dot(glm::dvec3(n), glm::dvec3(tile.axis)), -1, 1));
      const double nearest = std::max(0.0, toAxis - static_cast<double>(tile.halfAngle) - 1e-6);
      return tile.weight * std::max(0.0, std::cos(nearest));
    }
  }
  return 0;
}

std::size_t Lights::bytes() const {
  return triangles_.capacity() * sizeof(TriangleLight) + (environment_ ? environment_->bytes() : 0);
}

}  // namespace cellcut
