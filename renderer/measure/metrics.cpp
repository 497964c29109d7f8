#include "renderer/measure/metrics.h"

#include "renderer/measure/flip.h"

#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace cellcut {

namespace {

/// Mean over the pixels of a double per pixel. Rows are summed apart and then in order: the same on any number of
/// threads.
template <class Function>
double meanOverPixels(int width, int height, const Function& function) {
  std::vector<double> rows(static_cast<std::size_t>(height), 0.0);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) rows[static_cast<std::size_t>(y)] += function(x, y);
  });
  double total = 0;
  for (const double row : rows) total += row;
  return total / (static_cast<double>(width) * height);
}

double channelMean(const glm::dvec3& v) {
  return (v.x + v.y + v.z) / 3;
}

double meanOf(const ImageRgb& image) {
  return meanOverPixels(image.width(), image.height(), [&](int x, int y) { return channelMean(image.at(x, y)); });
}

double meanFlip(const ImageRgb& a, const ImageRgb& b) {
  const Image<float> flip = flipHdr(a, b);
  return meanOverPixels(a.width(), a.height(), [&](int x, int y) { return static_cast<double>(flip.at(x, y)); });
}

/// 0/0 is a black pixel that is right, whatever ε.
double ratio(double square, double scale) {
  return square == 0 ? 0 : square / scale;
}

/// NaN when any difference is.
double largestDifference(const ImageRgb& a, const ImageRgb& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(static_cast<double>(a[i][c]) - b[i][c]);
      if (std::isnan(difference)) return difference;
      largest = std::max(largest, difference);
    }
  }
  return largest;
}

ImageComparison compare(const ImageRgb& a, const ImageRgb& b, bool withFlip) {
  assert(a.width() == b.width() && a.height() == b.height() && !a.empty());
  const int width = a.width(), height = a.height();
  const auto squares = [&](int x, int y) {
    const glm::dvec3 difference = glm::dvec3(a.at(x, y)) - glm::dvec3(b.at(x, y));
    return difference * difference;
  };
  ImageComparison result;
  result.meanA = meanOf(a);
  result.meanB = meanOf(b);
  result.epsilon = 0.01 * result.meanB * result.meanB;
  result.mse = meanOverPixels(width, height, [&](int x, int y) { return channelMean(squares(x, y)); });
  result.relmse = meanOverPixels(width, height, [&](int x, int y) {
    const glm::dvec3 square = squares(x, y);
    const glm::dvec3 scale = glm::dvec3(b.at(x, y)) * glm::dvec3(b.at(x, y)) + result.epsilon;
    return channelMean({ratio(square.x, scale.x), ratio(square.y, scale.y), ratio(square.z, scale.z)});
  });
  result.flip = withFlip ? meanFlip(a, b) : std::numeric_limits<double>::quiet_NaN();
  result.maxAbs = largestDifference(a, b);
  return result;
}

}  // namespace

ImageComparison compareImages(const ImageRgb& a, const ImageRgb& b) {
  return compare(a, b, true);
}

ImageComparison compareImagesOnThisThread(const ImageRgb& a, const ImageRgb& b, bool withFlip) {
  tbb::task_arena alone(1);
  return alone.execute([&] { return compare(a, b, withFlip); });
}

}  // namespace cellcut
