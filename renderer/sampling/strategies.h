/// \file strategies.h
/// One factory per strategy; each is defined in the file of its name.
#pragma once

#include "renderer/sampling/light_sampler.h"

namespace cellcut {

std::unique_ptr<LightSampler> makeUniformSampler(const Lights& lights);       // uniform.cpp
std::unique_ptr<LightSampler> makePowerSampler(const Lights& lights);         // power.cpp
std::unique_ptr<LightSampler> makeProportionalSampler(const Lights& lights);  // proportional.cpp
std::unique_ptr<LightSampler> makeCellCutSampler(const Lights& lights, const SamplerSettings& settings,
                                                 std::span<const Vec3> pilot);  // cell_cut.cpp
std::unique_ptr<LightSampler> makePointCutSampler(const Lights& lights,
                                                  const SamplerSettings& settings);  // point_cut.cpp
std::unique_ptr<LightSampler> makeLightTreeSampler(const Lights& lights);            // light_tree_descent.cpp

}  // namespace cellcut
