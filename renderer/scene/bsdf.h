/// \file bsdf.h
/// Lambert under GGX: the metallic-roughness model of glTF 2.0.
///
/// Directions are unit, in the shading frame (z = shading normal), and point away from the surface. Both must be above
/// it; there is no transmission.
#pragma once

#include "renderer/base/capabilities.h"
#include "renderer/scene/ggx_albedo.h"

#include <optional>

namespace cellcut {

struct BsdfSample {
  Vec3 wi;
  Vec3 value;  ///< f, 1/sr
  float pdf;   ///< over solid angle, of both lobes together
};

/// What the material gives at a point.
struct BsdfParameters {
  Vec3 diffuse{0.0f};      ///< albedo of the Lambertian base, already times 1 − metallic
  Vec3 f0{0.0f};           ///< reflectance at normal incidence
  float f90 = 0;           ///< and at grazing
  float dielectricF0 = 0;  ///< of the dielectric layer alone, largest channel: what the base does not get
  float dielectricF90 = 0;
  float roughness = 1;  ///< [0, 1]
};

class Bsdf {
 public:
  explicit Bsdf(const BsdfParameters& parameters);

  struct Value {
    Vec3 value{0.0f};  ///< f(wo, wi), 1/sr
    float pdf = 0;     ///< with which sample() finds wi
  };
  /// Both 0 when a direction is below the surface.
  Value eval(const Vec3& wo, const Vec3& wi) const;
  /// Nothing when the sampled direction is below the surface or reflects nothing.
  /// \param uLobe chooses between base and reflection
  std::optional<BsdfSample> sample(const Vec3& wo, float uLobe, Vec2 u) const;
  /// The reflection's part of all that is reflected towards wo, by albedos; [0, 1].
  float reflectionShare(const Vec3& wo) const { return reflects() ? reflectionShare(albedo_(wo.z)) : 0.0f; }
  float alpha() const { return alpha_; }

 private:
  bool reflects() const { return kCanHaveGgx && reflects_; }
  /// \param albedo  GgxAlbedo of the direction
  float reflectionShare(Vec2 albedo) const;
  float reflectionProbability(Vec2 albedo) const;

  Vec3 diffuse_;  ///< scaled: see the constructor
  Vec3 f0_;
  float f90_;
  Vec2 layer_;  ///< F0 and F90 of the dielectric alone
  GgxAlbedo albedo_;
  float alpha_;
  bool reflects_;  ///< false: exactly Lambertian
};

}  // namespace cellcut
