#include "renderer/lights/light_bounds.h"
#include "renderer/sampling/cut_weights.h"

namespace cellcut {
namespace {

float farWeight(const BlockedFloats& far, std::size_t i, const Vec3& n) {
  const auto value = [&](std::size_t field) { return far.field(field)[i]; };
  const Vec3 direction(value(ClusterArrays::kDirectionX), value(ClusterArrays::kDirectionY),
                       value(ClusterArrays::kDirectionZ));
  return value(ClusterArrays::kEstimate) *
         receiverCosine(glm::dot(n, direction), value(ClusterArrays::kCosThetaU), value(ClusterArrays::kSinThetaU));
}

float nearWeight(const BlockedFloats& near, std::size_t i, const Vec3& p, const Vec3& n) {
  const auto value = [&](std::size_t field) { return near.field(field)[i]; };
  const Vec3 to =
      Vec3(value(ClusterArrays::kCentreX), value(ClusterArrays::kCentreY), value(ClusterArrays::kCentreZ)) - p;
  const float distance = glm::length(to), radius = value(ClusterArrays::kRadius);
  float factor = 1;
  if (radius < distance) {
    const Vec3 direction = to / distance;
    const float sinU = radius / distance, cosU = safeSqrt(1 - sinU * sinU);
    const Vec3 axis(value(ClusterArrays::kAxisX), value(ClusterArrays::kAxisY), value(ClusterArrays::kAxisZ));
    float cosTheta = -glm::dot(axis, direction);
    if (value(ClusterArrays::kTwoSided) > 0) cosTheta = std::abs(cosTheta);
    const float sinTheta = safeSqrt(1 - cosTheta * cosTheta);
    const float cosO = value(ClusterArrays::kCosThetaO), sinO = value(ClusterArrays::kSinThetaO);
    const float cosEmit = cosSubClamped(cosSubClamped(cosTheta, sinTheta, cosO, sinO),
                                        sinSubClamped(cosTheta, sinTheta, cosO, sinO), cosU, sinU);
    const bool reaches = cosEmit >= value(ClusterArrays::kCosThetaE) - kCosineMargin;
    factor = reaches ? std::max(cosEmit, kCosineMargin) * receiverCosine(glm::dot(n, direction), cosU, sinU) : 0.0f;
  }
  const float mean = meanDistance(distance, radius);
  const float scale = mean > 0 ? mean : 1.0f;
  return value(ClusterArrays::kIntensity) * factor / scale / scale;
}

}  // namespace

double clusterWeightsScalar(const ClusterArrays& clusters, const Vec3& p, const Vec3& n, float* weights,
                            float* blockSums) {
  double sum = 0;
  for (std::size_t slot = 0; slot < clusters.blocks() * kClusterBlock; ++slot) {
    const std::size_t firstNear = clusters.nearSlot(0);
    weights[slot] =
        slot < firstNear ? farWeight(clusters.far, slot, n) : nearWeight(clusters.near, slot - firstNear, p, n);
    if (slot % kClusterBlock == 0) blockSums[slot / kClusterBlock] = 0;
    blockSums[slot / kClusterBlock] += weights[slot];
  }
  for (std::size_t block = 0; block < clusters.blocks(); ++block) sum += static_cast<double>(blockSums[block]);
  return sum;
}

}  // namespace cellcut
