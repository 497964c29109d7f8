/// \file cut_weights.h
/// The inner loop of the renderer: the weights of all clusters of a cut at a shading point, with SIMD.
#pragma once

#include "renderer/base/math.h"

#include <cstddef>
#include <memory>

namespace cellcut {

/// Clusters are weighed in blocks of this many; arrays are padded to whole blocks.
inline constexpr std::size_t kClusterBlock = 16;

/// What a cut caches of its clusters, structure of arrays. Padding has estimate 0.
struct ClusterArrays {
  enum Field { kEstimate, kDirectionX, kDirectionY, kDirectionZ, kCosThetaU, kSinThetaU, kFieldCount };

  ClusterArrays() = default;
  /// All zero. \param count clusters without padding
  explicit ClusterArrays(std::size_t count);

  std::size_t blocks() const { return (size + kClusterBlock - 1) / kClusterBlock; }
  float* field(Field f) { return values.get() + static_cast<std::size_t>(f) * blocks() * kClusterBlock; }
  const float* field(Field f) const { return values.get() + static_cast<std::size_t>(f) * blocks() * kClusterBlock; }
  std::size_t bytes() const { return kFieldCount * blocks() * kClusterBlock * sizeof(float); }

  std::size_t size = 0;
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> values;  ///< aligned for any vector
};

/// Rounding of a cosine bound in float. Without it 1.5 % of adversarial grazing cases lose a light.
inline constexpr float kCosineMargin = 1e-5f;

/// Largest cosine at a receiver that directions within θu of one at angle θ can have, cos(max(0, θ − θu)), rounded up;
/// 0 only where none is above the horizon.
inline float receiverCosine(float cosTheta, float cosThetaU, float sinThetaU) {
  if (cosTheta >= cosThetaU) return 1;
  return std::max(0.0f, cosTheta * cosThetaU + safeSqrt(1 - cosTheta * cosTheta) * sinThetaU + kCosineMargin);
}

/// Weight of each cluster at a point with unit normal n: cached estimate × receiverCosine.
/// \param weights     out: blocks() · kClusterBlock values, ≥ 0
/// \param blockSums   out: blocks() values
/// \return            Σ of blockSums, first to last
double clusterWeights(const ClusterArrays& clusters, const Vec3& n, float* weights, float* blockSums);

/// The same without SIMD: the definition, for tests.
double clusterWeightsScalar(const ClusterArrays& clusters, const Vec3& n, float* weights, float* blockSums);

}  // namespace cellcut
