/// \file strategies.h
/// One factory per strategy; each is defined in the file of its name.
#pragma once

#include "renderer/sampling/light_sampler.h"

namespace cellcut {

std::unique_ptr<LightSampler> makeUniformSampler(const Lights& lights);       // uniform.cpp
std::unique_ptr<LightSampler> makePowerSampler(const Lights& lights);         // power.cpp
std::unique_ptr<LightSampler> makeProportionalSampler(const Lights& lights);  // proportional.cpp

}  // namespace cellcut
