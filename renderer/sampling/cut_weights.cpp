#include "renderer/sampling/cut_weights.h"

// Highway compiles what follows once per instruction set and chooses at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/sampling/cut_weights.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cellcut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kClusterBlock>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;

// Vectors of arm64's SVE have no size, so they are no members of a struct: three arguments each.
Floats dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
  return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
}
Floats sineOf(Floats cosine) {
  return hn::Sqrt(hn::Max(hn::Zero(kTag), hn::NegMulAdd(cosine, cosine, hn::Set(kTag, 1.0f))));
}

/// sineAbove() of cut_weights.h.
Floats sinesAbove(Floats cosine) {
  const auto squared = hn::Max(hn::Zero(kTag), hn::NegMulAdd(cosine, cosine, hn::Set(kTag, 1.0f)));
  return hn::Sqrt(hn::Add(squared, hn::Set(kTag, kSineSquaredMargin)));
}

Floats receiverCosines(Floats cosTheta, Floats cosU, Floats sinU) {
  const auto bound = hn::MulAdd(cosTheta, cosU, hn::MulAdd(sinesAbove(cosTheta), sinU, hn::Set(kTag, kCosineMargin)));
  return hn::IfThenElse(hn::Ge(cosTheta, cosU), hn::Set(kTag, 1.0f), hn::Max(hn::Zero(kTag), bound));
}

/// localCluster() for a region of radius 0, times receiverCosine.
Floats weigh(const BlockedFloats& near, std::size_t i, const Vec3& p, const Vec3& n) {
  const auto load = [&](std::size_t field) { return hn::Load(kTag, near.field(field) + i); };
  const auto one = hn::Set(kTag, 1.0f), zero = hn::Zero(kTag), margin = hn::Set(kTag, kCosineMargin);
  const auto toX = hn::Sub(load(kCentreX), hn::Set(kTag, p.x)), toY = hn::Sub(load(kCentreY), hn::Set(kTag, p.y)),
             toZ = hn::Sub(load(kCentreZ), hn::Set(kTag, p.z));
  const auto distance = hn::Sqrt(dot(toX, toY, toZ, toX, toY, toZ));
  const auto radius = load(kRadius);
  const auto reach = hn::Mul(radius, hn::Set(kTag, kReachMargin));
  const auto inside = hn::Ge(reach, distance);
  const auto perDistance = hn::Div(one, hn::IfThenElse(inside, one, distance));
  const auto directionX = hn::Mul(toX, perDistance), directionY = hn::Mul(toY, perDistance),
             directionZ = hn::Mul(toZ, perDistance);
  const auto sinU = hn::Mul(reach, perDistance);
  const auto cosU = sineOf(sinU);

  const auto towards = hn::Neg(dot(load(kAxisX), load(kAxisY), load(kAxisZ), directionX, directionY, directionZ));
  const auto cosTheta = hn::IfThenElse(hn::Gt(load(kTwoSided), zero), hn::Abs(towards), towards);
  const auto sinTheta = sinesAbove(cosTheta);
  const auto cosO = load(kCosThetaO), sinO = load(kSinThetaO);
  const auto withinAxes = hn::Ge(cosTheta, cosO);
  const auto cosPast = hn::IfThenElse(withinAxes, one, hn::MulAdd(cosTheta, cosO, hn::Mul(sinTheta, sinO)));
  const auto sinPast = hn::IfThenElse(withinAxes, zero, hn::NegMulAdd(cosTheta, sinO, hn::Mul(sinTheta, cosO)));
  const auto cosEmit = hn::IfThenElse(hn::Ge(cosPast, cosU), one, hn::MulAdd(cosPast, cosU, hn::Mul(sinPast, sinU)));
  const auto reaches = hn::Ge(cosEmit, hn::Sub(load(kCosThetaE), margin));
  const auto emission = hn::IfThenElseZero(reaches, hn::Max(cosEmit, margin));

  const auto receiver = receiverCosines(
      dot(hn::Set(kTag, n.x), hn::Set(kTag, n.y), hn::Set(kTag, n.z), directionX, directionY, directionZ), cosU, sinU);
  const auto factor = hn::IfThenElse(inside, one, hn::Mul(emission, receiver));
  const auto q = hn::Div(radius, hn::Max(hn::MulAdd(hn::Set(kTag, 1.1547f), radius, distance),
                                         hn::Set(kTag, std::numeric_limits<float>::min())));
  const auto mean = hn::MulAdd(hn::Mul(radius, q), q, distance);
  const auto scale = hn::IfThenElse(hn::Gt(mean, zero), mean, one);
  return hn::Min(hn::Div(hn::Div(hn::Mul(load(kIntensity), factor), scale), scale), hn::Set(kTag, kMaxWeight));
}

double nearWeightsSimd(const BlockedFloats& near, const Vec3& p, const Vec3& n, float* HWY_RESTRICT weights,
                       float* HWY_RESTRICT blockSums) {
  const std::size_t lanes = hn::Lanes(kTag);
  double sum = 0;
  for (std::size_t block = 0; block < near.blocks(); ++block) {
    auto blockSum = hn::Zero(kTag);
    for (std::size_t i = block * kClusterBlock; i < (block + 1) * kClusterBlock; i += lanes) {
      const auto weight = weigh(near, i, p, n);
      hn::Store(weight, kTag, weights + i);
      blockSum = hn::Add(blockSum, weight);
    }
    blockSums[block] = hn::GetLane(hn::SumOfLanes(kTag, blockSum));
    sum += static_cast<double>(blockSums[block]);
  }
  return sum;
}

}  // namespace cellcut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <new>

#include <hwy/aligned_allocator.h>

namespace cellcut {

HWY_EXPORT(nearWeightsSimd);

double nearWeights(const BlockedFloats& near, const Vec3& p, const Vec3& n, float* weights, float* blockSums) {
  return HWY_DYNAMIC_DISPATCH(nearWeightsSimd)(near, p, n, weights, blockSums);
}

BlockedFloats::BlockedFloats(std::size_t count, std::size_t fields) : size_(count), fields_(fields) {
  if (count == 0) return;
  values_.reset(static_cast<float*>(hwy::AllocateAlignedBytes(bytes(), nullptr, nullptr)));
  if (!values_) throw std::bad_alloc();
  std::fill_n(values_.get(), bytes() / sizeof(float), 0.0f);
}

void BlockedFloats::Free::operator()(float* p) const {
  hwy::FreeAlignedBytes(p, nullptr, nullptr);
}

}  // namespace cellcut
#endif
