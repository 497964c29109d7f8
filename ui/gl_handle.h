/// \file gl_handle.h
/// Owners of OpenGL's names. The context that made an object must be current when its owner dies.
#pragma once

#include <utility>

namespace cellcut {

/// `destroy` deletes a name that is not 0.
template <void (*destroy)(unsigned)>
class GlHandle {
 public:
  GlHandle() = default;
  explicit GlHandle(unsigned name) : name_(name) {}
  GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlHandle() {
    if (name_ != 0) destroy(name_);
  }

  unsigned name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  unsigned name_ = 0;
};

void deleteGlTexture(unsigned name);
void deleteGlFramebuffer(unsigned name);
void deleteGlProgram(unsigned name);
void deleteGlShader(unsigned name);
void deleteGlVertexArray(unsigned name);
void deleteGlBuffer(unsigned name);

using GlTextureHandle = GlHandle<deleteGlTexture>;
using GlFramebufferHandle = GlHandle<deleteGlFramebuffer>;
using GlProgramHandle = GlHandle<deleteGlProgram>;
using GlShaderHandle = GlHandle<deleteGlShader>;
using GlVertexArrayHandle = GlHandle<deleteGlVertexArray>;
using GlBufferHandle = GlHandle<deleteGlBuffer>;

GlVertexArrayHandle makeGlVertexArray();
GlBufferHandle makeGlBuffer();

}  // namespace cellcut
