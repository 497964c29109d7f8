/// \file cut_weights.h
/// The inner loop of the renderer: the weights of all clusters of a cut at a shading point, with SIMD.
#pragma once

#include "renderer/base/math.h"

#include <cstddef>
#include <limits>
#include <memory>

namespace cellcut {

/// Clusters are weighed in blocks of this many; arrays are padded to whole blocks.
inline constexpr std::size_t kClusterBlock = 16;

/// Blocks of floats, one row of blocks per field, aligned for any vector. Padding is 0, and so is the weight of
/// padding.
class BlockedFloats {
 public:
  BlockedFloats() = default;
  BlockedFloats(std::size_t count, std::size_t fields);

  std::size_t size() const { return size_; }
  std::size_t blocks() const { return (size_ + kClusterBlock - 1) / kClusterBlock; }
  float* field(std::size_t f) { return values_.get() + f * blocks() * kClusterBlock; }
  const float* field(std::size_t f) const { return values_.get() + f * blocks() * kClusterBlock; }
  std::size_t bytes() const { return fields_ * blocks() * kClusterBlock * sizeof(float); }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::size_t size_ = 0, fields_ = 0;
  std::unique_ptr<float[], Free> values_;
};

/// The clusters of a cut that are evaluated at the point, one row per field.
enum NearField {
  kCentreX,
  kCentreY,
  kCentreZ,
  kRadius,
  kIntensity,
  kAxisX,
  kAxisY,
  kAxisZ,
  kCosThetaO,
  kSinThetaO,
  kCosThetaE,
  kTwoSided,
  kNearFields
};

/// Rounding of a cosine bound in float. Without it 1.5 % of adversarial grazing cases lose a light.
inline constexpr float kCosineMargin = 1e-5f;
/// Rounding of 1 − c² of a cosine that is itself the rounded dot product of two unit vectors. Its root is added to a
/// bound, where near c = ±1 the rounding is as large as 4·10⁻⁴ and the margin above does not cover it.
inline constexpr float kSineSquaredMargin = 5e-7f;
/// Rounding of a sphere's radius and of its distance: factor on their quotient, so that a bound near a right angle,
/// where its cosine has the error's root, is on the safe side.
inline constexpr float kReachMargin = 1 + 1e-6f;
/// Largest weight of a cluster: that of one right beside a light may overflow, and those of a block are added up.
inline constexpr float kMaxWeight = std::numeric_limits<float>::max() / 64;

/// Sine of an angle in [0, π] given by its cosine, rounded up.
inline float sineAbove(float cosine) {
  return std::sqrt(std::max(0.0f, 1 - cosine * cosine) + kSineSquaredMargin);
}

/// Largest cosine at a receiver that directions within θu of one at angle θ can have, cos(max(0, θ − θu)), rounded up;
/// 0 only where none is above the horizon.
inline float receiverCosine(float cosTheta, float cosThetaU, float sinThetaU) {
  if (cosTheta >= cosThetaU) return 1;
  return std::max(0.0f, cosTheta * cosThetaU + sineAbove(cosTheta) * sinThetaU + kCosineMargin);
}

/// A smooth mean distance between two spheres whose centres are D apart: 0.75 ρ at D = 0, D far away.
/// \param rho  √(r² + r_C²) of their radii
inline float meanDistance(float distance, float rho) {
  if (rho == 0) return distance;
  const float q = rho / (distance + 1.1547f * rho);
  return distance + rho * q * q;
}

/// Weight of each cluster at a point p with unit normal n: its estimate for that point × receiverCosine.
/// \param near     rows of NearField
/// \param weights  out: blocks() · kClusterBlock values, ≥ 0; aligned to 64 bytes
/// \param blockSums  out: blocks() values
/// \return Σ of blockSums, first to last
double nearWeights(const BlockedFloats& near, const Vec3& p, const Vec3& n, float* weights, float* blockSums);

}  // namespace cellcut
