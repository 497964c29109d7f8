#include "ui/viewer/panels.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <imgui.h>

namespace cellcut {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[128];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

template <class Entries>
constexpr auto namesOf(const Entries& entries) {
  std::array<std::string_view, std::tuple_size_v<std::remove_cvref_t<Entries>>> names{};
  std::transform(entries.begin(), entries.end(), names.begin(), [](const auto& entry) { return entry.name; });
  return names;
}

bool section(const char* title) {
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

template <class Enum>
bool chooseEnum(Widgets& widgets, const char* label, Enum& value, std::span<const std::string_view> names,
                const char* tooltip) {
  int index = static_cast<int>(value);
  if (!widgets.choice(label, index, names, tooltip)) return false;
  value = static_cast<Enum>(index);
  return true;
}

bool hasCuts(Strategy strategy) {
  return strategy == Strategy::kCellCut || strategy == Strategy::kPointCut;
}

void drawSamplerSettings(Widgets& widgets, ViewerState& state) {
  SamplerSettings& s = state.settings.sampler;
  std::array<std::string_view, kQualities.size() + 1> qualities;
  for (std::size_t i = 0; i < kQualities.size(); ++i) qualities[i] = kQualities[i].name;
  qualities.back() = "custom";
  int quality = static_cast<int>(qualityOf(s).value_or(kQualities.size()));
  if (widgets.choice("Quality", quality, qualities,
                     "Presets of the four settings below: what they trade is time per pass against noise per sample") &&
      quality < static_cast<int>(kQualities.size())) {
    const auto [memory, visits] = std::pair(s.cellMemory, s.countVisits);
    s = kQualities[static_cast<std::size_t>(quality)].settings;
    s.cellMemory = memory;
    s.countVisits = visits;
  }
  widgets.slider("Max cut", s.maxCut, 2, kMaxCutSize,
                 "Most clusters of a cut. More: less noise, cells that take longer to make", true);
  widgets.slider("Threshold", s.threshold, 0.0f, 0.1f,
                 "Clusters above this share of a cut's estimate are split. Lower: longer cuts, less noise", true);
  if (state.settings.strategy == Strategy::kCellCut) {
    widgets.slider("Grid", s.gridResolution, 1, 256,
                   "Cells along the longest axis of what is seen. More: better estimates, more cells to make", true);
  }
  static constexpr std::array<std::string_view, 2> kInCluster{"intensity", "descent"};
  chooseEnum(
      widgets, "In cluster", s.inCluster, kInCluster,
      "How a light is chosen inside a cluster: by intensity (faster), or down the tree by importance (less noise)");
}

template <class T>
void limitField(Widgets& widgets, const char* label, std::optional<T>& limit, const char* tooltip) {
  double value = limit ? static_cast<double>(*limit) : 0;
  if (!widgets.number(label, value, tooltip)) return;
  limit = value > 0 ? std::optional(static_cast<T>(value)) : std::nullopt;
}

/// A share of the work until the nearest limit, and how long it still takes.
std::string remaining(const ViewerState& state, const Snapshot& s) {
  if (s.passes == 0 || s.seconds <= 0) return "";
  double least = std::numeric_limits<double>::infinity();
  const double perPass = s.seconds / static_cast<double>(s.passes);
  if (state.passLimit) {
    least = perPass * (static_cast<double>(*state.passLimit) - static_cast<double>(s.passes));
  }
  if (state.timeLimit) least = std::min(least, *state.timeLimit - s.seconds);
  if (state.noiseLimit && std::isfinite(s.relativeError)) {
    const double ratio = s.relativeError / *state.noiseLimit;
    least = std::min(least, s.seconds * (ratio * ratio - 1));
  }
  if (!std::isfinite(least)) return "";
  return least <= 0 ? "done" : formatted("about %.0f s left", least);
}

}  // namespace

std::optional<std::size_t> qualityOf(const SamplerSettings& s) {
  for (std::size_t i = 0; i < kQualities.size(); ++i) {
    const SamplerSettings& q = kQualities[i].settings;
    if (q.maxCut == s.maxCut && q.threshold == s.threshold && q.gridResolution == s.gridResolution &&
        q.inCluster == s.inCluster) {
      return i;
    }
  }
  return std::nullopt;
}

ViewerCommand drawRenderPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  ViewerCommand command = ViewerCommand::kNone;
  if (!section("Render")) return command;
  RenderSettings& s = state.settings;
  static constexpr auto kNames = namesOf(kStrategies);
  const std::string_view about = kStrategies[static_cast<std::size_t>(s.strategy)].description;
  chooseEnum(widgets, "Strategy", s.strategy, kNames, about.data());
  if (hasCuts(s.strategy)) drawSamplerSettings(widgets, state);
  widgets.slider("Max depth", s.maxDepth, 0, 32, "Times a path may scatter: 0 emitters only, 1 direct light only");
  int seed = static_cast<int>(s.seed);
  if (widgets.slider("Seed", seed, 0, 99, "Another seed, another noise")) s.seed = static_cast<std::uint64_t>(seed);
  limitField(widgets, "Stop at spp", state.passLimit, "Samples per pixel after which rendering rests");
  limitField(widgets, "Stop at s", state.timeLimit, "Seconds after which rendering rests");
  limitField(widgets, "Stop at REL", state.noiseLimit, "Estimated relative error (root of relMSE) at which it rests");
  widgets.checkbox("Pause", state.paused, "P");
  ImGui::SameLine();
  if (widgets.button("Step", "One pass of a paused rendering (.)")) command = ViewerCommand::kSingleStep;
  ImGui::SameLine();
  ImGui::TextUnformatted(remaining(state, facts.snapshot).c_str());
  return command;
}

