#include "app/noise_watch.h"

#include "renderer/trace/render_settings.h"

#include <array>

namespace cellcut {
namespace {

/// Numbers of the series, begun early enough for the first look to have its half.
bool isLook(std::uint64_t passes) {
  constexpr std::array<std::uint64_t, 3> kFirst{8, 10, 12};
  constexpr std::array<std::uint64_t, 3> kThen{16, 20, 25};
  static_assert(kThen[0] == kMinNoisePasses);
  for (const std::uint64_t n : kFirst) {
    if (passes == n) return true;
  }
  for (std::uint64_t n : kThen) {
    while (n < passes) n *= 2;
    if (passes == n) return true;
  }
  return false;
}

}  // namespace

void NoiseWatch::look(const Film& film) {
  if (!isLook(film.passes())) return;
  FilmState now{film.passes(), film.mean(), film.standardError()};
  if (now.passes >= kMinNoisePasses) noise_ = estimateNoise(earlier_.front(), now);
  earlier_.push_back(std::move(now));
  if (earlier_.size() > 3) earlier_.pop_front();
}

}  // namespace cellcut
