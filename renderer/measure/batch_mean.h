/// \file batch_mean.h
/// The mean of pictures of one scene that were rendered apart, and how far it is from what they converge to.
#pragma once

#include "renderer/base/image.h"

#include <cstdint>

namespace cellcut {

/// Both pictures are 32-bit floats, as files keep them, so that work that was interrupted ends with the same bits as work
/// that was not.
struct BatchMean {
  std::uint64_t count = 0;
  ImageRgb mean;
  ImageRgb deviation;  ///< root of Σ (batch − mean)²

  /// Of no batch yet.
  BatchMean(int width, int height) : mean(width, height), deviation(width, height) {}

  /// \pre batch has that size
  void add(const ImageRgb& batch);

  /// What the mean's noise adds to a relMSE that is measured against it, from the standard errors of its pixels: relative
  /// to itself, as all that is measured. \pre count ≥ 2
  double relmse() const;
};

}  // namespace cellcut
