/// \file mirrored_lights.h
/// The choice of a light by how a glossy surface mirrors it.
///
/// A cut weighs lights as a surface sees them that scatters evenly. A light that a glossy surface mirrors sends a
/// hundred times of that: no BSDF sample finds a point light, few find a small lamp, and a single sample of one that
/// was thought faint is a bright pixel. So where a surface is glossy, a share of the samples walks down the trees with
/// D(h) in its importance, and the probability of a light is that of both choices together.
#pragma once

#include "renderer/sampling/descent.h"

namespace cellcut {

/// For the reflection of a surface. \pre point.lobe.alpha ≥ 10⁻³, its least (ggx.h): its square is a float
NodeImportance mirroredImportance(const ShadingPoint& point);

/// The lights at a point as its surface mirrors them.
class MirroredLights {
 public:
  MirroredLights(const LightTrees& trees, const ShadingPoint& point);

  /// Of the samples; below 1, and 0 where the surface does not mirror.
  double share() const { return share_; }
  /// \pre share() > 0
  std::optional<SampledLight> sample(double u) const { return descent_->sample(u); }
  /// \pre share() > 0
  double pmf(bool distant, std::uint32_t leaf) const { return descent_->pmf(distant, leaf); }

 private:
  std::optional<TreesDescent> descent_;
  double share_ = 0;
};

}  // namespace cellcut
