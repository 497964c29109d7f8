/// \file cluster_pick.h
/// Which cluster's box a pointer is on.
#pragma once

#include "ui/overlays/cell_inspector.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cellcut {

/// Where a point of the scene appears; nothing behind the camera.
using Projection2 = std::function<std::optional<Vec2>(const Vec3&)>;

/// The convex outline of points, counter-clockwise where y goes up; of fewer than three corners where they lie in a line.
/// Source: Andrew 1979, doi:10.1016/0020-0190(79)90072-3.
std::vector<Vec2> convexHull(std::vector<Vec2> points);

/// The row whose box covers `position` as seen, the smallest of them: it is the one inside or before the others. Boxes
/// that reach behind the camera, and distant clusters, which have none, are not found.
/// \param slack  around a box, in the units of `position`: a point light has no size
std::optional<std::size_t> clusterAt(std::span<const ClusterRow> rows, const Projection2& project, const Vec2& position,
                                     float slack);

}  // namespace cellcut
