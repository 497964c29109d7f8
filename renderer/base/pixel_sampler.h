/// \file pixel_sampler.h
/// The random numbers of one path: a function of (seed, pixel, pass, dimension) and of nothing else.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/base/sobol.h"

#include <string_view>

namespace cellcut {

enum class PixelSampling : std::uint8_t {
  kSobol,        ///< Owen-scrambled Sobol' points over the passes of a pixel
  kIndependent,  ///< independent numbers, for statistics
};

/// On the command line and in reports.
constexpr std::string_view nameOf(PixelSampling sampling) {
  return sampling == PixelSampling::kSobol ? "sobol" : "independent";
}

/// Four uniform numbers that are well distributed together over the passes of a pixel.
struct Sample4 {
  std::array<std::uint32_t, 4> bits;
  std::uint64_t extra;  ///< further random bits, independent of the four

  float operator[](std::size_t i) const { return toUnitFloat(bits[i]); }
  /// Number `i` with 53 bits.
  double wide(std::size_t i) const { return toUnitDouble((static_cast<std::uint64_t>(bits[i]) << 32) | (extra >> 32)); }
};

class PixelSampler {
 public:
  PixelSampler(PixelSampling sampling, std::uint64_t seed, int x, int y, std::uint64_t pass)
      : sampling_(sampling),
        index_(static_cast<std::uint32_t>(pass)),
        reversedIndex_(reverseBits(index_)),
        // Passes past 2³² start another scramble.
        pixel_(hashOf(seed, x, y, pass >> 32)) {}

  /// Random bits of the path that are no part of its well-distributed dimensions.
  std::uint64_t nextBits() { return bitsOf(nextGroup()); }

  /// The next four dimensions of the path.
  Sample4 next() {
    const std::uint64_t group = nextGroup();
    const std::uint64_t extra = bitsOf(group);
    if (sampling_ == PixelSampling::kSobol) return {owenSobol4(reversedIndex_, group), extra};
    const std::uint64_t a = mixBits(extra + 0x9e3779b97f4a7c15ull);
    const std::uint64_t b = mixBits(extra + 2 * 0x9e3779b97f4a7c15ull);
    return {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), static_cast<std::uint32_t>(b),
             static_cast<std::uint32_t>(b >> 32)},
            extra};
  }

 private:
  std::uint64_t nextGroup() { return mixBits(pixel_ += 0x9e3779b97f4a7c15ull); }
  std::uint64_t bitsOf(std::uint64_t group) const { return mixBits(group ^ (index_ * 0xd1342543de82ef95ull)); }

  PixelSampling sampling_;
  std::uint32_t index_;
  std::uint32_t reversedIndex_;
  std::uint64_t pixel_;
};

}  // namespace cellcut
