#include "renderer/sampling/discrete_cdf.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace cellcut {
namespace {

constexpr std::size_t wholeBlocks(std::size_t count, std::size_t block) {
  return (count + block - 1) / block * block;
}

/// How many of ascending numbers are not above x. Without branches: the compiler makes vectors of it.
std::size_t countUpTo(std::span<const std::int32_t> numbers, std::int32_t x) {
  std::int32_t count = 0;
  for (const std::int32_t number : numbers) count += number <= x ? 1 : 0;
  return static_cast<std::size_t>(count);
}

}  // namespace

DiscreteCdf::DiscreteCdf(std::span<const double> weights) {
  assert(weights.size() <= std::size_t{1} << 20);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) return;
  const auto positive = std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  const double toShare = static_cast<double>(kOne - static_cast<std::int32_t>(positive));
  sums_.resize(wholeBlocks(weights.size(), kBlock), kOne);
  for (std::size_t i = 0; i < weights.size(); ++i)
    sums_[i] = weights[i] > 0 ? 1 + static_cast<std::int32_t>(weights[i] / sum * toShare) : 0;
  // What rounding down leaves goes to the largest.
  const auto largest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  const auto end = sums_.begin() + static_cast<std::ptrdiff_t>(weights.size());
  sums_[static_cast<std::size_t>(largest)] += kOne - std::accumulate(sums_.begin(), end, std::int32_t{0});
  std::partial_sum(sums_.begin(), end, sums_.begin());

  blockSums_.resize(wholeBlocks(sums_.size() / kBlock, kBlock), kOne);
  for (std::size_t b = 0; b < sums_.size() / kBlock; ++b) blockSums_[b] = sums_[b * kBlock + kBlock - 1];
}

DiscreteCdf::Sample DiscreteCdf::sample(double u) const {
  const double target = u * kOne;
  const auto x = static_cast<std::int32_t>(target);
  const std::size_t first = countUpTo(blockSums_, x) * kBlock;
  const std::size_t index = first + countUpTo({sums_.data() + first, kBlock}, x);
  const std::int32_t start = before(index), width = sums_[index] - start;
  return {index, static_cast<double>(width) / kOne, (target - start) / width};
}

double DiscreteCdf::pmf(std::size_t i) const {
  return empty() ? 0.0 : static_cast<double>(sums_[i] - before(i)) / kOne;
}

}  // namespace cellcut
