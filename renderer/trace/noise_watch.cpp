#include "renderer/trace/noise_watch.h"

#include "renderer/trace/render_settings.h"

#include <array>

namespace cellcut {
namespace {

/// Passes of a look, which go on with their doubles, and those of the looks before it that have about half of them.
constexpr std::array<std::uint64_t, 3> kLooks{16, 20, 25};
constexpr std::array<std::uint64_t, 3> kHalves{8, 10, 12};
static_assert(kLooks[0] == kMinNoisePasses);

bool isLook(std::uint64_t passes) {
  for (const std::uint64_t n : kHalves) {
    if (passes == n) return true;
  }
  for (std::uint64_t n : kLooks) {
    while (n < passes) n *= 2;
    if (passes == n) return true;
  }
  return false;
}

}  // namespace

bool NoiseWatch::look(const Film& film) {
  if (!isLook(film.passes()) || (!earlier_.empty() && earlier_.back().passes == film.passes())) return false;
  FilmState now{film.passes(), film.mean(), film.standardError()};
  const bool known = earlier_.size() == kLooks.size();
  if (known) {
    noise_ = estimateNoise(earlier_.front(), now);
    earlier_.pop_front();
  }
  earlier_.push_back(std::move(now));
  return known;
}

}  // namespace cellcut
