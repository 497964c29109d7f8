/// \file nightly.h
/// Two depths of the slow proofs: a fixed share by default, everything in `./dev nightly`. And under a sanitizer two
/// numbers of samples: a sixteenth by default, all in `./dev nightly`.
#pragma once

#include <cstdlib>
#include <string_view>

namespace cellcut {

inline bool isSetToOne(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::string_view(value) == "1";
}
inline bool isNightly() {
  return isSetToOne("CELLCUT_NIGHTLY");
}
inline bool wantsAllSamples() {
  return isSetToOne("CELLCUT_ALL_SAMPLES");
}

}  // namespace cellcut
