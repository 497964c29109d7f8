#include "renderer/scene/bsdf.h"

#include "renderer/base/warp.h"

namespace cellcut {
namespace {

/// Smallest GGX α. Below it the lobe is narrower than the half vectors that float directions can express (10⁻⁷ against
/// α² = 10⁻⁶).
constexpr float kMinAlpha = 1e-3f;

float square(float x) {
  return x * x;
}

/// Trowbridge–Reitz density of microfacet normals. Source: Walter et al. 2007, written without a tangent so that it is
/// precise at α = kMinAlpha.
float ggxD(float alpha, const Vec3& h) {
  const float e = (h.x * h.x + h.y * h.y) / square(alpha) + h.z * h.z;
  return kInvPi / (square(alpha) * square(e));
}

float ggxLambda(float alpha, const Vec3& w) {
  const float a2 = square(alpha) * (w.x * w.x + w.y * w.y) / square(w.z);
  return 0.5f * (std::sqrt(1 + a2) - 1);
}

/// Normal visible from wo. Source: Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4).
Vec3 sampleVisibleNormal(float alpha, const Vec3& wo, Vec2 u) {
  const Vec3 stretched = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const bool tilted = stretched.x != 0 || stretched.y != 0;
  const Vec3 horizontal = tilted ? glm::normalize(Vec3(-stretched.y, stretched.x, 0)) : Vec3(1, 0, 0);
  const Vec3 vertical = glm::cross(stretched, horizontal);
  const float s = 0.5f * (1 + stretched.z);
  Vec2 d = concentricDisk(u);
  d.y = (1 - s) * safeSqrt(1 - d.x * d.x) + s * d.y;
  const Vec3 h = d.x * horizontal + d.y * vertical + safeSqrt(1 - d.x * d.x - d.y * d.y) * stretched;
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(0.0f, h.z)));
}

}  // namespace

// The base gets what the layer lets through, so that a white base under any layer reflects everything once:
// f = albedo/π · (1 − F(wo)) (1 − F(wi)) / (1 − F̄), with Schlick's F and its cosine-weighted mean F̄ = F0 + (F90 − F0)
// / 21. Source: Kelemen and Szirmay-Kalos 2001, equation 6.
Bsdf::Bsdf(const BsdfParameters& p)
    : diffuse_(p.diffuse * kInvPi),
      f0_(p.f0),
      f90_(p.f90),
      dielectricF0_(p.dielectricF0),
      dielectricF90_(p.dielectricF90),
      alpha_(std::max(kMinAlpha, square(p.roughness))),
      reflects_(p.f90 > 0 || !isBlack(p.f0)) {
  const float mean = p.dielectricF0 + (p.dielectricF90 - p.dielectricF0) / 21;
  diffuse_ *= mean < 1 ? 1 / (1 - mean) : 0.0f;
}

float Bsdf::reflectionProbability(const Vec3& wo) const {
  if (!reflects_) return 0;
  const float weight = schlickWeight(wo.z);
  const float reflection = luminance(f0_) + (f90_ - luminance(f0_)) * weight;
  const float base = luminance(diffuse_) * kPi * (1 - (dielectricF0_ + (dielectricF90_ - dielectricF0_) * weight));
  return base > 0 ? std::clamp(reflection / (reflection + base), 0.1f, 0.9f) : 1.0f;
}

Bsdf::Value Bsdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z > 0 && wi.z > 0)) return {};
  if (!reflects_) return {diffuse_, wi.z * kInvPi};
  const float out = 1 - (dielectricF0_ + (dielectricF90_ - dielectricF0_) * schlickWeight(wo.z));
  const float in = 1 - (dielectricF0_ + (dielectricF90_ - dielectricF0_) * schlickWeight(wi.z));
  const Vec3 h = glm::normalize(wo + wi);
  const Vec3 fresnel = f0_ + (Vec3(f90_) - f0_) * schlickWeight(glm::dot(wo, h));
  const float d = ggxD(alpha_, h);
  const float lambdaOut = ggxLambda(alpha_, wo);
  // Height-correlated masking and shadowing (Heitz 2014).
  const float reflection = d / (4 * wo.z * wi.z * (1 + lambdaOut + ggxLambda(alpha_, wi)));
  const float reflectionPdf = d / (4 * wo.z * (1 + lambdaOut));
  const float q = reflectionProbability(wo);
  return {diffuse_ * (out * in) + fresnel * reflection, (1 - q) * wi.z * kInvPi + q * reflectionPdf};
}

std::optional<BsdfSample> Bsdf::sample(const Vec3& wo, float uLobe, Vec2 u) const {
  if (!(wo.z > 0)) return std::nullopt;
  Vec3 wi;
  if (uLobe < reflectionProbability(wo)) {
    const Vec3 h = sampleVisibleNormal(alpha_, wo, u);
    wi = 2 * glm::dot(wo, h) * h - wo;
  } else {
    wi = cosineHemisphere(u);
  }
  const auto [value, pdf] = eval(wo, wi);
  if (!(pdf > 0) || isBlack(value)) return std::nullopt;
  return BsdfSample{wi, value, pdf};
}

}  // namespace cellcut
