/// \file layers.h
/// A rendering as the layers of a file: what the film holds and what the strategy decided behind each pixel.
#pragma once

#include "renderer/trace/film.h"
#include "ui/overlays/overlay.h"

namespace cellcut {

/// Film::layers() and "variance" (RGB, of one sample); with first hits and a strategy that has a grid "cell" (id) and
/// "cut" (size).
/// - cell.id: x + X (y + Y z) of the cell behind the pixel's centre in a grid of X × Y × Z cells; −1 where nothing was
///   hit and beyond the grid's box. Exact: grids have up to 2²⁴ cells.
/// - cut.size: clusters of its cut; 0 where no path touched the cell.
/// \param firstHits  of the film's size
LayeredImage layersOf(const Film& film, const LightSampler& sampler, const Image<FirstHit>& firstHits);

}  // namespace cellcut
