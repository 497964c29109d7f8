#include "renderer/measure/convolution.h"

#include <algorithm>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cellcut {

namespace {

void addScaled(std::span<float> sum, float weight, const float* values) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
}

std::span<float> rowOf(Plane& plane, int y) {
  return {&plane.at(0, y), static_cast<std::size_t>(plane.width())};
}

template <class Function>
void forEachRow(int height, const Function& function) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) function(y);
  });
}

Plane filterRows(const Plane& plane, const Kernel& kernel) {
  Plane filtered(plane.width(), plane.height());
  forEachRow(plane.height(), [&](int y) {
    const float* row = &plane.at(0, y);
    std::vector<float> padded(static_cast<std::size_t>(plane.width() + 2 * kernel.radius()));
    for (int x = 0; x < static_cast<int>(padded.size()); ++x) {
      padded[static_cast<std::size_t>(x)] = row[std::clamp(x - kernel.radius(), 0, plane.width() - 1)];
    }
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
      addScaled(rowOf(filtered, y), kernel.weights[i], padded.data() + i);
    }
  });
  return filtered;
}

Plane filterColumns(const Plane& plane, const Kernel& kernel) {
  Plane filtered(plane.width(), plane.height());
  forEachRow(plane.height(), [&](int y) {
    for (int i = 0; i < static_cast<int>(kernel.weights.size()); ++i) {
      const int source = std::clamp(y + i - kernel.radius(), 0, plane.height() - 1);
      addScaled(rowOf(filtered, y), kernel.weights[static_cast<std::size_t>(i)], &plane.at(0, source));
    }
  });
  return filtered;
}

}  // namespace

Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) {
  return filterColumns(filterRows(plane, horizontal), vertical);
}

}  // namespace cellcut
