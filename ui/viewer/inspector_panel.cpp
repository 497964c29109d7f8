#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include <imgui.h>

namespace cellcut {
namespace {

/// Rows of the table: the rest are of clusters that hardly matter.
constexpr std::size_t kRows = 100;

std::string cellText(const CellCoordinates& cell) {
  return std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " + std::to_string(cell.z) +
         (cell.coarse ? " (coarse)" : "");
}

/// Indices of the rows that are shown: the largest of probability and share first. `wanted` is among them.
std::vector<std::size_t> rowOrder(const std::vector<ClusterRow>& rows, std::optional<std::size_t> wanted) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto weight = [&](std::size_t i) { return std::max(rows[i].cluster.probability, rows[i].share); };
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(kRows, order.size()));
  std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
    return weight(a) != weight(b) ? weight(a) > weight(b) : a < b;
  });
  order.erase(end, order.end());
  if (wanted && *wanted < rows.size() && std::find(order.begin(), order.end(), *wanted) == order.end()) {
    order.push_back(*wanted);
  }
  return order;
}

void percent(double value) {
  ImGui::TableNextColumn();
  ImGui::Text("%.2f", 100 * value);
}

/// \param pointed  the row whose box in the picture is under the pointer
void drawTable(Widgets& widgets, const std::vector<ClusterRow>& rows, std::optional<std::size_t> pointed,
               ViewerState& state) {
  ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
  // Where large letters meet a narrow panel the columns keep their width and scroll.
  const bool narrow = ImGui::GetContentRegionAvail().x < 21 * ImGui::GetFontSize();
  if (narrow) flags |= ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedFit;
  if (!ImGui::BeginTable("clusters", 5, flags, ImVec2(0, 14 * ImGui::GetTextLineHeightWithSpacing()))) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* column : {"lights", "estimate", "P %", "true %", "diff"}) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
  std::size_t place = 0;
  for (const std::size_t i : rowOrder(rows, pointed)) {
    const ClusterRow& row = rows[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name = std::to_string(row.cluster.lightCount) + (row.cluster.distant ? " far" : "");
    const std::string label = "Cluster " + std::to_string(++place);
    if (widgets.row(label.c_str(), name.c_str(), pointed == i || state.selectedCluster == i)) {
      state.selectedCluster = i;
      state.selectedLight = 0;
    }
    if (pointed == i && !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.5f);
    if (ImGui::IsItemHovered()) {
      state.hoveredCluster = i;
      ImGui::SetTooltip("%s cluster of %u lights, level %d\nunoccluded %.4g W/m2, visible %.4g W/m2",
                        row.cluster.far ? "cached" : "near", row.cluster.lightCount, row.cluster.depth,
                        row.contribution.unoccluded, row.contribution.visible);
    }
    ImGui::TableNextColumn();
    ImGui::Text("%.1e", row.cluster.estimate);
    percent(row.cluster.probability);
    percent(row.share);
    percent(row.mismatch);
  }
  ImGui::EndTable();
}

/// What is shown alone or left out: a cluster, or a light of it.
ViewerCommand drawSelection(Widgets& widgets, const std::vector<ClusterRow>& rows, ViewerState& state) {
  if (!state.selectedCluster || *state.selectedCluster >= rows.size()) {
    ImGui::TextWrapped("Click a row, or X on a box, to select a cluster.");
    return ViewerCommand::kNone;
  }
  const ClusterRow& row = rows[*state.selectedCluster];
  const auto count = static_cast<int>(row.lights.size());
  state.selectedLight = std::min(state.selectedLight, count);
  if (count > 1) widgets.slider("Light", state.selectedLight, 0, count, "One light of the cluster, 0 for all of them");
  ViewerCommand command = ViewerCommand::kNone;
  if (widgets.button("Solo", "Render what it contributes alone (L)")) command = ViewerCommand::kSolo;
  besideIfRoom("Mute");
  if (widgets.button("Mute", "Render all but what it contributes (M)")) command = ViewerCommand::kMute;
  return command;
}

}  // namespace

ViewerCommand drawInspectorPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  const std::optional<std::size_t> pointed = std::exchange(state.hoveredCluster, std::nullopt);
  if (!state.pick || !widgets.section("Inspector")) return ViewerCommand::kNone;
  ViewerCommand command = ViewerCommand::kNone;
  if (!facts.overlay || !facts.overlay->inspection) {
    ImGui::TextUnformatted("looking …");
    return command;
  }
  const PixelReport& report = *facts.overlay->inspection;
  char text[96];
  std::snprintf(text, sizeof text, "%d, %d", report.pixel.x, report.pixel.y);
  widgets.text("Pixel", text);
  if (report.radiance) {
    std::snprintf(text, sizeof text, "%.4g %.4g %.4g", static_cast<double>(report.radiance->x),
                  static_cast<double>(report.radiance->y), static_cast<double>(report.radiance->z));
    widgets.text("Radiance", text, "W/(m² sr)");
  }
  if (report.variance) widgets.text("Variance", shortNumber(*report.variance, 4), "Of one sample");
  if (!report.hit.hit()) {
    ImGui::TextUnformatted("Nothing is hit there.");
  } else if (!report.hasCut) {
    ImGui::TextUnformatted("This strategy has no cuts.");
  } else {
    if (report.cell) widgets.text("Cell", cellText(*report.cell) + (report.kept ? "" : " (not touched)"));
    widgets.text("Clusters", std::to_string(report.clusters.size()), "In the cut of the cell");
    if (report.mirrored > 0) {
      widgets.text("By mirror", shortNumber(100 * report.mirrored, 3) + " %",
                   "Samples that go by what the glossy surface mirrors; the table is of the others");
    }
    if (report.distance) {
      widgets.text(
          "Mismatch", shortNumber(*report.distance, 3),
          "Total variation distance between the probabilities and the true visible shares: 0 perfect, 1 hopeless");
    }
    drawTable(widgets, report.clusters, pointed, state);
    command = drawSelection(widgets, report.clusters, state);
    if (widgets.button("Copy cut", "The table as JSON to the clipboard")) command = ViewerCommand::kExportCut;
    besideIfRoom("Close");
  }
  if (widgets.button("Close", "End the inspection (Escape)")) command = ViewerCommand::kUnpick;
  return command;
}

}  // namespace cellcut
