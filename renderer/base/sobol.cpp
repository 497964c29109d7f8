#include "renderer/base/sobol.h"

#include "renderer/base/rng.h"

namespace cellcut {
namespace {

constexpr std::uint32_t reverseBits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  // Not a byte-swap instruction: shifts let the compiler reverse four numbers at once.
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  return (v >> 16) | (v << 16);
}

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

/// Direction numbers, bit-reversed, folded into one table per byte of the index. Dimension 0, the radical inverse, is
/// the reversed index.
using ByteTables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr ByteTables makeTables(const Polynomial& polynomial) {
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
  ByteTables tables{};
  for (unsigned byte = 0; byte < 4; ++byte) {
    for (unsigned value = 0; value < 256; ++value) {
      for (unsigned bit = 0; bit < 8; ++bit) {
        if ((value >> bit) & 1u) tables[byte][value] ^= reverseBits(direction[byte * 8 + bit]);
      }
    }
  }
  return tables;
}
constexpr std::array<ByteTables, 3> kTables{makeTables(kPolynomials[0]), makeTables(kPolynomials[1]),
                                            makeTables(kPolynomials[2])};

std::uint32_t reversedSobol(const ByteTables& tables, std::uint32_t index) {
  std::uint32_t result = tables[0][index & 255] ^ tables[1][(index >> 8) & 255];
  if (index >> 16) result ^= tables[2][(index >> 16) & 255] ^ tables[3][index >> 24];
  return result;
}

}  // namespace

std::array<std::uint32_t, 4> owenSobol4(std::uint32_t index, std::uint64_t seed) {
  // Only the lower half of the index is shuffled: which block of 2¹⁶ points comes first does not matter once the
  // coordinates are scrambled, and short indices need half of the tables.
  constexpr std::uint32_t kShuffled = 0xffffu;
  const std::uint32_t shuffle = reverseBits(laineKarras(reverseBits(index), static_cast<std::uint32_t>(seed)));
  const std::uint32_t i = (index & ~kShuffled) | (shuffle & kShuffled);

  const std::uint64_t h = mixBits(seed ^ 0x632be59bd9b4e019ull);
  const std::uint64_t g = mixBits(h);
  const std::array<std::uint32_t, 4> seeds{static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32),
                                           static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(g >> 32)};
  const std::array<std::uint32_t, 4> reversed{i, reversedSobol(kTables[0], i), reversedSobol(kTables[1], i),
                                              reversedSobol(kTables[2], i)};
  std::array<std::uint32_t, 4> points;
  for (std::size_t d = 0; d < 4; ++d) points[d] = reverseBits(laineKarras(reversed[d], seeds[d]));
  return points;
}

}  // namespace cellcut
