/// \file gui_style.h
/// How our windows look: dark, quiet, readable; and the fonts.
#pragma once

struct ImFont;
struct ImFontAtlas;
struct ImGuiStyle;

namespace cellcut {

/// The style of the whole program at `scale` (GuiSettings).
void setStyle(ImGuiStyle& style, float scale);

struct GuiFonts {
  ImFont* text = nullptr;
  ImFont* monospace = nullptr;
};

/// DejaVu Sans and DejaVu Sans Mono of the Debian package fonts-dejavu-core with Latin, Greek, arrows and mathematical
/// signs; where they are not installed ImGui's own font, ASCII only, scaled. The first in the atlas is `text`.
GuiFonts addFonts(ImFontAtlas& atlas, float scale);

}  // namespace cellcut
