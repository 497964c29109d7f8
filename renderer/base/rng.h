/// \file rng.h
/// Random numbers that are a function of where they are used, never of which thread asks first.
#pragma once

#include <cstdint>

namespace cellcut {

/// Bijective mixing of 64 bits. Source: Stafford's variant 13 of the MurmurHash3 finaliser (as in SplitMix64).
constexpr std::uint64_t mixBits(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

/// Hash of any number of integers.
template <class... Rest>
constexpr std::uint64_t hashOf(std::uint64_t first, Rest... rest) {
  std::uint64_t h = mixBits(first + 0x9e3779b97f4a7c15ull);
  ((h = mixBits(h ^ (static_cast<std::uint64_t>(rest) + 0x9e3779b97f4a7c15ull))), ...);
  return h;
}

/// [0, 1) from the upper bits; a float holds 24, so 1 is never reached.
constexpr float toUnitFloat(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}
/// [0, 1) with 53 bits: enough to reach each of 10⁷ lights whose powers span twelve decades.
constexpr double toUnitDouble(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}
/// The largest double below 1: where what is left of a random number after a choice would be rounded up to 1.
inline constexpr double kAlmostOne = 1 - 0x1p-53;

/// A stream of independent numbers from one seed (SplitMix64: Steele et al. 2014). For tests, recipes and pilots.
class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) : state_(seed) {}
  constexpr std::uint64_t bits() { return mixBits(state_ += 0x9e3779b97f4a7c15ull); }
  constexpr float uniform() { return toUnitFloat(static_cast<std::uint32_t>(bits() >> 32)); }
  constexpr double uniformDouble() { return toUnitDouble(bits()); }
  constexpr float uniform(float lower, float upper) { return lower + (upper - lower) * uniform(); }
  /// 0 … n − 1 (bias below 2⁻³² n).
  constexpr std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32); }

 private:
  std::uint64_t state_;
};

}  // namespace cellcut
