#include "renderer/lights/leaf_sums.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace cellcut {
LeafSums::Units::Units(std::uint32_t n)
    : bytes{static_cast<std::uint8_t>(n), static_cast<std::uint8_t>(n >> 8), static_cast<std::uint8_t>(n >> 16)} {}

void LeafSums::divide(std::span<const float> intensities, std::span<Units> before) {
  const double sum = std::accumulate(intensities.begin(), intensities.end(), 0.0);
  const double perIntensity = static_cast<double>(kUnits - intensities.size()) / sum;
  const auto unitsOf = [&](float intensity) {
    return 1 + static_cast<std::uint32_t>(static_cast<double>(intensity) * perIntensity);
  };
  std::uint32_t left = kUnits;
  for (const float intensity : intensities) left -= unitsOf(intensity);
  // What rounding down leaves goes to the largest.
  const auto largest = std::max_element(intensities.begin(), intensities.end()) - intensities.begin();
  std::uint32_t running = 0;
  for (std::size_t i = 0; i < intensities.size(); ++i) {
    before[i] = Units(running);
    running += unitsOf(intensities[i]) + (i == static_cast<std::size_t>(largest) ? left : 0);
  }
  assert(running == kUnits);
}

LeafSums::LeafSums(std::span<const float> intensities) : blockStarts_{0}, inBlock_(intensities.size()) {
  // Below 2⁶⁴ with what rounding up adds, for any 32-bit number of leaves.
  constexpr double kUnitsOfAll = 0x1p39;
  const double sum = std::accumulate(intensities.begin(), intensities.end(), 0.0);
  blockStarts_.reserve((intensities.size() + kBlock - 1) / kBlock + 1);
  for (std::size_t first = 0; first < intensities.size(); first += kBlock) {
    const auto block = intensities.subspan(first, std::min(kBlock, intensities.size() - first));
    divide(block, std::span(inBlock_).subspan(first, block.size()));
    const double share = std::accumulate(block.begin(), block.end(), 0.0) / sum;
    blockStarts_.push_back(blockStarts_.back() + (1 + static_cast<std::uint64_t>(share * kUnitsOfAll)) * kUnits);
  }
}

std::uint64_t LeafSums::before(std::uint32_t leaf) const {
  if (leaf == inBlock_.size()) return blockStarts_.back();
  const std::size_t block = leaf / kBlock;
  return blockStarts_[block] + inBlock_[leaf].get() * unit(block);
}

SampledLeaf LeafSums::sample(std::uint32_t first, std::uint32_t end, double u) const {
  const std::uint64_t start = before(first), sum = before(end) - start;
  const std::uint64_t target = start + std::min(static_cast<std::uint64_t>(u * static_cast<double>(sum)), sum - 1);
  // The last block that does not begin after the target, then the last leaf of it that does not.
  const auto starts = blockStarts_.begin();
  const auto nextBlock = std::upper_bound(starts + first / kBlock + 1, starts + (end - 1) / kBlock + 1, target);
  const auto block = static_cast<std::size_t>(nextBlock - starts) - 1;
  const auto inBlock = static_cast<std::uint32_t>((target - blockStarts_[block]) / unit(block));
  const auto leaves = std::span(inBlock_).subspan(block * kBlock);
  const auto next = std::upper_bound(leaves.begin(), leaves.begin() + std::min(kBlock, leaves.size()), inBlock,
                                     [](std::uint32_t x, const Units& before) { return x < before.get(); });
  const auto leaf = static_cast<std::uint32_t>(block * kBlock) + static_cast<std::uint32_t>(next - leaves.begin()) - 1;
  return {leaf, pmf(first, end, leaf)};
}

double LeafSums::pmf(std::uint32_t first, std::uint32_t end, std::uint32_t leaf) const {
  return static_cast<double>(before(leaf + 1) - before(leaf)) / static_cast<double>(before(end) - before(first));
}

}  // namespace cellcut
