#include "ui/gl_handle.h"

#include <epoxy/gl.h>

namespace cellcut {

void deleteGlTexture(unsigned name) {
  glDeleteTextures(1, &name);
}
void deleteGlFramebuffer(unsigned name) {
  glDeleteFramebuffers(1, &name);
}
void deleteGlProgram(unsigned name) {
  glDeleteProgram(name);
}
void deleteGlShader(unsigned name) {
  glDeleteShader(name);
}
void deleteGlVertexArray(unsigned name) {
  glDeleteVertexArrays(1, &name);
}
void deleteGlBuffer(unsigned name) {
  glDeleteBuffers(1, &name);
}

GlVertexArrayHandle makeGlVertexArray() {
  unsigned name = 0;
  glGenVertexArrays(1, &name);
  return GlVertexArrayHandle(name);
}

GlBufferHandle makeGlBuffer() {
  unsigned name = 0;
  glGenBuffers(1, &name);
  return GlBufferHandle(name);
}

}  // namespace cellcut
