/// \file flip.h
/// ꟻLIP: the difference that a person sees when two pictures alternate, 0 (none) to 1 per pixel.
///
/// Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "ꟻLIP: A Difference Evaluator for
/// Alternating Images", doi:10.1145/3406183; for high dynamic range Andersson, Nilsson, Shirley, Akenine-Möller 2021,
/// "Visualizing Errors in Rendered High Dynamic Range Images", doi:10.2312/egs.20211015.
#pragma once

#include "renderer/base/image.h"

namespace cellcut {

/// The papers' viewer: 0.7 m from a screen 0.7 m and 3840 pixels wide.
inline constexpr double kPixelsPerDegree = 0.7 * (3840 / 0.7) * std::numbers::pi / 180;

/// Error per pixel of two pictures in linear RGB as shown on a display, [0, 1] (clamped). Symmetric in its pictures.
/// \pre the pictures have the same size and are not empty; pixelsPerDegree > 0
Image<float> flipLdr(const ImageRgb& test, const ImageRgb& reference, double pixelsPerDegree = kPixelsPerDegree);

/// Exposures under which high dynamic range pictures are compared: powers of two, equally spaced from start to stop.
struct FlipExposures {
  double start = 0;  ///< log2; the brightest pixel is shown at 85 %
  double stop = 0;   ///< log2; the median is shown at 85 %
  int count = 2;     ///< ≥ 2

  /// log2 of exposure `i`.
  double at(int i) const { return start + i * (stop - start) / (count - 1); }
};

/// From the luminances of the reference. The papers leave open a median of 0, which renderings with a black background
/// have: here it is the median of what is lit; all exposures are 1 when nothing is.
FlipExposures flipExposures(const ImageRgb& reference);

/// Error per pixel of scene-linear pictures: the largest flipLdr() over flipExposures(), each through the ACES fit.
/// NaN and negative channels count as 0. Not symmetric: the exposures are the reference's.
/// \pre as flipLdr
Image<float> flipHdr(const ImageRgb& test, const ImageRgb& reference, double pixelsPerDegree = kPixelsPerDegree);

}  // namespace cellcut
