/// \file leaf_sums.h
/// Running sums of the intensities of small subtrees' leaves: a leaf below any of their nodes is chosen by a search in
/// a few cache lines, where a walk down the nodes would wait for memory at each level.
///
/// The sums are integers, so that the probability that is reported is that of being drawn. They are of one subtree
/// each: in sums over all leaves faint ones beside strong ones of another cluster are lost.
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
  void reserve(std::size_t leaves) { before_.reserve(leaves); }
  /// The next leaves, which become a block. \param intensities  finite and > 0; rounded to 2⁻²⁴ of their sum, and none
  /// to 0
  void addBlock(std::span<const float> intensities);

  /// One of the leaves [first, end) in proportion to intensity. \param u  uniform in [0, 1) \pre they are of one block
  SampledLeaf sample(std::uint32_t first, std::uint32_t end, double u) const;
  /// Its probability. \pre first ≤ leaf < end, of one block
  double pmf(std::uint32_t first, std::uint32_t end, std::uint32_t leaf) const;

  std::size_t bytes() const { return before_.capacity() * sizeof(Sum); }

 private:
  /// Sum of a block.
  static constexpr std::uint32_t kWhole = 1u << 24;
  /// Below kWhole. Three bytes, for there is one per light.
  struct Sum {
    std::uint8_t bytes[3];
    explicit Sum(std::uint32_t n);
    std::uint32_t get() const { return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16; }
  };

  std::uint32_t before(std::uint32_t leaf) const { return before_[leaf].get(); }
  /// Sum of the leaves of its block before this one, which may be the first of the next block.
  std::uint32_t upTo(std::uint32_t leaf) const;

  std::vector<Sum> before_;  ///< of the leaves of its block before each; 0 for the first of a block only
};

}  // namespace cellcut
