#include "ui/overlays/light_contribution.h"

#include "renderer/base/rng.h"
#include "renderer/lights/scalar_emission.h"

namespace cellcut {
namespace {

/// 1 where the sample's light arrives, else 0. Partly covered surfaces let through what a hash of light and sample says.
double visibility(const Accel& accel, const LightSample& sample, const FirstHit& at, std::uint32_t seed) {
  if (!(glm::dot(sample.wi, at.geometricNormal) > 0)) return 0;
  const Vec3 origin = offsetRayOrigin(at.point.p, at.error, at.geometricNormal, sample.wi);
  const Ray ray = sample.distant ? Ray{origin, sample.wi} : shadowRay(origin, sample.end);
  return accel.occluded(ray, seed) ? 0 : 1;
}

double cosineOf(const LightSample& sample, const Vec3& n) {
  return std::max(0.0, glm::dot(glm::dvec3(sample.wi), glm::dvec3(n)));
}

/// Whether Lights::irradiance() is exact for it.
bool hasExactIrradiance(const Lights& lights, LightId light) {
  if (lights.kind(light) == LightKind::kEnvironment) return false;
  if (lights.kind(light) != LightKind::kTriangle) return true;
  const Scene& scene = lights.scene();
  const TriangleLight& triangle = lights.triangles()[lights.indexInKind(light)];
  const Material& material = scene.materials[indexOf(scene.meshes[indexOf(triangle.mesh)].material)];
  return !material.slot(TextureUse::kEmission).texture && material.alphaMode == AlphaMode::kOpaque;
}

}  // namespace

Contribution contributionOf(const Lights& lights, const Accel& accel, LightId light, const FirstHit& at,
                            int samplesPerSide) {
  const LightKind kind = lights.kind(light);
  const bool hasExtent = kind == LightKind::kTriangle || kind == LightKind::kEnvironment;
  const int perSide = hasExtent ? samplesPerSide : 1;
  glm::dvec3 unoccluded(0), visible(0);
  for (int i = 0; i < perSide * perSide; ++i) {
    const Vec2 u = (Vec2(i % perSide, i / perSide) + Vec2(0.5f)) / static_cast<float>(perSide);
    const std::optional<LightSample> sample = lights.sample(light, at.point.p, u);
    if (!sample) continue;
    const double cosine = cosineOf(*sample, at.point.n);
    if (cosine == 0) continue;
    const glm::dvec3 value = glm::dvec3(sample->radiance) * cosine / static_cast<double>(sample->pdf);
    unoccluded += value;
    const auto seed = static_cast<std::uint32_t>(hashOf(static_cast<std::uint64_t>(light), i));
    if (value != glm::dvec3(0)) visible += value * visibility(accel, *sample, at, seed);
  }
  const double samples = static_cast<double>(perSide) * perSide;
  const Contribution sum{scalarEmission(unoccluded) / samples, scalarEmission(visible) / samples};
  if (!hasExactIrradiance(lights, light)) return sum;
  const double exact = lights.irradiance(light, at.point.p, at.point.n);
  return {exact, sum.unoccluded > 0 ? exact * (sum.visible / sum.unoccluded) : 0};
}

}  // namespace cellcut
