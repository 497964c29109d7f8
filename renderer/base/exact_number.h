/// \file exact_number.h
/// The shortest text that is read back as the same number.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <string>

namespace cellcut {

template <std::floating_point Number>
std::string exactNumber(Number value) {
  std::array<char, 32> text{};  // a double takes up to 24
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace cellcut
