/// \file gl_framebuffer.h
/// Where everything is drawn: 8-bit RGBA, sRGB-encoded by who draws. Nothing tests depth.
///
/// OpenGL's row 0 is the bottom of this picture: viewports and scissors count from below, read() from the top.
#pragma once

#include "renderer/base/image_io.h"
#include "ui/gl_handle.h"
#include "ui/gl_texture.h"
#include "ui/pixel_size.h"

namespace cellcut {

class GlFramebuffer {
 public:
  /// \throws GlError if the driver cannot draw to this size. \pre not empty
  explicit GlFramebuffer(PixelSize size);

  /// Drawing goes here, to all of it.
  void bind() const;
  /// bind() and one colour (sRGB-encoded) everywhere.
  void clear(const Vec4& color) const;
  /// What it holds, opaque: what lies under the window's pixels does not shine through a PNG.
  ImageRgba8 read() const;

  PixelSize size() const { return color_.size(); }
  unsigned name() const { return handle_.name(); }

 private:
  GlFramebufferHandle handle_;
  GlTexture color_;
};

}  // namespace cellcut
