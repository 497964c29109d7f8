/// \file slice.h
/// A plane through the grid of cells, on which overlays are drawn where the cells' insides would not be seen.
///
/// It lies through the middle of a layer of cells and is hidden by what stands before it. Space: world, metres.
#pragma once

#include "ui/overlays/wireframe.h"

#include <atomic>
#include <cstdint>
#include <optional>

namespace cellcut {

enum class SliceAxis : std::uint8_t { kNone, kX, kY, kZ };

struct Slice {
  SliceAxis axis = SliceAxis::kNone;  ///< that the plane stands across
  float position = 0.5f;              ///< [0, 1] from the lower to the upper side of the grid's box

  bool operator==(const Slice&) const = default;
};

/// Where the plane lies on its axis. \pre there is an axis
float coordinateOf(const Slice& slice, const GridGeometry& grid);

/// Where each pixel's centre meets the plane within the grid's box, as a first hit whose normal looks back; no hit where
/// something of `behind` is nearer.
/// \return nothing if `cancel` became true first
std::optional<Image<FirstHit>> sliceHits(const Slice& slice, const GridGeometry& grid, const Camera& camera,
                                         const Image<FirstHit>& behind, const std::atomic<bool>& cancel);

/// The sides of the cells on the plane.
std::vector<Segment> sliceSegments(const Slice& slice, const GridGeometry& grid, const Rgba8& color);

}  // namespace cellcut
