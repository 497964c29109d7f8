#include "renderer/sampling/cut_weights.h"

// Highway compiles what follows once per instruction set and chooses at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/sampling/cut_weights.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "renderer/sampling/cluster_importance-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cellcut::HWY_NAMESPACE {
namespace {

using Tag = hn::CappedTag<float, kClusterBlock>;
constexpr Tag kTag;

/// Importance at a point p with unit normal n; padding has no intensity and no weight.
hn::Vec<Tag> weigh(const BlockedFloats& near, std::size_t i, const Vec3& p, const Vec3& n) {
  const auto load = [&](std::size_t field) { return hn::Load(kTag, near.field(field) + i); };
  const auto set = [&](float value) { return hn::Set(kTag, value); };
  const auto intensity = load(kIntensity), radius = load(kRadius);
  auto toX = hn::Sub(load(kCentreX), set(p.x)), toY = hn::Sub(load(kCentreY), set(p.y)),
       toZ = hn::Sub(load(kCentreZ), set(p.z));
  auto cosU = set(0), sinU = set(0);
  const auto distance = coneTo(toX, toY, toZ, radius, cosU, sinU);
  const auto cosTheta = hn::Neg(dot(load(kAxisX), load(kAxisY), load(kAxisZ), toX, toY, toZ));
  const auto estimate = localEstimates(intensity, radius, distance, cosTheta, hn::Gt(load(kTwoSided), set(0)),
                                       load(kCosThetaO), load(kSinThetaO), load(kCosThetaE), cosU, sinU);
  const auto receiver = receiverCosines(dot(set(n.x), set(n.y), set(n.z), toX, toY, toZ), cosU, sinU);
  return hn::IfThenElseZero(hn::Gt(intensity, set(0)), hn::Mul(estimate, receiver));
}

}  // namespace

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
