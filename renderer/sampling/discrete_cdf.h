/// \file discrete_cdf.h
/// Inverse transform sampling of a discrete distribution of a few thousand elements.
///
/// Against an alias table: a third of the memory, close numbers choose close elements, as well-distributed numbers need
/// it, and when heavy elements come first a few cache lines serve most samples. The running sums are integers, so that
/// the probability that is reported is exactly that of being drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {

class DiscreteCdf {
 public:
  /// \param weights  ≥ 0 and finite, with a finite sum; at most 2²⁰; all zero or none: an empty distribution. Every
  ///                 weight above 0 has a probability of 2⁻³⁰ at least.
  explicit DiscreteCdf(std::span<const double> weights);

  bool empty() const { return sums_.empty(); }
  struct Sample {
    std::size_t index;  ///< its weight is > 0
    double pmf;
    double rest;  ///< uniform in [0, 1) and independent of the index
  };
  /// \param u  in [0, 1) \pre !empty()
  Sample sample(double u) const;
  /// 0 for an empty distribution.
  double pmf(std::size_t i) const;
  std::size_t bytes() const { return (sums_.capacity() + blockSums_.capacity()) * sizeof(std::int32_t); }

 private:
  /// What a probability of 1 is.
  static constexpr std::int32_t kOne = 1 << 30;
  /// Sums that lie in one cache line.
  static constexpr std::size_t kBlock = 16;

  std::int32_t before(std::size_t i) const { return i > 0 ? sums_[i - 1] : 0; }

  std::vector<std::int32_t> sums_;       ///< up to and with each element, whole blocks; the rest is kOne
  std::vector<std::int32_t> blockSums_;  ///< up to and with each block, whole blocks again
};

}  // namespace cellcut
