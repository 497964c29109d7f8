#include "renderer/trace/noise.h"

#include "renderer/base/relative_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cellcut {
namespace {

/// The standard normal's quantile at 0.97.
constexpr double kNormalQuantile = 1.8808;

double square(double x) {
  return x * x;
}

/// Samples of one channel of one pixel.
struct Moments {
  double n, mean, squares;  ///< squares: Σ (x − mean)²
};

Moments momentsOf(const FilmState& state, std::size_t pixel, int channel, double scale) {
  const auto n = static_cast<double>(state.passes);
  return {n, scale * state.mean[pixel][channel], square(scale * state.standardError[pixel][channel]) * n * (n - 1)};
}

/// What is left of the whole without the part. Source: Chan, Golub, LeVeque 1979, the update of two sums, undone.
Moments rest(const Moments& whole, const Moments& part) {
  const double n = whole.n - part.n;
  const double mean = (whole.n * whole.mean - part.n * part.mean) / n;
  const double between = square(mean - part.mean) * n * part.n / whole.n;
  return {n, mean, std::max(0.0, whole.squares - part.squares - between)};
}

/// Expected relative squared error of the whole's mean, in a picture whose mean is 1.
double expectedError(const Moments& part, const Moments& whole) {
  const Moments other = rest(whole, part);
  const auto across = [&](const Moments& variance, const Moments& mean) {
    return variance.squares / ((variance.n - 1) * (square(mean.mean) + kRelativeEpsilon));
  };
  return 0.5 * (across(part, other) + across(other, part)) / whole.n;
}

}  // namespace

NoiseEstimate estimateNoise(const FilmState& part, const FilmState& whole) {
  assert(part.passes >= 2 && whole.passes >= part.passes + 2 && part.mean.size() == whole.mean.size());
  const double unit = meanOfChannels(whole.mean);
  if (!(unit > 0)) return {0, 0};
  const double scale = 1 / unit;  // squares neither overflow nor vanish
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < whole.mean.size(); ++i) {
    double q = 0;  // of a pixel: its channels share their noise
    for (int c = 0; c < 3; ++c) q += expectedError(momentsOf(part, i, c, scale), momentsOf(whole, i, c, scale)) / 3;
    sum += q;
    squares += q * q;
  }
  const auto pixels = static_cast<double>(whole.mean.size());
  return {std::sqrt(sum / pixels), std::sqrt((sum + kNormalQuantile * std::sqrt(3 * squares)) / pixels)};
}

}  // namespace cellcut
