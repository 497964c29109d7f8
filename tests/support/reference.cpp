#include "tests/support/reference.h"

#include "renderer/base/warp.h"
#include "renderer/scene/material.h"

namespace cellcut::test {
namespace {

using DVec3 = glm::dvec3;

double spotFalloff(const SpotLight& spot, double cosine) {
  const double t = (cosine - spot.cosOuter) / (static_cast<double>(spot.cosInner) - spot.cosOuter);
  const double clamped = std::clamp(t, 0.0, 1.0);
  return clamped * clamped;
}

/// Where light is gathered, and what may hide the lights from it.
struct Place {
  Vec3 p;
  Vec3 n;
  const Accel* occluders;

  /// Share of what leaves p + d that arrives at p: 0 or 1. The ray starts a millionth off p, ten roundings of a float
  /// there (farther off, shadows of other facets would have moved), and stops a ten-thousandth of its length before the
  /// light. It is aimed from where it starts: parallel to d it would end behind a light that is seen at a grazing
  /// angle.
  double visibility(const DVec3& d) const { return !occluders || !blocked(d - kOffset * DVec3(n), 0.9999f) ? 1 : 0; }
  /// The same for what comes from infinity.
  double visibilityTowards(const DVec3& direction) const {
    return !occluders || !blocked(direction, kInfinity) ? 1 : 0;
  }

