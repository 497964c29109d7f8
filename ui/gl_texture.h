/// \file gl_texture.h
/// Pictures on the side of the graphics system; row 0 is the top of the picture.
#pragma once

#include "renderer/base/image_io.h"
#include "ui/gl_handle.h"
#include "ui/pixel_size.h"

#include <span>

namespace cellcut {

/// A two-dimensional texture without mip levels, edges clamped, magnified as squares.
class GlTexture {
 public:
  GlTexture() = default;

  /// Linear RGB, 32-bit float, row-major. The storage is kept while the size stays.
  /// \pre pixels.size() = size.width · size.height, \throws GlError if the driver does not take this size
  void upload(PixelSize size, std::span<const Vec3> pixels);
  /// The same with 8-bit RGBA, as it is.
  void upload(const ImageRgba8& image);
  /// 8-bit RGBA of undefined content.
  void allocate(PixelSize size);
  void bind(int unit) const;

  bool empty() const { return size_.empty(); }
  PixelSize size() const { return size_; }
  unsigned name() const { return handle_.name(); }

 private:
  enum class Format { kNone, kRgb32f, kRgba8 };
  void store(PixelSize size, Format format, const void* pixels);

  GlTextureHandle handle_;
  PixelSize size_;
  Format format_ = Format::kNone;
};

}  // namespace cellcut
