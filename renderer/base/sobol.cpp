#include "renderer/base/sobol.h"

#include "renderer/base/rng.h"

namespace cellcut {
namespace {

/// Hash in which every bit depends on lower bits only: on reversed bits, an Owen scramble.
/// Source: Laine and Karras 2011, section 3.1; constants of Vegdahl 2021, "Owen Scrambling Based on Base-2 Hashing".
constexpr std::uint32_t laineKarras(std::uint32_t v, std::uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

/// A primitive polynomial of Sobol's construction: degree, inner coefficients, initial odd numbers.
struct Polynomial {
  unsigned degree;
  unsigned coefficients;
  std::array<std::uint32_t, 3> initial;
};
constexpr std::array<Polynomial, 3> kPolynomials{{{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};

/// Bit-reversed direction numbers of the four dimensions, folded into one table per byte of the index, so that a byte
/// takes one load of four numbers. Dimension 0 is the radical inverse: reversed, the index itself.
using Numbers4 = std::array<std::uint32_t, 4>;
using ByteTables = std::array<std::array<Numbers4, 256>, 4>;

constexpr std::array<std::uint32_t, 32> directionNumbers(const Polynomial& polynomial) {
  std::array<std::uint32_t, 32> direction{};
  for (unsigned i = 0; i < 32; ++i) {
    if (i < polynomial.degree) {
      direction[i] = polynomial.initial[i] << (31 - i);
      continue;
    }
    const unsigned s = polynomial.degree;
    direction[i] = direction[i - s] ^ (direction[i - s] >> s);
    for (unsigned k = 1; k < s; ++k) {
      if ((polynomial.coefficients >> (s - 1 - k)) & 1u) direction[i] ^= direction[i - k];
    }
  }
  return direction;
}

constexpr ByteTables makeTables() {
  ByteTables tables{};
  for (unsigned dimension = 0; dimension < 4; ++dimension) {
    std::array<std::uint32_t, 32> direction{};
    if (dimension > 0) direction = directionNumbers(kPolynomials[dimension - 1]);
    for (unsigned bit = 0; bit < 32; ++bit) {
      const std::uint32_t reversed = dimension == 0 ? 1u << bit : reverseBits(direction[bit]);
      for (unsigned value = 0; value < 256; ++value) {
        if ((value >> (bit % 8)) & 1u) tables[bit / 8][value][dimension] ^= reversed;
      }
    }
  }
  return tables;
}
alignas(16) constexpr ByteTables kTables = makeTables();

void xorInto(Numbers4& a, const Numbers4& b) {
  for (std::size_t d = 0; d < 4; ++d) a[d] ^= b[d];
}

}  // namespace

std::array<std::uint32_t, 4> owenSobol4(std::uint32_t reversedIndex, std::uint64_t seed) {
  const std::uint64_t h = mixBits(seed ^ 0x632be59bd9b4e019ull);
  const std::uint64_t g = mixBits(h);
  const Numbers4 seeds{static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32),
                       static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(g >> 32)};
  // Only the lower half of the index is shuffled: which block of 2¹⁶ points comes first does not matter once the
  // coordinates are scrambled, and short indices need half of the tables.
  const std::uint32_t lower = reverseBits(laineKarras(reversedIndex, static_cast<std::uint32_t>(seed)));
  Numbers4 points = kTables[0][lower & 255];
  xorInto(points, kTables[1][(lower >> 8) & 255]);
  if (const std::uint32_t upper = reversedIndex & 0xffffu; upper != 0) {
    const std::uint32_t index = reverseBits(upper);
    xorInto(points, kTables[2][(index >> 16) & 255]);
    xorInto(points, kTables[3][index >> 24]);
  }
  for (std::size_t d = 0; d < 4; ++d) points[d] = reverseBits(laineKarras(points[d], seeds[d]));
  return points;
}

}  // namespace cellcut
