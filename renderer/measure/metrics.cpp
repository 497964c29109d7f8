#include "renderer/measure/metrics.h"

#include "renderer/base/relative_error.h"
#include "renderer/base/srgb.h"
#include "renderer/base/tone_map.h"
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

/// 0/0 is a black pixel that is right, whatever ε.
double ratio(double square, double scale) {
  return square == 0 ? 0 : square / scale;
}

double meanOf(const Image<float>& image) {
  return meanOverPixels(image.width(), image.height(),
                        [&](int x, int y) { return static_cast<double>(image.at(x, y)); });
}

/// Linear light of the display that shows the picture.
ImageRgb displayed(const ImageRgb& image) {
  ImageRgb result(image.width(), image.height());
  tbb::parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const Vec3 encoded = toneMap(image.at(x, y));
      for (int c = 0; c < 3; ++c) result.at(x, y)[c] = srgbToLinear(encoded[c]);
    }
  });
  return result;
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
  result.epsilon = kRelativeEpsilon * result.meanB * result.meanB;
  result.mse = meanOverPixels(width, height, [&](int x, int y) { return channelMean(squares(x, y)); });
  result.relmse = meanOverPixels(width, height, [&](int x, int y) {
    const glm::dvec3 square = squares(x, y);
    const glm::dvec3 scale = glm::dvec3(b.at(x, y)) * glm::dvec3(b.at(x, y)) + result.epsilon;
    return channelMean({ratio(square.x, scale.x), ratio(square.y, scale.y), ratio(square.z, scale.z)});
  });
  const double smallest = 0.01 * std::abs(result.meanB);
  result.smape = meanOverPixels(width, height, [&](int x, int y) {
    const glm::dvec3 p(a.at(x, y)), q(b.at(x, y));
    const glm::dvec3 difference = glm::abs(p - q), scale = glm::abs(p) + glm::abs(q) + smallest;
    return channelMean({ratio(difference.x, scale.x), ratio(difference.y, scale.y), ratio(difference.z, scale.z)});
  });
  result.flip = withFlip ? meanOf(flipHdr(a, b)) : std::numeric_limits<double>::quiet_NaN();
  result.flipLdr = withFlip ? meanOf(flipLdr(displayed(a), displayed(b))) : std::numeric_limits<double>::quiet_NaN();
  result.maxAbs = largestDifference(a, b);
  return result;
}

}  // namespace

ImageComparison compareImages(const ImageRgb& a, const ImageRgb& b) {
  return compare(a, b, true);
}

double referenceError(const ImageRgb& a, const ImageRgb& b, const ImageRgb& reference) {
  assert(a.size() == b.size() && a.size() == reference.size() && !a.empty());
  const double mean = meanOf(reference), epsilon = kRelativeEpsilon * mean * mean;
  return meanOverPixels(reference.width(), reference.height(), [&](int x, int y) {
    const glm::dvec3 r(reference.at(x, y));
    const glm::dvec3 product = (glm::dvec3(a.at(x, y)) - r) * (glm::dvec3(b.at(x, y)) - r), scale = r * r + epsilon;
    return channelMean({ratio(product.x, scale.x), ratio(product.y, scale.y), ratio(product.z, scale.z)});
  });
}

ImageComparison compareImagesOnThisThread(const ImageRgb& a, const ImageRgb& b, bool withFlip) {
  tbb::task_arena alone(1);
  return alone.execute([&] { return compare(a, b, withFlip); });
}

}  // namespace cellcut
