/// \file convolution.h
/// Separable filters over planes of floats; beyond the border the nearest pixel continues.
#pragma once

#include "renderer/base/image.h"

#include <vector>

namespace cellcut {

using Plane = Image<float>;

/// Odd number of weights, the middle one on the pixel itself; weight i meets the neighbour at offset i − radius().
struct Kernel {
  std::vector<float> weights;

  int radius() const { return static_cast<int>(weights.size() / 2); }
};

/// Filters rows with `horizontal`, then columns with `vertical`. Parallel over rows; the same sums on any number of
/// threads.
Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical);

}  // namespace cellcut
