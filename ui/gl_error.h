/// \file gl_error.h
/// What the graphics system refuses.
#pragma once

#include <stdexcept>
#include <string>

namespace cellcut {

/// No display, no driver, a shader that does not compile, a picture larger than the driver takes. what() says which and
/// repeats the driver's own words.
class GlError : public std::runtime_error {
 public:
  explicit GlError(const std::string& what) : std::runtime_error(what) {}
};

/// Where OpenGL has recorded errors since the last call, takes them all.
/// \throws GlError "`where`: GL_INVALID_VALUE" if there were any.
void checkGl(const char* where);

}  // namespace cellcut
