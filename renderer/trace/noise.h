/// \file noise.h
/// How far a picture is from the truth, as far as its own samples tell: what a rendering may stop on.
#pragma once

#include "renderer/base/image.h"

#include <cstdint>

namespace cellcut {

/// What a film knows after a number of passes.
struct FilmState {
  std::uint64_t passes = 0;  ///< ≥ 2
  ImageRgb mean;
  ImageRgb standardError;  ///< of the mean
};

/// Of √relMSE of the picture, defined as in `compare`.
struct NoiseEstimate {
  double value = 0;  ///< its expectation
  double bound = 0;  ///< what it itself is below with a probability of about 0.97
};

/// Film::relativeError() divides the variance of a pixel's samples by the square of their mean. A rare bright sample
/// raises both, so that a pixel with one never counts as more than about 1, where its true error, against a dark
/// reference, may be a thousand: pictures with few bright specks look finished. Here each part of the passes is divided
/// by the mean of the other part, which knows nothing of its outliers; that errs towards more noise, as a reciprocal's
/// mean does.
///
/// The bound adds what the sum over the pixels varies by: the picture's own squared error (2 q² of a pixel that expects
/// q) and the estimate's (q²), both of which bright specks dominate.
/// \param part   the state after about half of the passes
/// \param whole  after all of them, as many as a film of the same size
/// \pre 2 ≤ part.passes ≤ whole.passes − 2
NoiseEstimate estimateNoise(const FilmState& part, const FilmState& whole);

}  // namespace cellcut
