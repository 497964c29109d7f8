/// \file first_hits.h
/// What the centre of each pixel sees first: where overlays are read and what lines in the scene hide behind.
///
/// Traced once per camera and size, then read by every overlay. Space: world, metres.
#pragma once

#include "renderer/base/image.h"
#include "renderer/sampling/light_sampler.h"
#include "renderer/trace/surface.h"

#include <atomic>
#include <optional>

namespace cellcut {

/// A first hit as a path vertex: what the integrator hands to the strategy there.
struct FirstHit {
  ShadingPoint point;          ///< its normal is the shading normal on the viewer's side
  Vec3 geometricNormal{0.0f};  ///< unit, on the viewer's side
  Vec3 error{0.0f};            ///< bound on the rounding error of the point, per axis
  float distance = kInfinity;  ///< along the unit camera ray, metres; infinite: nothing was hit
  bool hit() const { return distance < kInfinity; }
};

/// The first hit of a ray. Partly covered surfaces are decided as by random number 0, the same at every call.
FirstHit firstHit(const Scene& scene, const Accel& accel, const Ray& ray);

/// One per pixel, through its centre. On the calling thread: about a microsecond per pixel.
/// \return nothing if `cancel` became true first
std::optional<Image<FirstHit>> traceFirstHits(const Scene& scene, const Accel& accel, const Camera& camera,
                                              glm::ivec2 size, const std::atomic<bool>& cancel);

}  // namespace cellcut
