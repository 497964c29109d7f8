/// \file metrics.h
/// Error of a picture A against a reference B.
#pragma once

#include "renderer/base/image.h"

namespace cellcut {

struct ImageComparison {
  double mse = 0;      ///< mean over channels and pixels of (A − B)²
  double relmse = 0;   ///< mean over channels and pixels of (A − B)² / (B² + ε)
  double epsilon = 0;  ///< ε = 0.01 · mean(B)², mean over channels and pixels
  /// Mean over channels and pixels of |A − B| / (|A| + |B| + ε), ε = 0.01 · mean(B): [0, 1]. Source: Vogels et al.
  /// 2018, "Denoising with Kernel Prediction and Asymmetric Loss Functions", doi:10.1145/3197517.3201388, whose ε
  /// is 0.01 in the pictures' own unit.
  double smape = 0;
  double flip = 0;     ///< mean over pixels of HDR-ꟻLIP, flip.h
  double flipLdr = 0;  ///< mean over pixels of ꟻLIP of the pictures as toneMap() shows them, flip.h
  double meanA = 0;    ///< over channels and pixels
  double meanB = 0;
  double maxAbs = 0;  ///< largest |A − B|
};

/// \pre the pictures have the same size and are not empty
ImageComparison compareImages(const ImageRgb& a, const ImageRgb& b);

/// The same beside a rendering: it takes no threads from it.
/// \param withFlip  both kinds of FLIP take longer than all the rest; without, they are NaN
ImageComparison compareImagesOnThisThread(const ImageRgb& a, const ImageRgb& b, bool withFlip);

/// Estimate of the reference's own relMSE from two unbiased pictures of the same with noise that is independent of each
/// other's and of the reference's: mean of (A − R)(B − R) / (R² + ε), in which only the error that both comparisons
/// share, the reference's, does not average out. May come out negative where that is small.
/// \pre as compareImages
double referenceError(const ImageRgb& a, const ImageRgb& b, const ImageRgb& reference);

}  // namespace cellcut
