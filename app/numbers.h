/// \file numbers.h
/// Numbers on the command line and how they are written: the whole text is the number, it is finite and in its range, or it is refused.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace cellcut {

struct WholeRange {
  std::uint64_t least = 0;
  std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
};

struct RealRange {
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  bool leastExcluded = false;
  std::string_view alsoKnown = "";  ///< a word that the caller knows, for the refusal
};

/// Decimal digits only: no sign, no base prefix, no separators.
/// \throws InputError naming `option`, the text and the range
std::uint64_t parseWhole(const std::string& option, std::string_view text, WholeRange range);

/// Decimal or scientific notation, finite.
/// \throws InputError as parseWhole
double parseReal(const std::string& option, std::string_view text, RealRange range);

/// "1280x720", as --size takes it.
std::string sizeText(int width, int height);

}  // namespace cellcut
