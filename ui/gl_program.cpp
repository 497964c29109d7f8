#include "ui/gl_program.h"

#include "ui/gl_error.h"

#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace cellcut {

namespace {

GlShaderHandle compile(GLenum stage, std::string_view name, std::string_view text) {
  GlShaderHandle shader(glCreateShader(stage));
  const char* const start = text.data();
  const auto length = static_cast<GLint>(text.size());
  glShaderSource(shader.name(), 1, &start, &length);
  glCompileShader(shader.name());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  GLint size = 0;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(size), '\0');
  glGetShaderInfoLog(shader.name(), size, &size, log.data());
  log.resize(static_cast<std::size_t>(size));
  throw GlError(std::string(name) + ": does not compile: " + log);
}

GlProgramHandle link(std::string_view name, const std::vector<GlShaderHandle>& shaders) {
  GlProgramHandle program(glCreateProgram());
  for (const GlShaderHandle& shader : shaders) glAttachShader(program.name(), shader.name());
  glLinkProgram(program.name());
  for (const GlShaderHandle& shader : shaders) glDetachShader(program.name(), shader.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  GLint size = 0;
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(size), '\0');
  glGetProgramInfoLog(program.name(), size, &size, log.data());
  log.resize(static_cast<std::size_t>(size));
  throw GlError(std::string(name) + ": does not link: " + log);
}

}  // namespace

GlProgram::GlProgram(std::string_view vertexFile, std::initializer_list<std::string_view> fragmentFiles) {
  std::vector<GlShaderHandle> shaders;
  shaders.push_back(compile(GL_VERTEX_SHADER, vertexFile, shaderText(vertexFile)));
  for (const std::string_view file : fragmentFiles)
    shaders.push_back(compile(GL_FRAGMENT_SHADER, file, shaderText(file)));
  handle_ = link(*fragmentFiles.begin(), shaders);
}

GlProgram GlProgram::fromText(std::string_view name, std::string_view vertexText, std::string_view fragmentText) {
  std::vector<GlShaderHandle> shaders;
  shaders.push_back(compile(GL_VERTEX_SHADER, name, vertexText));
  shaders.push_back(compile(GL_FRAGMENT_SHADER, name, fragmentText));
  return GlProgram(link(name, shaders));
}

void GlProgram::use() const {
  glUseProgram(handle_.name());
}

void GlProgram::set(const char* uniform, int value) const {
  glUniform1i(location(uniform), value);
}
void GlProgram::set(const char* uniform, float value) const {
  glUniform1f(location(uniform), value);
}
void GlProgram::set(const char* uniform, const Vec2& value) const {
  glUniform2f(location(uniform), value.x, value.y);
}

int GlProgram::location(const char* uniform) const {
  return glGetUniformLocation(handle_.name(), uniform);
}

}  // namespace cellcut
