#include "renderer/lights/light_bounds.h"
#include "renderer/sampling/cut_weights.h"

namespace cellcut {
namespace {

float nearWeight(const BlockedFloats& near, std::size_t i, const Vec3& p, const Vec3& n) {
  const auto value = [&](std::size_t field) { return near.field(field)[i]; };
  const Vec3 to = Vec3(value(kCentreX), value(kCentreY), value(kCentreZ)) - p;
  const float distance = glm::length(to), radius = value(kRadius), reach = radius * kReachMargin;
  float factor = 1;
  if (reach < distance) {
    const Vec3 direction = to / distance;
    const float sinU = reach / distance, cosU = safeSqrt(1 - sinU * sinU);
    const Vec3 axis(value(kAxisX), value(kAxisY), value(kAxisZ));
    float cosTheta = -glm::dot(axis, direction);
    if (value(kTwoSided) > 0) cosTheta = std::abs(cosTheta);
    const float sinTheta = sineAbove(cosTheta);
    const float cosO = value(kCosThetaO), sinO = value(kSinThetaO);
    const float cosEmit = cosSubClamped(cosSubClamped(cosTheta, sinTheta, cosO, sinO),
                                        sinSubClamped(cosTheta, sinTheta, cosO, sinO), cosU, sinU);
    const bool reaches = cosEmit >= value(kCosThetaE) - kCosineMargin;
    factor = reaches ? std::max(cosEmit, kCosineMargin) * receiverCosine(glm::dot(n, direction), cosU, sinU) : 0.0f;
  }
  const float mean = meanDistance(distance, radius);
  const float scale = mean > 0 ? mean : 1.0f;
  return std::min(value(kIntensity) * factor / scale / scale, kMaxWeight);
}

}  // namespace

double nearWeightsScalar(const BlockedFloats& near, const Vec3& p, const Vec3& n, float* weights, float* blockSums) {
  double sum = 0;
  for (std::size_t block = 0; block < near.blocks(); ++block) {
    blockSums[block] = 0;
    for (std::size_t i = block * kClusterBlock; i < (block + 1) * kClusterBlock; ++i) {
      weights[i] = nearWeight(near, i, p, n);
      blockSums[block] += weights[i];
    }
    sum += static_cast<double>(blockSums[block]);
  }
  return sum;
}

}  // namespace cellcut