ViewerCommand drawViewPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  ViewerCommand command = ViewerCommand::kNone;
  if (!section("View")) return command;
  const auto button = [&](const char* label, ViewerCommand what, const char* tooltip) {
    if (widgets.button(label, tooltip)) command = what;
  };
  ImageViewSettings& d = state.display;
  widgets.slider("Exposure", d.exposure, -12, 12, "EV: + and −");
  widgets.checkbox("Tone map", d.toneMap, "Khronos PBR Neutral, else clipped");
  static constexpr std::array<std::string_view, 5> kChannels{"RGB", "red", "green", "blue", "luminance"};
  chooseEnum(widgets, "Channel", d.channel, kChannels, "What is shown");
  std::vector<std::string_view> cameras;
  for (const Camera& camera : facts.scene.cameras) cameras.push_back(camera.name);
  int camera = static_cast<int>(state.settings.camera);
  if (widgets.choice("Camera", camera, cameras, "A camera of the scene")) {
    state.settings.camera = static_cast<std::size_t>(camera);
    state.settings.view.reset();
  }
  button("Reset", ViewerCommand::kResetCamera, "Back to the scene's camera (R)");
  ImGui::SameLine();
  button("Copy", ViewerCommand::kCopyCamera, "The view as JSON (Ctrl+C)");
  ImGui::SameLine();
  button("Paste", ViewerCommand::kPasteCamera, "A view that was copied (Ctrl+V)");
  ImGui::SameLine();
  button("Reload", ViewerCommand::kReload, "The scene's file again (F5)");
  button("Store", ViewerCommand::kStore, "Keep this picture to compare with (T)");
  if (facts.hasStored) {
    ImGui::SameLine();
    button("Forget", ViewerCommand::kForget, "Drop the stored picture");
    widgets.slider("Split", d.split, 0, 1, "Live picture left of it, stored one right; hold B to flip");
  }
  ImGui::SameLine();
  button("Save", ViewerCommand::kSave, "Window as PNG and rendering as EXR (F12)");
  return command;
}

void drawOverlayPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  if (!section("Overlay")) return;
  OverlayChoice& o = state.overlay;
  static constexpr auto kNames = namesOf(kOverlays);
  chooseEnum(widgets, "Show", o.overlay, kNames, describe(o.overlay).description.data());
  widgets.checkbox("Grid cells", o.grid, "Wireframe of the cells that were touched (G)");
  if (facts.overlay && facts.overlay->touched) {
    const TouchedCells& t = *facts.overlay->touched;
    widgets.text("Cells touched",
                 formatted("%zu of %zu (%.1f %%), %zu beyond", t.inside, t.all, 100 * t.share(), t.outside),
                 "By any path vertex; of the cells that cover what the pilot paths saw");
  }
  if (o.overlay == Overlay::kNone) return;
  static constexpr auto kMaps = namesOf(kColormaps);
  chooseEnum(widgets, "Colours", o.scale.colormap, kMaps, "Viridis and magma have even steps");
  static constexpr std::array<std::string_view, 2> kScales{"linear", "log"};
  chooseEnum(widgets, "Scale", o.scale.kind, kScales, "Linear or logarithmic");
  widgets.slider("Opacity", o.opacity, 0, 1, "Of the overlay");
  bool pinned = o.scale.pinned.has_value();
  if (widgets.checkbox("Pin range", pinned, "Keep the range that there is now") && facts.overlay) {
    o.scale.pinned.reset();
    if (pinned) o.scale.pinned = ColorScale(facts.overlay->values, o.scale).range();
  }
  if (facts.overlay && facts.overlay->overlay == o.overlay && facts.overlay->statistics.count > 0) {
    const OverlayStatistics& s = facts.overlay->statistics;
    widgets.text("Range", shortNumber(s.minimum, 3) + " … " + shortNumber(s.maximum, 3));
    widgets.text("Mean", shortNumber(s.mean, 4));
  }
}

void drawStatisticsPanel(Widgets& widgets, const ViewerFacts& facts) {
  if (!section("Statistics")) return;
  const Snapshot& s = facts.snapshot;
  widgets.text("Samples", formatted("%llu spp in %.1f s", static_cast<unsigned long long>(s.passes), s.seconds));
  const double rays = static_cast<double>(s.rays.camera + s.rays.bounce + s.rays.shadow);
  if (s.seconds > 0) widgets.text("Speed", formatted("%.2f Mray/s", rays / s.seconds * 1e-6));
  if (std::isfinite(s.relativeError)) {
    widgets.text("Relative error", formatted("%.4f", s.relativeError), "Estimated from the variance of the samples");
  }
  widgets.text("Picture", formatted("%d x %d%s", s.width, s.height, s.preview ? ", preview" : ""));
  if (s.sampler.cut && s.sampler.grid && s.sampler.grid->touched > 0) {
    widgets.text("Cells made", formatted("%zu", s.sampler.grid->touched));
    widgets.text("Cut size", formatted("%zu … %.0f … %zu", s.sampler.cut->min, s.sampler.cut->mean, s.sampler.cut->max),
                 "Least, mean and most clusters");
    widgets.text("Cells' memory", formatted("%.1f MB", static_cast<double>(s.sampler.cut->bytes) * 1e-6));
  }
  if (s.sampler.tree) {
    widgets.text("Light tree", formatted("%zu nodes, depth %d", s.sampler.tree->nodes, s.sampler.tree->depth));
  }
  if (s.bad.nan + s.bad.inf > 0) {
    widgets.text("Bad samples", formatted("%llu NaN, %llu infinite", static_cast<unsigned long long>(s.bad.nan),
                                          static_cast<unsigned long long>(s.bad.inf)));
  }
}

ViewerCommand drawProblem(Widgets& widgets, const ViewerFacts& facts) {
  if (facts.problem.empty()) return ViewerCommand::kNone;
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
  ImGui::TextWrapped("%s", facts.problem.c_str());
  ImGui::PopStyleColor();
  return widgets.button("Dismiss") ? ViewerCommand::kDismiss : ViewerCommand::kNone;
}

