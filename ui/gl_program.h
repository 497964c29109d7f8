/// \file gl_program.h
/// A vertex and a fragment shader, linked.
#pragma once

#include "renderer/base/math.h"
#include "ui/gl_handle.h"

#include <initializer_list>
#include <string_view>

namespace cellcut {

class GlProgram {
 public:
  /// Files of assets/shaders, which are compiled into the program: GlProgram("image.vert", {"picture.frag", "texel.frag"}).
  /// \throws GlError with the compiler's log, whose first number is the file's line
  GlProgram(std::string_view vertexFile, std::initializer_list<std::string_view> fragmentFiles);
  /// The same from text; `name` is for messages.
  static GlProgram fromText(std::string_view name, std::string_view vertexText, std::string_view fragmentText);

  void use() const;
  // \pre in use. A name that the shader does not use is passed over, as OpenGL does.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const Vec2& value) const;

 private:
  explicit GlProgram(GlProgramHandle handle) : handle_(std::move(handle)) {}
  int location(const char* uniform) const;

  GlProgramHandle handle_;
};

/// The text of a file of assets/shaders. \pre it exists
std::string_view shaderText(std::string_view file);

}  // namespace cellcut
