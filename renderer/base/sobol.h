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

/// Four 32-bit fractions of point `index` in the group with this seed.
std::array<std::uint32_t, 4> owenSobol4(std::uint32_t index, std::uint64_t seed);

}  // namespace cellcut
