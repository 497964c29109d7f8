#include "renderer/lights/leaf_sums.h"

#include <numeric>

namespace cellcut {

LeafSums::Sum::Sum(std::uint32_t n)
    : bytes{static_cast<std::uint8_t>(n), static_cast<std::uint8_t>(n >> 8), static_cast<std::uint8_t>(n >> 16)} {}

void LeafSums::addBlock(std::span<const float> intensities) {
  const double sum = std::accumulate(intensities.begin(), intensities.end(), 0.0);
  const double scale = static_cast<double>(kWhole - intensities.size()) / sum;
  double before = 0;
  std::uint32_t leaves = 0;  // each has 1 before the rest is divided
  for (const float intensity : intensities) {
    before_.push_back(Sum(leaves++ + static_cast<std::uint32_t>(before * scale)));
    before += static_cast<double>(intensity);
  }
}

std::uint32_t LeafSums::upTo(std::uint32_t leaf) const {
  const std::uint32_t sum = leaf < before_.size() ? before(leaf) : 0;
  return sum > 0 ? sum : kWhole;
}

SampledLeaf LeafSums::sample(std::uint32_t first, std::uint32_t end, double u) const {
  const std::uint32_t start = before(first);
  const std::uint32_t target = start + static_cast<std::uint32_t>(u * (upTo(end) - start));
  // The last leaf that does not begin after the target. Where intensities are alike it lies at the same share of the
  // range as the target: a search in growing steps from there looks at a cache line or two, one by halves at five of
  // 1,024 leaves. The target is in [leaf, next) as soon as the first loop ends.
  std::uint32_t leaf = first + static_cast<std::uint32_t>(u * (end - first));
  std::uint32_t next = end;
  for (std::uint32_t step = 4; before(leaf) > target; step *= 2) {
    next = leaf;
    leaf = leaf - first > step ? leaf - step : first;
  }
  for (std::uint32_t step = 4; next - leaf > step; step *= 2) {
    if (before(leaf + step) > target) {
      next = leaf + step;
      break;
    }
    leaf += step;
  }
  while (next - leaf > 1) {
    const std::uint32_t middle = leaf + (next - leaf) / 2;
    (before(middle) > target ? next : leaf) = middle;
  }
  return {leaf, pmf(first, end, leaf)};
}

double LeafSums::pmf(std::uint32_t first, std::uint32_t end, std::uint32_t leaf) const {
  return static_cast<double>(upTo(leaf + 1) - before(leaf)) / static_cast<double>(upTo(end) - before(first));
}

}  // namespace cellcut
