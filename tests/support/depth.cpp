#include "tests/support/depth.h"

#include "tests/support/nightly.h"

#include <algorithm>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CELLCUT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CELLCUT_SANITIZED 1
#endif
#endif

namespace cellcut::test {

std::size_t byDepth(std::size_t always, std::size_t atNight) {
  return isNightly() ? atNight : always;
}

bool isSanitized() {
#ifdef CELLCUT_SANITIZED
  return true;
#else
  return false;
#endif
}

bool isSixteenth() {
  return isSanitized() && !wantsAllSamples();
}

std::size_t sampleShare(std::size_t samples) {
  return isSixteenth() ? std::max<std::size_t>(1, samples / 16) : samples;
}

}  // namespace cellcut::test
