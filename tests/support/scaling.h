/// \file scaling.h
/// The same scene in other units.
#pragma once

#include "renderer/scene/scene.h"

namespace cellcut::test {

/// All lengths times 2^exponent, and intensities of lights at points by its square: the picture stays what it was.
Scene withLengthsTimesPowerOf2(Scene scene, int exponent);

/// All that shines times 2^exponent, and so the picture.
Scene withRadianceTimesPowerOf2(Scene scene, int exponent);

}  // namespace cellcut::test
