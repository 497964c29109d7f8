#include "app/numbers.h"

#include "renderer/base/error.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace cellcut {
namespace {

template <class Number>
std::optional<Number> parseAll(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string describe(RealRange range) {
  if (range.least == std::numeric_limits<double>::lowest()) return "a finite number";
  std::ostringstream text;
  text << (range.leastExcluded ? "a number above " : "a number of at least ") << range.least;
  if (range.most < std::numeric_limits<double>::max()) text << " and at most " << range.most;
  if (!range.alsoKnown.empty()) text << ", nor '" << range.alsoKnown << "'";
  return text.str();
}

}  // namespace

std::uint64_t parseWhole(const std::string& option, std::string_view text, WholeRange range) {
  const auto value = parseAll<std::uint64_t>(text);
  if (!value || *value < range.least || *value > range.most) {
    throw InputError(option, "'" + std::string(text) + "' is not a whole number from " + std::to_string(range.least) +
                                 " to " + std::to_string(range.most));
  }
  return *value;
}

double parseReal(const std::string& option, std::string_view text, RealRange range) {
  const auto value = parseAll<double>(text);
  const bool inside = value && std::isfinite(*value) && *value >= range.least && *value <= range.most;
  if (!inside || (range.leastExcluded && *value == range.least)) {
    throw InputError(option, "'" + std::string(text) + "' is not " + describe(range));
  }
  return *value;
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace cellcut