 private:
  static constexpr double kOffset = 1e-6;
  bool blocked(const DVec3& along, float end) const {
    return occluders->occluded({Vec3(DVec3(p) + kOffset * DVec3(n)), Vec3(along), end}, 0);
  }
};

/// intensity · cos / d² from a position.
DVec3 positional(const Vec3& position, const DVec3& intensity, const Place& place) {
  const DVec3 d = DVec3(position) - DVec3(place.p);
  const double squared = glm::dot(d, d);
  return intensity * place.visibility(d) * std::max(0.0, glm::dot(d, DVec3(place.n))) / (squared * std::sqrt(squared));
}

DVec3 spotIrradiance(const SpotLight& spot, const Place& place) {
  const DVec3 away = glm::normalize(DVec3(place.p) - DVec3(spot.position));
  return spotFalloff(spot, glm::dot(away, DVec3(spot.axis))) * positional(spot.position, DVec3(spot.intensity), place);
}

/// Midpoint rule over resolution² congruent parts.
DVec3 triangleIrradiance(const Mesh& mesh, std::uint32_t index, const Material& material, const Place& place,
                         int resolution) {
  const Triangle& t = mesh.triangles[index];
  const DVec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const DVec3 cross = glm::cross(b - a, c - a);
  double sum = 0;
  for (int i = 0; i < resolution; ++i) {
    for (int j = 0; j < 2 * (resolution - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const DVec3 q = a + (b - a) * ((i + third) / resolution) + (c - a) * ((j / 2 + third) / resolution);
      const DVec3 d = q - DVec3(place.p);
      const double away = -glm::dot(d, cross), squared = glm::dot(d, d);
      const double emitted = material.doubleSided ? std::abs(away) : std::max(0.0, away);
      const double cosines = std::max(0.0, glm::dot(d, DVec3(place.n))) * emitted;
      if (cosines > 0) sum += place.visibility(d) * cosines / (squared * squared);
    }
  }
  // |cross| / 2 is the area and is already in `away` once.
  return DVec3(material.emission) * sum * 0.5 / (static_cast<double>(resolution) * resolution);
}

/// Over the texels of one tile, each in resolution² cells of equal longitude and latitude.
DVec3 tileIrradiance(const EnvironmentLight& light, std::size_t tile, const Place& place, int resolution) {
  const Environment& environment = light.environment();
  const EnvironmentTile& t = light.tiles()[tile];
  const std::uint32_t size = 1u << t.level;
  const int width = environment.radiance.width(), height = environment.radiance.height();
  constexpr double pi = std::numbers::pi;
  DVec3 sum(0);
  const auto last = [&](std::uint32_t first, int limit) {
    return std::min(static_cast<int>((first + 1) * size), limit) * resolution;
  };
  for (int y = static_cast<int>(t.y * size) * resolution; y < last(t.y, height); ++y) {
    const double v = (y + 0.5) / (height * resolution);
    const double solidAngle =
        4 * pi / (width * resolution) * std::sin(pi * v) * std::sin(pi * 0.5 / (height * resolution));
    for (int x = static_cast<int>(t.x * size) * resolution; x < last(t.x, width); ++x) {
      const double azimuth =
          2 * pi * ((x + 0.5) / (width * resolution) - 0.5) - static_cast<double>(environment.rotation);
      const DVec3 direction(std::sin(pi * v) * std::cos(azimuth), std::cos(pi * v),
                            std::sin(pi * v) * std::sin(azimuth));
      const double cosine = glm::dot(direction, DVec3(place.n));
      if (cosine <= 0) continue;
      sum += referenceEnvironment(environment, direction) * (solidAngle * cosine * place.visibilityTowards(direction));
    }
  }
  return sum;
}

}  // namespace

DVec3 referenceEnvironment(const Environment& environment, const DVec3& direction) {
  constexpr double pi = std::numbers::pi;
  const int width = environment.radiance.width(), height = environment.radiance.height();
  const double turns =
      (std::atan2(direction.z, direction.x) + static_cast<double>(environment.rotation)) / (2 * pi) + 0.5;
  const double x = (turns - std::floor(turns)) * width - 0.5;
  const double y = std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * height - 0.5;
  const auto texel = [&](double column, double row) {
    const int c = (static_cast<int>(column) % width + width) % width;
    return DVec3(environment.radiance.at(c, std::clamp(static_cast<int>(row), 0, height - 1)));
  };
  const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  return (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
         fy * ((1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
}

DVec3 referenceIrradiance(const Lights& lights, LightId light, const Vec3& p, const Vec3& n, int resolution,
                          const Accel* occluders) {
  const Scene& scene = lights.scene();
  const std::size_t i = lights.indexInKind(light);
  const Place place{p, n, occluders};
  switch (lights.kind(light)) {
    case LightKind::kPoint:
      return positional(scene.pointLights[i].position, DVec3(scene.pointLights[i].intensity), place);
    case LightKind::kSpot:
      return spotIrradiance(scene.spotLights[i], place);
    case LightKind::kTriangle: {
      const TriangleLight& triangle = lights.triangles()[i];
      const Mesh& mesh = scene.meshes[indexOf(triangle.mesh)];
      return triangleIrradiance(mesh, triangle.triangle, scene.materials[indexOf(mesh.material)], place, resolution);
    }
    case LightKind::kDirectional: {
      const DirectionalLight& directional = scene.directionalLights[i];
      const DVec3 d = -DVec3(directional.axis);
      return DVec3(directional.irradiance) * std::max(0.0, glm::dot(d, DVec3(n))) * place.visibilityTowards(d);
    }
    case LightKind::kEnvironment:
      return tileIrradiance(*lights.environment(), i, place, resolution);
  }
  return DVec3(0);
}

struct ReferenceTracer::Vertex {
  Vec3 p;
  Vec3 error;
  Vec3 normal;  ///< geometric, on the side of wo
  Frame frame;
  Vec3 wo;
  Bsdf bsdf;

  Vec3 reflected(const Vec3& direction) const {
    const Vec3 wi = frame.toLocal(direction);
    return wi.z > 0 && glm::dot(direction, normal) > 0 ? bsdf.eval(wo, wi).value * wi.z : Vec3(0);
  }
};

/// Whether a ray gets to `distance`; it stops a ten-thousandth before, which no geometry of the tests comes near.
bool ReferenceTracer::visible(const Vertex& vertex, const Vec3& direction, float distance, Rng& random) const {
  const Vec3 origin = offsetRayOrigin(vertex.p, vertex.error, vertex.normal, direction);
  return !accel_.occluded({origin, direction, 0.9999f * distance}, static_cast<std::uint32_t>(random.bits()));
}

Vec3 ReferenceTracer::punctualLight(const Vertex& vertex, Rng& random) const {
  Vec3 sum(0);
  const auto add = [&](const Vec3& position, const Vec3& intensity, const auto& falloff) {
    const Vec3 d = position - vertex.p;
    const float distance = glm::length(d);
    const Vec3 direction = d / distance;
    const Vec3 arriving = vertex.reflected(direction) * intensity * (falloff(-direction) / (distance * distance));
    if (!isBlack(arriving) && visible(vertex, direction, distance, random)) sum += arriving;
  };
  for (const PointLight& light : scene_.pointLights)
    add(light.position, light.intensity, [](const Vec3&) { return 1.0f; });
  for (const SpotLight& light : scene_.spotLights) {
    add(light.position, light.intensity, [&](const Vec3& away) {
      return static_cast<float>(spotFalloff(light, static_cast<double>(glm::dot(away, light.axis))));
    });
  }
  for (const DirectionalLight& light : scene_.directionalLights) {
    const Vec3 arriving = vertex.reflected(-light.axis) * light.irradiance;
    if (!isBlack(arriving) && visible(vertex, -light.axis, kInfinity, random)) sum += arriving;
  }
  return sum;
}

Vec3 ReferenceTracer::triangleLight(const Vertex& vertex, Rng& random) const {
  Vec3 sum(0);
  for (const Mesh& mesh : scene_.meshes) {
    const Material& material = scene_.materials[indexOf(mesh.material)];
    if (isBlack(material.emission)) continue;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle& t = mesh.triangles[i];
      const Vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      float u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 d = (1 - u - v) * a + u * b + v * c - vertex.p;
      const float distance = glm::length(d);
      const Vec3 direction = d / distance;
      float cosine = -0.5f * glm::dot(glm::cross(b - a, c - a), direction);  // times the area
      if (material.doubleSided) cosine = std::abs(cosine);
      if (!(cosine > 0)) continue;
      const SurfaceCoordinates at{&mesh, i, {u, v}};
      const Vec3 arriving =
          vertex.reflected(direction) * emission(scene_, at) * (coverage(scene_, at) * cosine / (distance * distance));
      if (!isBlack(arriving) && visible(vertex, direction, distance, random)) sum += arriving;
    }
  }
  return sum;
}

Vec3 ReferenceTracer::environmentLight(const Vertex& vertex, Rng& random) const {
  if (!scene_.environment) return Vec3(0);
  const Vec3 local = cosineHemisphere({random.uniform(), random.uniform()});
  if (!(local.z > 0)) return Vec3(0);
  const Vec3 direction = glm::normalize(vertex.frame.toWorld(local));
  const Vec3 weight = vertex.reflected(direction) * (kPi / local.z);
  if (isBlack(weight) || !visible(vertex, direction, kInfinity, random)) return Vec3(0);
  return weight * Vec3(referenceEnvironment(*scene_.environment, glm::dvec3(direction)));
}

Vec3 ReferenceTracer::directLight(const Vertex& vertex, Rng& random) const {
  return punctualLight(vertex, random) + triangleLight(vertex, random) + environmentLight(vertex, random);
}

Vec3 ReferenceTracer::trace(Ray ray, int maxDepth, Rng& random) const {
  Vec3 radiance(0), throughput(1);
  for (int depth = 0;; ++depth) {
    const std::optional<Hit> hit = accel_.intersect(ray, static_cast<std::uint32_t>(random.bits()));
    if (!hit) {
      if (depth == 0 && scene_.environment) {
        radiance += Vec3(referenceEnvironment(*scene_.environment, glm::dvec3(glm::normalize(ray.direction))));
      }
      return radiance;
    }
    const Mesh& mesh = scene_.meshes[indexOf(hit->mesh)];
    const Material& material = scene_.materials[indexOf(mesh.material)];
    const Triangle& t = mesh.triangles[hit->triangle];
    const std::array<Vec3, 3> v{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const Vec3 front = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
    const bool fromFront = glm::dot(front, ray.direction) < 0;
    const SurfaceCoordinates at{&mesh, hit->triangle, hit->barycentric};
    if (depth == 0 && (fromFront || material.doubleSided)) radiance += emission(scene_, at);
    if (depth == maxDepth) return radiance;

    const Vec3 normal = fromFront ? front : -front;
    Vec3 shading = shadingNormal(scene_, at, normal);
    if (glm::dot(shading, ray.direction) >= 0) shading = normal;
    const Frame frame(shading);
    const Vec3 p =
        (1 - hit->barycentric.x - hit->barycentric.y) * v[0] + hit->barycentric.x * v[1] + hit->barycentric.y * v[2];
    const Vertex vertex{p,     triangleError(v[0], v[1], v[2]), normal,
                        frame, frame.toLocal(-ray.direction),   bsdfAt(scene_, at)};
    radiance += throughput * directLight(vertex, random);

    const std::optional<BsdfSample> next =
        vertex.bsdf.sample(vertex.wo, random.uniform(), {random.uniform(), random.uniform()});
    if (!next) return radiance;
    const Vec3 direction = glm::normalize(frame.toWorld(next->wi));
    if (glm::dot(direction, normal) <= 0) return radiance;
    throughput *= next->value * (next->wi.z / next->pdf);
    ray = {offsetRayOrigin(p, vertex.error, normal, direction), direction};
  }
}

}  // namespace cellcut::test
