#include "tests/support/near_weights_scalar.h"

#include "renderer/lights/light_bounds.h"

namespace cellcut::test {
namespace {

float nearWeight(const BlockedFloats& near, std::size_t i, const Vec3& p, const Vec3& n) {
  const auto value = [&](std::size_t field) { return near.field(field)[i]; };
  const Vec3 to = Vec3(value(kCentreX), value(kCentreY), value(kCentreZ)) - p;
  const float distance = glm::length(to), radius = value(kRadius), reach = radius * kReachMargin;
  float emission = 1, receiver = 1;
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
    if (cosEmit < value(kCosThetaE) - kCosineMargin) return 0;
    emission = std::max(cosEmit, kCosineMargin);
    receiver = receiverCosine(glm::dot(n, direction), cosU, sinU);
  }
  const float mean = meanDistance(distance, radius), scale = mean > 0 ? mean : 1.0f;
  const float estimate = std::min(value(kIntensity) * emission / scale / scale, kMaxWeight);
  // As in localCluster(): what rounds to 0 is kept; padding is none.
  if (!(value(kIntensity) > 0)) return 0;
  return (estimate > 0 ? estimate : std::numeric_limits<float>::min()) * receiver;
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

}  // namespace cellcut::test
