#include "ui/gl_error.h"

#include <epoxy/gl.h>

namespace cellcut {

namespace {

std::string errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "OpenGL error " + std::to_string(error);
  }
}

}  // namespace

void checkGl(const char* where) {
  std::string errors;
  // A driver without a context, or whose context is lost, reports the same error for ever.
  constexpr int kMostErrors = 8;
  for (int i = 0; i < kMostErrors; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (!errors.empty()) errors += ", ";
    errors += errorName(error);
  }
  if (!errors.empty()) throw GlError(std::string(where) + ": " + errors);
}

}  // namespace cellcut
