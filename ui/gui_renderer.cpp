#include "ui/gui_renderer.h"

#include "ui/gl_error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <epoxy/gl.h>
#include <imgui.h>

namespace cellcut {

namespace {

void describeVertices() {
  const auto attribute = [](GLuint index, GLint count, GLenum type, GLboolean normalized, std::size_t offset) {
    glEnableVertexAttribArray(index);
    // OpenGL passes the offset into the buffer as a pointer.
    const auto* const pointer = reinterpret_cast<const void*>(offset);  // NOLINT(performance-no-int-to-ptr)
    glVertexAttribPointer(index, count, type, normalized, sizeof(ImDrawVert), pointer);
  };
  attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
  attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
  attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
}

template <class T>
void fill(GLenum target, const ImVector<T>& values) {
  glBufferData(target, static_cast<GLsizeiptr>(static_cast<std::size_t>(values.Size) * sizeof(T)), values.Data,
               GL_STREAM_DRAW);
}

ImTextureID textureId(unsigned name) {
  return (ImTextureID) static_cast<std::intptr_t>(name);  // NOLINT: a pointer or an integer, as ImGui's version has it
}
unsigned textureName(ImTextureID id) {
  return static_cast<unsigned>((std::intptr_t)id);
}

}  // namespace

GuiRenderer::GuiRenderer(ImFontAtlas& atlas)
    : program_("gui.vert", {"gui.frag"}),
      layout_(makeGlVertexArray()),
      vertices_(makeGlBuffer()),
      indices_(makeGlBuffer()) {
  unsigned char* texels = nullptr;
  PixelSize size;
  atlas.GetTexDataAsRGBA32(&texels, &size.width, &size.height);
  ImageRgba8 image(size.width, size.height);
  static_assert(sizeof(ImageRgba8::value_type) == 4);
  std::memcpy(image.data(), texels, image.size() * 4);
  font_.upload(image);
  glBindTexture(GL_TEXTURE_2D, font_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);  // ImGui smooths its lines by it
  glBindTexture(GL_TEXTURE_2D, 0);
  atlas.SetTexID(textureId(font_.name()));
  atlas.ClearTexData();

  glBindVertexArray(layout_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  describeVertices();
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  checkGl("preparing the user interface");
}

void GuiRenderer::draw(const ImDrawData& data) const {
  if (data.DisplaySize.x <= 0 || data.DisplaySize.y <= 0) return;
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("framebufferSize", Vec2(data.DisplaySize.x, data.DisplaySize.y));
  program_.set("image", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(layout_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());

  for (int i = 0; i < data.CmdListsCount; ++i) drawList(data, *data.CmdLists[i]);

  glBindBuffer(GL_ARRAY_BUFFER, 0);
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
  checkGl("drawing the user interface");
}

void GuiRenderer::drawList(const ImDrawData& data, const ImDrawList& list) const {
  fill(GL_ARRAY_BUFFER, list.VtxBuffer);
  fill(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer);
  const auto height = static_cast<int>(data.DisplaySize.y);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    // ResetRenderState has nothing to reset: no callback of ours changes any.
    if (command.UserCallback != nullptr) {
      if (command.UserCallback != ImDrawCallback_ResetRenderState) command.UserCallback(&list, &command);
      continue;
    }
    const int left = std::max(0, static_cast<int>(command.ClipRect.x));
    const int top = std::max(0, static_cast<int>(command.ClipRect.y));
    const auto right = static_cast<int>(command.ClipRect.z);
    const auto bottom = static_cast<int>(command.ClipRect.w);
    if (right <= left || bottom <= top) continue;
    glScissor(left, height - bottom, right - left, bottom - top);
    glBindTexture(GL_TEXTURE_2D, textureName(command.GetTexID()));
    const auto* const first =
        reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx));  // NOLINT(performance-no-int-to-ptr)
    glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                             sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT, first,
                             static_cast<GLint>(command.VtxOffset));
  }
}

}  // namespace cellcut
