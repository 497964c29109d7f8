/// \file metrics.h
/// Error of a picture A against a reference B.
#pragma once

#include "renderer/base/image.h"

namespace cellcut {

struct ImageComparison {
  double mse = 0;      ///< mean over channels and pixels of (A − B)²
  double relmse = 0;   ///< mean over channels and pixels of (A − B)² / (B² + ε)
  double epsilon = 0;  ///< ε = 0.01 · mean(B)², mean over channels and pixels
  double flip = 0;     ///< mean over pixels of HDR-ꟻLIP, flip.h
  double meanA = 0;    ///< over channels and pixels
  double meanB = 0;
  double maxAbs = 0;  ///< largest |A − B|
};

/// \pre the pictures have the same size and are not empty
ImageComparison compareImages(const ImageRgb& a, const ImageRgb& b);

/// The same beside a rendering: it takes no threads from it.
/// \param withFlip  FLIP takes longer than all the rest; without, it is NaN
ImageComparison compareImagesOnThisThread(const ImageRgb& a, const ImageRgb& b, bool withFlip);

}  // namespace cellcut
