/// \file cut_choice.h
/// One light from a cut or from a tree, with its exact probability.
#pragma once

#include "renderer/sampling/cut.h"
#include "renderer/sampling/light_sampler.h"

namespace cellcut {

/// A light of a cut, or at a glossy surface one that it mirrors (mirrored_lights.h). Nothing when no light of it can reach the point, or when a descent ends where none can.
/// \param far  the cut's choice for facingOf(point.n)
/// \pre cut.size() ≤ kMaxCutSize
std::optional<SampledLight> sampleCut(const LightTrees& trees, const Cut& cut, const FarChoice& far,
                                      InCluster inCluster, const ShadingPoint& point, double u);
float pmfInCut(const LightTrees& trees, const Cut& cut, const FarChoice& far, InCluster inCluster,
               const ShadingPoint& point, LightId light);

/// Probability that sampleCut() goes into each cluster, in the order of cut.members(). Their sum is 1, or all are 0 where
/// nothing is chosen; at a glossy surface it is less by what walks of MirroredLights do not get as far. Where a walk goes
/// on inside a cluster less than that comes out again as lights of the cluster.
std::vector<double> clusterPmfs(const LightTrees& trees, const Cut& cut, const FarChoice& far,
                                const ShadingPoint& point);

}  // namespace cellcut
