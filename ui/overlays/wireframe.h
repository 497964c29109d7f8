/// \file wireframe.h
/// Cells and clusters as boxes of lines in the scene, drawn on the CPU with a depth test against the first hits.
///
/// Coordinates, clipping and depths are sums, products, quotients and roots of floats and doubles in a fixed order: the
/// same pixels on every machine. Space: world, metres.
#pragma once

#include "renderer/base/image_io.h"
#include "renderer/sampling/inspection.h"
#include "ui/overlays/color_scale.h"
#include "ui/overlays/first_hits.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {

/// A line between two points in one colour; alpha mixes it with the picture.
struct Segment {
  Vec3 from, to;
  Rgba8 color;
};

/// Appends the twelve edges of a box; of a flat one its four, of a line one, and nothing for a point or an empty box.
void appendBox(std::vector<Segment>& segments, const Bounds& box, const Rgba8& color);

/// The edges of the fine cells, and of the remote coarse ones, that were touched and kept; what neighbours of a size share is
/// there once. In a fixed order.
std::vector<Segment> touchedCellSegments(const CutInspector& inspector, const Rgba8& color);

/// Colours for the probabilities of a cut: logarithmic over three decades below the largest one, for one cluster often
/// takes most of it. Without a range where all are 0.
ColorScale probabilityScale(std::span<const ClusterInspection> clusters, Colormap colormap);

/// The boxes of the local clusters of a cut, coloured by probability. Likelier ones come later and so lie above. Distant
/// clusters have no box. A cluster of one point light is a small cross of `pointSize` metres from end to end.
std::vector<Segment> clusterSegments(std::span<const ClusterInspection> clusters, const ColorScale& scale,
                                     std::uint8_t alpha, float pointSize);

/// Distances of the first hits along the unit camera rays; infinite where nothing was hit.
Image<float> depthOf(const Image<FirstHit>& firstHits);

/// Draws lines of one pixel's width, later ones above earlier ones; `image` may be transparent. A pixel is drawn where
/// the line is not farther than the first hit by more than a two-hundredth of its distance: boxes touch the surfaces that
/// they are about.
/// \pre `image` and `depth` have the size that the camera was asked with
void drawSegments(ImageRgba8& image, const Image<float>& depth, const Camera& camera,
                  std::span<const Segment> segments);

}  // namespace cellcut
