/// \file log_plot.h
/// Curves over two logarithmic axes, drawn with ImGui's lines. Between Gui::beginFrame and endFrame.
#pragma once

#include "renderer/base/math.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace cellcut {

struct PlotCurve {
  std::string name;
  std::vector<glm::dvec2> points;  ///< those that are not positive or not finite are left out
};

/// Over the width that is left in the current window; names below in the curves' colours.
void drawLogPlot(const std::vector<PlotCurve>& curves, const char* xTitle, const char* yTitle);

}  // namespace cellcut
