#include "ui/gui_style.h"

#include <cmath>
#include <filesystem>
#include <string_view>

#include <imgui.h>

namespace cellcut {

namespace {

constexpr float kTextHeight = 15;     // pixels at scale 1
constexpr float kBuiltInHeight = 13;  // what ImGui's own font is drawn for

/// Where Debian, Fedora and Arch install them.
constexpr std::string_view kFontFolders[] = {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
                                             "/usr/share/fonts/TTF"};

void setColors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  const ImVec4 accent(0.24f, 0.52f, 0.70f, 1);
  const auto faded = [&accent](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
  ImVec4* const colors = style.Colors;
  colors[ImGuiCol_Text] = ImVec4(0.92f, 0.92f, 0.93f, 1);
  colors[ImGuiCol_TextDisabled] = ImVec4(0.60f, 0.61f, 0.63f, 1);
  colors[ImGuiCol_WindowBg] = ImVec4(0.11f, 0.115f, 0.125f, 0.97f);
  colors[ImGuiCol_PopupBg] = ImVec4(0.13f, 0.135f, 0.145f, 0.98f);
  colors[ImGuiCol_Border] = ImVec4(0.28f, 0.29f, 0.31f, 1);
  colors[ImGuiCol_FrameBg] = ImVec4(0.20f, 0.21f, 0.23f, 1);
  colors[ImGuiCol_FrameBgHovered] = ImVec4(0.26f, 0.28f, 0.31f, 1);
  colors[ImGuiCol_FrameBgActive] = ImVec4(0.29f, 0.33f, 0.38f, 1);
  colors[ImGuiCol_TitleBg] = ImVec4(0.09f, 0.095f, 0.10f, 1);
  colors[ImGuiCol_TitleBgActive] = ImVec4(0.14f, 0.19f, 0.23f, 1);
  colors[ImGuiCol_MenuBarBg] = ImVec4(0.14f, 0.145f, 0.155f, 1);
  colors[ImGuiCol_CheckMark] = ImVec4(0.45f, 0.75f, 0.92f, 1);
  colors[ImGuiCol_SliderGrab] = accent;
  colors[ImGuiCol_SliderGrabActive] = ImVec4(0.35f, 0.65f, 0.84f, 1);
  colors[ImGuiCol_Button] = ImVec4(0.23f, 0.25f, 0.28f, 1);
  colors[ImGuiCol_ButtonHovered] = faded(0.75f);
  colors[ImGuiCol_ButtonActive] = accent;
  colors[ImGuiCol_Header] = faded(0.35f);
  colors[ImGuiCol_HeaderHovered] = faded(0.60f);
  colors[ImGuiCol_HeaderActive] = faded(0.80f);
  colors[ImGuiCol_Tab] = ImVec4(0.16f, 0.18f, 0.20f, 1);
  colors[ImGuiCol_TabHovered] = faded(0.80f);
  colors[ImGuiCol_TableHeaderBg] = ImVec4(0.17f, 0.18f, 0.20f, 1);
}

}  // namespace

void setStyle(ImGuiStyle& style, float scale) {
  style = ImGuiStyle();
  setColors(style);
  style.WindowRounding = 4;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.PopupRounding = 3;
  style.ScrollbarRounding = 4;
  style.WindowPadding = ImVec2(10, 8);
  style.FramePadding = ImVec2(6, 3);
  style.ItemSpacing = ImVec2(8, 5);
  style.ScaleAllSizes(scale);
}

void addFont(ImFontAtlas& atlas, float scale) {
  // Pairs of first and last, then 0. The atlas keeps the pointer until it is built.
  static constexpr ImWchar kRanges[] = {0x0020, 0x00FF,  // Latin
                                        0x0370, 0x03FF,  // Greek
                                        0x2010, 0x2027,  // dashes, quotes, ellipsis
                                        0x2070, 0x209F,  // superscripts, subscripts
                                        0x2190, 0x21FF,  // arrows
                                        0x2200, 0x22FF,  // mathematics
                                        0x25A0, 0x25FF,  // squares, triangles, circles
                                        0x2600, 0x26FF,  // signs, the warning among them
                                        0};
  for (const std::string_view folder : kFontFolders) {
    const std::filesystem::path path = std::filesystem::path(folder) / "DejaVuSans.ttf";
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) continue;
    atlas.AddFontFromFileTTF(path.c_str(), std::round(kTextHeight * scale), nullptr, kRanges);
    return;
  }
  ImFontConfig config;
  config.SizePixels = std::round(kBuiltInHeight * scale);
  atlas.AddFontDefault(&config);
}

}  // namespace cellcut
