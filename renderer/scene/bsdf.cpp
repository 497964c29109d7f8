#include "renderer/scene/bsdf.h"

#include "renderer/scene/ggx.h"

namespace cellcut {

// The base gets what the layer lets through, so that a white base under any layer reflects everything once:
// f = albedo/π · (1 − E(wo)) (1 − E(wi)) / (1 − Ē), with the layer's directional albedo E and its mean Ē. Source:
// Kelemen and Szirmay-Kalos 2001, equation 6.
Bsdf::Bsdf(const BsdfParameters& p)
    : diffuse_(p.diffuse * kInvPi),
      f0_(p.f0),
      f90_(p.f90),
      layer_(p.dielectricF0, p.dielectricF90),
      albedo_(p.roughness),
      alpha_(ggxAlpha(p.roughness)),
      reflects_(p.f90 > 0 || !isBlack(p.f0)) {
  if (!reflects()) return;
  const float mean = glm::dot(layer_, albedo_.mean());
  diffuse_ *= mean < 1 ? 1 / (1 - mean) : 0.0f;
}

float Bsdf::reflectionShare(Vec2 albedo) const {
  const float reflection = glm::dot(Vec2(luminance(f0_), f90_), albedo);
  const float base = luminance(diffuse_) * kPi * (1 - glm::dot(layer_, albedo));
  return base > 0 ? reflection / (reflection + base) : 1.0f;
}

float Bsdf::reflectionProbability(Vec2 albedo) const {
  if (!reflects()) return 0;
  const float share = reflectionShare(albedo);
  return share < 1 ? std::clamp(share, 0.1f, 0.9f) : 1.0f;
}

Bsdf::Value Bsdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z > 0 && wi.z > 0)) return {};
  if (!reflects()) return {diffuse_, wi.z * kInvPi};
  const Vec2 albedo = albedo_(wo.z);
  const Vec3 h = glm::normalize(wo + wi);
  const Vec3 fresnel = f0_ + (Vec3(f90_) - f0_) * schlickWeight(glm::dot(wo, h));
  const float d = ggxD(alpha_, h);
  const float lambdaOut = ggxLambda(alpha_, wo);
  // Height-correlated masking and shadowing (Heitz 2014).
  const float reflection = d / (4 * wo.z * wi.z * (1 + lambdaOut + ggxLambda(alpha_, wi)));
  const float reflectionPdf = d / (4 * wo.z * (1 + lambdaOut));
  const float q = reflectionProbability(albedo);
  const float throughLayer = (1 - glm::dot(layer_, albedo)) * (1 - glm::dot(layer_, albedo_(wi.z)));
  return {diffuse_ * throughLayer + fresnel * reflection, (1 - q) * wi.z * kInvPi + q * reflectionPdf};
}

std::optional<BsdfSample> Bsdf::sample(const Vec3& wo, float uLobe, Vec2 u) const {
  if (!(wo.z > 0)) return std::nullopt;
  Vec3 wi;
  if (reflects() && uLobe < reflectionProbability(albedo_(wo.z))) {
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