void drawHelp(bool& open) {
  static constexpr std::array<std::array<const char*, 2>, 22> kKeys{{{"F1", "this sheet"},
                                                                     {"F2", "hide or show the panels"},
                                                                     {"F5", "load the scene's file again"},
                                                                     {"F12", "save window (PNG) and rendering (EXR)"},
                                                                     {"drag left", "orbit around what is looked at"},
                                                                     {"drag right", "look around"},
                                                                     {"drag middle", "pan"},
                                                                     {"wheel", "nearer, farther"},
                                                                     {"W A S D", "fly; Q E or C Space down and up"},
                                                                     {"Shift", "fly ten times as fast"},
                                                                     {"click", "inspect the cell under the pointer"},
                                                                     {"F", "orbit around the point under the pointer"},
                                                                     {"R", "back to the scene's camera"},
                                                                     {"1 … 6", "strategies"},
                                                                     {"O", "next overlay; Shift+O the one before"},
                                                                     {"G", "wireframe of the touched cells"},
                                                                     {"P, .", "pause, one pass"},
                                                                     {"T, hold B", "store the picture, flip to it"},
                                                                     {"+ −", "exposure"},
                                                                     {"Ctrl+C, Ctrl+V", "copy and paste the view"},
                                                                     {"Escape", "end the inspection"},
                                                                     {"drop a file", "open a scene"}}};
  ImGui::SetNextWindowSize(ImVec2(30 * ImGui::GetFontSize(), 0), ImGuiCond_Always);
  const ImVec2 middle(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y);
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (ImGui::Begin("Keys (F1)", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    for (const auto& [key, what] : kKeys) {
      ImGui::TextUnformatted(key);
      ImGui::SameLine(9 * ImGui::GetFontSize());
      ImGui::TextUnformatted(what);
    }
  }
  ImGui::End();
}

void drawLegend(const OverlayPicture& overlay, const OverlayChoice& choice, const PixelRect& area, float uiScale) {
  const OverlayName& name = describe(overlay.overlay);
  const ColorScale scale(overlay.values, choice.scale);
  const Legend legend = makeLegend(scale, name.title, name.unit, name.integral);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const float font = ImGui::GetFontSize(), width = std::min(16 * font, area.size.x - 2 * font), height = 0.9f * font;
  const float pad = 0.5f * font;
  const ImVec2 corner(area.origin.x + font, area.origin.y + area.size.y - 4.2f * font);
  list->AddRectFilled(ImVec2(corner.x - pad, corner.y - pad),
                      ImVec2(corner.x + width + 2 * pad, corner.y + 3.6f * font), IM_COL32(15, 15, 18, 205),
                      4 * uiScale);
  const std::string title = legend.unit.empty() ? legend.title : legend.title + ", " + legend.unit;
  list->AddText(corner, IM_COL32_WHITE, (legend.range ? title : title + ": no values").c_str());
  if (!legend.range) return;
  const ImVec2 bar(corner.x, corner.y + 1.2f * font);
  constexpr int kSteps = 128;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb8 c = colorOf(choice.scale.colormap, (i + 0.5) / kSteps);
    const float x0 = bar.x + width * static_cast<float>(i) / kSteps,
                x1 = bar.x + width * static_cast<float>(i + 1) / kSteps;
    list->AddRectFilled(ImVec2(x0, bar.y), ImVec2(x1, bar.y + height), IM_COL32(c.x, c.y, c.z, 255));
  }
  float free = -1e9f;  // labels that would touch the one before are left out
  for (const LegendTick& tick : legend.ticks) {
    const float x = bar.x + width * static_cast<float>(tick.position);
    list->AddLine(ImVec2(x, bar.y), ImVec2(x, bar.y + height + 0.2f * font), IM_COL32_WHITE);
    const float half = 0.5f * ImGui::CalcTextSize(tick.label.c_str()).x;
    const float left = std::clamp(x - half, bar.x, std::max(bar.x, bar.x + width - 2 * half));
    if (left < free) continue;
    list->AddText(ImVec2(left, bar.y + height + 0.2f * font), IM_COL32_WHITE, tick.label.c_str());
    free = left + 2 * half + 0.5f * font;
  }
}

}  // namespace cellcut
