/// \file lights.h
/// All light sources of a scene as one numbered set, each with its measures and ways to sample it.
///
/// Numbers run kind by kind: point, spot, triangle, directional, environment tiles; a kind that the scene does not have
/// takes no number, no memory and no time. Units: metres, W, sr. Threads: const members may run concurrently.
#pragma once

#include "renderer/lights/environment_light.h"
#include "renderer/lights/triangle_light.h"
#include "renderer/scene/scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cellcut {

enum class LightId : std::uint32_t {};

enum class LightKind : std::uint8_t { kPoint, kSpot, kTriangle, kDirectional, kEnvironment };
inline constexpr std::size_t kLightKinds = 5;

struct LightCounts {
  std::size_t point = 0;
  std::size_t spot = 0;
  std::size_t triangle = 0;
  std::size_t directional = 0;
  std::size_t environment = 0;  ///< tiles
};

/// Light arriving at a point from one light, before visibility.
struct LightSample {
  Vec3 radiance;  ///< W/(m² sr), or for delta lights W/m² across wi
  Vec3 wi;        ///< unit, towards the light
  float pdf;      ///< density over solid angle of wi given the light; 1 for delta lights
  bool delta;     ///< a direction that no BSDF sample can find: MIS weight 1
  bool distant;   ///< at infinity: `end` is not set
  Vec3 end;       ///< where a shadow ray to the light must reach, already off the light's surface
};

class Lights {
 public:
  /// Parallel over triangles. The scene must outlive the lights.
  explicit Lights(const Scene& scene);

  std::size_t size() const { return first_[kLightKinds]; }
  std::size_t count(LightKind kind) const {
    const auto k = static_cast<std::size_t>(kind);
    return first_[k + 1] - first_[k];
  }
  LightCounts counts() const {
    return {count(LightKind::kPoint), count(LightKind::kSpot), count(LightKind::kTriangle),
            count(LightKind::kDirectional), count(LightKind::kEnvironment)};
  }
  LightKind kind(LightId light) const;
  /// Position of a light among those of its kind.
  std::size_t indexInKind(LightId light) const;
  LightId idOf(LightKind kind, std::size_t index) const {
    return static_cast<LightId>(first_[static_cast<std::size_t>(kind)] + index);
  }

  /// A point or a direction on one light, as seen from `p`; nothing when the light sends nothing there (behind a
  /// one-sided triangle, outside a spot's cone, black texel) or p lies on the light.
  std::optional<LightSample> sample(LightId light, const Vec3& p, Vec2 u) const;

  /// Whether p is the very position of a point or spot light, where its light is not defined.
  bool liesAt(LightId light, const Vec3& p) const;

  /// The triangle light at a hit, if that triangle is one.
  std::optional<LightId> lightAt(MeshId mesh, std::uint32_t triangle) const;
  /// The tile that a point of the environment's picture falls into; nothing where it is black.
  std::optional<LightId> environmentLightAt(Vec2 uv) const;
  /// Density over solid angle at `p` with which sample() finds point `q` of a triangle light.
  float trianglePdf(LightId light, const Vec3& p, const Vec3& q) const;
  /// Density over solid angle with which sample() finds the direction of a point of the environment's picture in its
  /// tile.
  float environmentPdf(LightId light, Vec2 uv) const;

  /// Emitted power (scalar emission), W; directional lights and tiles count what falls on a disk of the scene's radius.
  double flux(LightId light) const;
  /// Unoccluded irradiance (scalar emission, W/m²) at a point with unit normal n: exact for point, spot, directional
  /// lights and for triangles of uniform radiance (the mean is taken), a bound for tiles. > 0 wherever the light can
  /// contribute.
  double irradiance(LightId light, const Vec3& p, const Vec3& n) const;
  /// The same of one triangle light, W/m², to be asked many times. \pre the light is a triangle
  TriangleEmitter triangleEmitter(LightId light) const;

  const Scene& scene() const { return scene_; }
  const std::vector<TriangleLight>& triangles() const { return triangles_; }
  const EnvironmentLight* environment() const { return environment_ ? &*environment_ : nullptr; }
  std::size_t bytes() const;

 private:
  std::optional<LightSample> sampleDistant(LightKind kind, std::size_t index, Vec2 u) const;

  const Scene& scene_;
  std::vector<TriangleLight> triangles_;  ///< ordered by mesh and triangle
  std::optional<EnvironmentLight> environment_;
  std::array<std::uint32_t, kLightKinds + 1> first_{};  ///< first LightId of each kind, and the number of all
};

}  // namespace cellcut
