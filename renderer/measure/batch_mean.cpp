#include "renderer/measure/batch_mean.h"

#include "renderer/base/relative_error.h"

#include <cmath>

namespace cellcut {

void BatchMean::add(const ImageRgb& batch) {
  const auto n = static_cast<double>(++count);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double x = batch[i][c], before = x - mean[i][c];
      const double after = mean[i][c] + before / n, spread = deviation[i][c];
      mean[i][c] = static_cast<float>(after);
      deviation[i][c] = static_cast<float>(std::sqrt(spread * spread + before * (x - after)));
    }
  }
}

double BatchMean::relmse() const {
  const double whole = meanOfChannels(mean);
  const auto n = static_cast<double>(count);
  double sum = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double value = mean[i][c], spread = deviation[i][c];
      if (spread > 0) sum += spread * spread / (n * (n - 1)) / (value * value + kRelativeEpsilon * whole * whole);
    }
  }
  return sum / (3 * static_cast<double>(mean.size()));
}

}  // namespace cellcut
