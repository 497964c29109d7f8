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

double clusterWeightsSimd(const ClusterArrays& clusters, const Vec3& n, float* HWY_RESTRICT weights,
                          float* HWY_RESTRICT blockSums) {
  const hn::CappedTag<float, kClusterBlock> d;
  const std::size_t lanes = hn::Lanes(d);
  const float* HWY_RESTRICT estimate = clusters.field(ClusterArrays::kEstimate);
  const float* HWY_RESTRICT x = clusters.field(ClusterArrays::kDirectionX);
  const float* HWY_RESTRICT y = clusters.field(ClusterArrays::kDirectionY);
  const float* HWY_RESTRICT z = clusters.field(ClusterArrays::kDirectionZ);
  const float* HWY_RESTRICT cosU = clusters.field(ClusterArrays::kCosThetaU);
  const float* HWY_RESTRICT sinU = clusters.field(ClusterArrays::kSinThetaU);
  const auto nx = hn::Set(d, n.x), ny = hn::Set(d, n.y), nz = hn::Set(d, n.z);
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), margin = hn::Set(d, kCosineMargin);

  double sum = 0;
  for (std::size_t block = 0; block < clusters.blocks(); ++block) {
    auto blockSum = zero;
    for (std::size_t i = block * kClusterBlock; i < (block + 1) * kClusterBlock; i += lanes) {
      const auto cosine =
          hn::MulAdd(nx, hn::Load(d, x + i), hn::MulAdd(ny, hn::Load(d, y + i), hn::Mul(nz, hn::Load(d, z + i))));
      const auto sine = hn::Sqrt(hn::Max(zero, hn::NegMulAdd(cosine, cosine, one)));
      const auto cosThetaU = hn::Load(d, cosU + i);
      const auto bound = hn::MulAdd(cosine, cosThetaU, hn::MulAdd(sine, hn::Load(d, sinU + i), margin));
      const auto factor = hn::IfThenElse(hn::Ge(cosine, cosThetaU), one, hn::Max(zero, bound));
      const auto weight = hn::Mul(factor, hn::Load(d, estimate + i));
      hn::Store(weight, d, weights + i);
      blockSum = hn::Add(blockSum, weight);
    }
    blockSums[block] = hn::GetLane(hn::SumOfLanes(d, blockSum));
    sum += static_cast<double>(blockSums[block]);
  }
  return sum;
}

}  // namespace cellcut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <hwy/aligned_allocator.h>

namespace cellcut {

HWY_EXPORT(clusterWeightsSimd);

double clusterWeights(const ClusterArrays& clusters, const Vec3& n, float* weights, float* blockSums) {
  return HWY_DYNAMIC_DISPATCH(clusterWeightsSimd)(clusters, n, weights, blockSums);
}

double clusterWeightsScalar(const ClusterArrays& clusters, const Vec3& n, float* weights, float* blockSums) {
  double sum = 0;
  for (std::size_t block = 0; block < clusters.blocks(); ++block) {
    float blockSum = 0;
    for (std::size_t i = block * kClusterBlock; i < (block + 1) * kClusterBlock; ++i) {
      const Vec3 direction(clusters.field(ClusterArrays::kDirectionX)[i], clusters.field(ClusterArrays::kDirectionY)[i],
                           clusters.field(ClusterArrays::kDirectionZ)[i]);
      weights[i] = clusters.field(ClusterArrays::kEstimate)[i] *
                   receiverCosine(glm::dot(n, direction), clusters.field(ClusterArrays::kCosThetaU)[i],
                                  clusters.field(ClusterArrays::kSinThetaU)[i]);
      blockSum += weights[i];
    }
    blockSums[block] = blockSum;
    sum += static_cast<double>(blockSum);
  }
  return sum;
}

ClusterArrays::ClusterArrays(std::size_t count) : size(count) {
  if (count == 0) return;
  const std::size_t floats = kFieldCount * blocks() * kClusterBlock;
  values.reset(static_cast<float*>(hwy::AllocateAlignedBytes(floats * sizeof(float), nullptr, nullptr)));
  std::fill_n(values.get(), floats, 0.0f);
}

void ClusterArrays::Free::operator()(float* p) const {
  hwy::FreeAlignedBytes(p, nullptr, nullptr);
}

}  // namespace cellcut
#endif
