/// \file sobol.h
/// Owen-scrambled Sobol' points, four dimensions at a time.
///
/// Each group of four dimensions is the first four of Sobol's sequence, its index shuffled and its coordinates
/// scrambled by hashes of a seed, so that groups are independent of each other and any prefix of 2^k points is a
/// scrambled (t, k, 4)-net. Source: B. Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4); direction
/// numbers of Joe and Kuo 2008.
#pragma once

#include <array>
#include <cstdint>

namespace cellcut {

constexpr std::uint32_t reverseBits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  // Not a byte-swap instruction: shifts let the compiler reverse four numbers at once.
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  return (v >> 16) | (v << 16);
}

/// Four 32-bit fractions of a point in the group with this seed.
/// \param reversedIndex  reverseBits() of the point's number, which many groups share
std::array<std::uint32_t, 4> owenSobol4(std::uint32_t reversedIndex, std::uint64_t seed);

}  // namespace cellcut
