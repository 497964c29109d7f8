/// \file shading_points.h
/// Places where light is gathered, as paths find them.
#pragma once

#include "renderer/sampling/light_sampler.h"
#include "renderer/trace/accel.h"

#include <cstdint>
#include <vector>

namespace cellcut::test {

/// Vertices of paths from the scene's first camera: the first, then one after one bounce, then one after two, and
/// again. Fewer than `count` only if paths keep leaving the scene.
std::vector<ShadingPoint> pathVertices(const Scene& scene, std::size_t count, std::uint64_t seed);

}  // namespace cellcut::test
