/// \file cut_choice.h
/// One light from a cut, with its exact probability.
#pragma once

#include "renderer/sampling/cut.h"
#include "renderer/sampling/light_sampler.h"

namespace cellcut {

/// A light of a cut, or at a glossy surface one that it mirrors (mirrored_lights.h). Nothing when no light can reach
/// the point, or when a descent ends where none can.
/// \param far  the cut's choice for facingOf(point.n)
/// \pre cut.size() ≤ kMaxCutSize
std::optional<SampledLight> sampleCut(const LightTrees& trees, const Cut& cut, const FarChoice& far,
                                      InCluster inCluster, const ShadingPoint& point, double u);
float pmfInCut(const LightTrees& trees, const Cut& cut, const FarChoice& far, InCluster inCluster,
               const ShadingPoint& point, LightId light);

/// Probability that a choice by the cut goes into each cluster, in the order of cut.members(): of sampleCut() where no
/// sample follows a mirror. Their sum is 1, or all are 0 where nothing is chosen. With InCluster::kDescent less than
/// that comes out again as lights of the cluster.
std::vector<double> clusterPmfs(const Cut& cut, const FarChoice& far, const ShadingPoint& point);

}  // namespace cellcut
