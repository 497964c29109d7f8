/// \file scalar_emission.h
/// One number for the three channels of an emission: what lights are weighed against each other by.
#pragma once

#include "renderer/base/math.h"

#include <cmath>

namespace cellcut {

/// Root mean square of the channels; grey keeps its value exactly. Unit in, unit out; > 0 for any floats but black. Of
/// lights i that give f_ik in channel k, one chosen with probability p_i has the variance Σ_ik f_ik² / p_i less a
/// constant, summed over the channels: least where p_i goes with the norm of f_i. So it is for the noise of a grey
/// picture; luminance would choose a pure blue lamp eight times too rarely beside a white one.
template <class T>
double scalarEmission(const glm::vec<3, T, glm::defaultp>& rgb) {
  const glm::dvec3 channels(rgb);
  return std::sqrt(glm::dot(channels, channels) / 3);
}

}  // namespace cellcut
