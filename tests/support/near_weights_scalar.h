/// \file near_weights_scalar.h
/// nearWeights() without SIMD: the definition that it is compared with.
#pragma once

#include "renderer/sampling/cut_weights.h"

namespace cellcut::test {

/// As nearWeights().
double nearWeightsScalar(const BlockedFloats& near, const Vec3& p, const Vec3& n, float* weights, float* blockSums);

}  // namespace cellcut::test
