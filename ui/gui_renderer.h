/// \file gui_renderer.h
/// Draws ImGui's triangles by our own GL handles.
///
/// ImGui's OpenGL 3 back end takes its entry points from libGL.so.1 only, so it cannot draw with OSMesa, and its
/// saving and restoring of all state costs more calls than the drawing itself.
#pragma once

#include "ui/gl_handle.h"
#include "ui/gl_program.h"
#include "ui/gl_texture.h"

struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace cellcut {

/// \pre the window's context is current, in every member
class GuiRenderer {
 public:
  /// Builds the atlas, uploads it and notes its texture in it. ImGui's texture ids are names of GL textures.
  explicit GuiRenderer(ImFontAtlas& atlas);

  /// Into the bound framebuffer, whose viewport is data.DisplaySize. State afterwards: Gui::endFrame.
  void draw(const ImDrawData& data) const;

 private:
  void drawList(const ImDrawData& data, const ImDrawList& list) const;

  GlProgram program_;
  GlTexture font_;
  GlVertexArrayHandle layout_;
  GlBufferHandle vertices_;
  GlBufferHandle indices_;
};

}  // namespace cellcut
