/// \file probabilities.h
/// What a strategy says of every light at a point.
#pragma once

#include "renderer/sampling/light_sampler.h"

#include <vector>

namespace cellcut::test {

std::vector<double> allPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point);

/// Expects what holds at any point whatever: probabilities that add up to no more than 1, one above 0 for every light
/// that contributes, and draws that carry the probability that is queried.
/// \param reach  lights below this share of what all contribute may have a probability of 0
void expectSoundPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point, double reach = 0);

}  // namespace cellcut::test
