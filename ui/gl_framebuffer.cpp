#include "ui/gl_framebuffer.h"

#include "ui/gl_error.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>

namespace cellcut {

GlFramebuffer::GlFramebuffer(PixelSize size) {
  color_.allocate(size);
  unsigned name = 0;
  glGenFramebuffers(1, &name);
  handle_ = GlFramebufferHandle(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.name(), 0);
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  checkGl("framebuffer");
  if (status != GL_FRAMEBUFFER_COMPLETE) throw GlError("framebuffer: incomplete, status " + std::to_string(status));
}

void GlFramebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
  glViewport(0, 0, size().width, size().height);
}

void GlFramebuffer::clear(const Vec4& color) const {
  bind();
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(color.r, color.g, color.b, color.a);
  glClear(GL_COLOR_BUFFER_BIT);
}

ImageRgba8 GlFramebuffer::read() const {
  ImageRgba8 image(size().width, size().height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width(), image.height(), GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  checkGl("reading a framebuffer");
  for (int y = 0; y < image.height() / 2; ++y) {
    auto* const row = &image.at(0, y);
    std::swap_ranges(row, row + image.width(), &image.at(0, image.height() - 1 - y));
  }
  for (auto& pixel : image) pixel.a = 255;
  return image;
}

}  // namespace cellcut
