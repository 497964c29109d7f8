/// \file image.h
/// A rectangle of pixels in memory. Files: image_io.h.
#pragma once

#include "renderer/base/math.h"

#include <cassert>
#include <cstddef>
#include <vector>

namespace cellcut {

/// Row-major pixels, the first row at the top.
template <class Pixel>
class Image {
 public:
  using value_type = Pixel;

  Image() = default;
  Image(int width, int height, const Pixel& fill = Pixel{})
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  std::size_t size() const { return pixels_.size(); }
  std::size_t bytes() const { return pixels_.capacity() * sizeof(Pixel); }

  Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }
  Pixel& operator[](std::size_t i) { return pixels_[i]; }
  const Pixel& operator[](std::size_t i) const { return pixels_[i]; }

  auto begin() { return pixels_.begin(); }
  auto end() { return pixels_.end(); }
  auto begin() const { return pixels_.begin(); }
  auto end() const { return pixels_.end(); }
  Pixel* data() { return pixels_.data(); }
  const Pixel* data() const { return pixels_.data(); }

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> pixels_;
};

using ImageRgb = Image<Vec3>;  ///< linear Rec. 709, 32-bit float

/// Mean over pixels and channels. \pre not empty
inline double meanOfChannels(const ImageRgb& image) {
  double sum = 0;
  for (const Vec3& p : image) sum += (static_cast<double>(p.x) + p.y + p.z) / 3;
  return sum / static_cast<double>(image.size());
}

}  // namespace cellcut
