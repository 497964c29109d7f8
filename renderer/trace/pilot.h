/// \file pilot.h
/// A few paths, traced before everything else, that show where a rendering will shade.
#pragma once

#include "renderer/trace/accel.h"

#include <vector>

namespace cellcut {

/// Vertices of a path that are followed at most: later ones lie where the first ones do.
inline constexpr int kPilotDepth = 3;

/// Vertices of a fixed set of camera paths that scatter diffusely: the same for the same scene and camera, whatever the
/// lights.
/// \param maxDepth  vertices per path, of which the first kPilotDepth are followed
std::vector<Vec3> pilotVertices(const Scene& scene, const Accel& accel, const Camera& camera, int maxDepth);

}  // namespace cellcut
