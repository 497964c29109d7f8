/// \file leaf_sums.h
/// Running sums of the intensities of a tree's leaves: a choice from any range of them in two look-ups, where a walk down
/// the tree would wait for memory at each of its levels.
///
/// The sums are integers, so that the probability that is reported is exactly that of being drawn, from any range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {

/// A leaf that was chosen, and its probability.
struct SampledLeaf {
  std::uint32_t leaf;
  double pmf;
};

class LeafSums {
 public:
  LeafSums() = default;
  /// \param intensities  finite and > 0, one per leaf. Rounded to 2⁻²⁴ of the sum of the 64 that they are stored with, and
  ///                     that to 2⁻³⁹ of the sum of all; none becomes 0.
  explicit LeafSums(std::span<const float> intensities);

  /// One of the leaves [first, end) in proportion to intensity. \param u  uniform in [0, 1) \pre first < end
  SampledLeaf sample(std::uint32_t first, std::uint32_t end, double u) const;
  /// Its probability. \pre first ≤ leaf < end
  double pmf(std::uint32_t first, std::uint32_t end, std::uint32_t leaf) const;

  std::size_t bytes() const {
    return blockStarts_.capacity() * sizeof(std::uint64_t) + inBlock_.capacity() * sizeof(Units);
  }

 private:
  /// Leaves that are stored together.
  static constexpr std::size_t kBlock = 64;
  /// What the sum of a block is divided into.
  static constexpr std::uint32_t kUnits = 1u << 24;
  /// A number below kUnits. Three bytes, for there is one per light.
  struct Units {
    std::uint8_t bytes[3];
    explicit Units(std::uint32_t n = 0);
    std::uint32_t get() const { return bytes[0] | bytes[1] << 8 | bytes[2] << 16; }
  };
  /// Divides kUnits between a block's leaves, at least one to each.
  static void divide(std::span<const float> intensities, std::span<Units> before);

  std::uint64_t unit(std::size_t block) const { return (blockStarts_[block + 1] - blockStarts_[block]) / kUnits; }
  /// Sum of the leaves before this one; it may be one past the last.
  std::uint64_t before(std::uint32_t leaf) const;

  std::vector<std::uint64_t> blockStarts_;  ///< sums before each block, and of all
  std::vector<Units> inBlock_;              ///< of the leaves of its block before each
};

}  // namespace cellcut
