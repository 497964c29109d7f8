/// \file pixel_size.h
/// Sizes and rectangles in pixels.
#pragma once

#include "renderer/base/math.h"

namespace cellcut {

/// ≥ 0 each; zero while a window is minimised.
struct PixelSize {
  int width = 0;
  int height = 0;
  bool operator==(const PixelSize&) const = default;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// Framebuffer pixels, origin top left, y down.
struct PixelRect {
  Vec2 origin{0};
  Vec2 size{0};
  bool contains(const Vec2& p) const {
    return p.x >= origin.x && p.y >= origin.y && p.x < origin.x + size.x && p.y < origin.y + size.y;
  }
};

}  // namespace cellcut
