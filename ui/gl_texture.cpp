#include "ui/gl_texture.h"

#include "ui/gl_error.h"

#include <cassert>
#include <string>

#include <epoxy/gl.h>

namespace cellcut {

namespace {

GlTextureHandle makeTexture() {
  unsigned name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return GlTextureHandle(name);
}

void checkSize(PixelSize size) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (size.width > most || size.height > most)
    throw GlError("a texture of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                  " pixels: the driver takes at most " + std::to_string(most) + " each way");
}

}  // namespace

void GlTexture::upload(PixelSize size, std::span<const Vec3> pixels) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  assert(pixels.size() == static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  store(size, Format::kRgb32f, pixels.data());
}

void GlTexture::upload(const ImageRgba8& image) {
  store({image.width(), image.height()}, Format::kRgba8, image.data());
}

void GlTexture::allocate(PixelSize size) {
  store(size, Format::kRgba8, nullptr);
}

void GlTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glActiveTexture(GL_TEXTURE0);
}

void GlTexture::store(PixelSize size, Format format, const void* pixels) {
  assert(!size.empty());
  checkSize(size);
  if (!handle_) handle_ = makeTexture();
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const bool isFloat = format == Format::kRgb32f;
  const GLenum layout = isFloat ? GL_RGB : GL_RGBA;
  const GLenum type = isFloat ? GL_FLOAT : GL_UNSIGNED_BYTE;
  if (size == size_ && format == format_) {
    if (pixels != nullptr) glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, layout, type, pixels);
  } else {
    const GLint stored = isFloat ? GL_RGB32F : GL_RGBA8;
    glTexImage2D(GL_TEXTURE_2D, 0, stored, size.width, size.height, 0, layout, type, pixels);
    size_ = size;
    format_ = format;
  }
  glBindTexture(GL_TEXTURE_2D, 0);
  checkGl("texture upload");
}

}  // namespace cellcut
