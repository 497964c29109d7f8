/// \file gui_style.h
/// How our windows look: dark, quiet, readable; and the font.
#pragma once

struct ImFontAtlas;
struct ImGuiStyle;

namespace cellcut {

/// The style of the whole program at `scale` (GuiSettings).
void setStyle(ImGuiStyle& style, float scale);

/// DejaVu Sans of the Debian package fonts-dejavu-core with Latin, Greek, arrows and mathematical signs; where it is not
/// installed ImGui's own font, ASCII only, scaled.
void addFont(ImFontAtlas& atlas, float scale);

}  // namespace cellcut
