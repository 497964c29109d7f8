/// \file nightly.h
/// Two depths of the slow proofs: a fixed share by default, everything in `./dev nightly`.
#pragma once

#include <cstdlib>
#include <string_view>

namespace cellcut {

inline bool isNightly() {
  const char* value = std::getenv("CELLCUT_NIGHTLY");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace cellcut
