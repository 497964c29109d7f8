/// \file canvas.h
/// A window without a display and a framebuffer as large: where the tests of ui/ draw.
#pragma once

#include "ui/gl_framebuffer.h"
#include "ui/image_view.h"
#include "ui/window.h"

#include <memory>

namespace cellcut::test {

using Rgba8 = ImageRgba8::value_type;

struct Canvas {
  explicit Canvas(PixelSize size, WindowKind kind = WindowKind::kEgl)
      : window(openWindow(kind, {.size = size})), framebuffer(size) {
    framebuffer.clear(Vec4(0, 0, 0, 1));
  }

  /// What `view` draws at `placement` on black.
  ImageRgba8 draw(const ImageView& view, const ImagePlacement& placement, const ImageViewSettings& settings = {}) {
    const PixelSize size = framebuffer.size();
    framebuffer.clear(Vec4(0, 0, 0, 1));
    view.draw(size, {Vec2(0), Vec2(size.width, size.height)}, placement, settings);
    return framebuffer.read();
  }

  std::unique_ptr<Window> window;  // outlives what is drawn with
  GlFramebuffer framebuffer;
};

}  // namespace cellcut::test
