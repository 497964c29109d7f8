/// \file bytes.h
/// What tests hand to readers of bytes. Nothing is copied.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace cellcut::test {

inline std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text));
}
/// Of a list that may be a temporary.
template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace cellcut::test
