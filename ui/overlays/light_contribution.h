/// \file light_contribution.h
/// What one light truly sends to a point: brute force, for comparison with what a strategy expects of it.
///
/// Unit: scalar emission of the irradiance, W/m², of a surface with the point's shading normal; the material is not
/// asked.
/// Threads: may run concurrently.
#pragma once

#include "ui/overlays/first_hits.h"

namespace cellcut {

struct Contribution {
  double unoccluded = 0;  ///< as if nothing stood between
  double visible = 0;     ///< ≤ unoccluded
};

/// Point, spot and directional lights: exact, one shadow ray. Triangles and environment tiles: samplesPerSide² points of
/// a midpoint rule in Lights::sample(); for triangles of one radiance `unoccluded` is exact, and `visible` the share of
/// it that the shadow rays found. Light from behind the geometric surface is not visible, as on a path.
/// \pre samplesPerSide ≥ 1, at.hit()
Contribution contributionOf(const Lights& lights, const Accel& accel, LightId light, const FirstHit& at,
                            int samplesPerSide);

}  // namespace cellcut
