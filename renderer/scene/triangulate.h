/// \file triangulate.h
/// Polygons → triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cellcut {

/// Cuts a polygon of n ≥ 3 corners into n − 2 triangles of its winding, given as positions in the list of corners. Flat
/// simple polygons, convex or not, come out right; of others, something that covers them. O(n²); bound n.
/// Source: Meisters 1975, "Polygons Have Ears"; normal after Newell (Sutherland et al. 1974).
/// \param looks  is raised by how often a corner was looked at, some nanoseconds each: n for convex polygons, up to n²
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> polygon, std::size_t& looks);

}  // namespace cellcut
