/// \file probabilities.h
/// What a strategy says of every light at a point.
#pragma once

#include "tests/support/strategies.h"

#include <span>
#include <vector>

namespace cellcut::test {

std::vector<double> allPmfs(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point);

/// Expects that the probabilities of all lights add up to 1 less that of no light, which is counted in draws where a
/// descent can end in nothing; to 0 where no light is ever drawn.
/// \param comparisons  how many points are looked at in the test, this one included
void expectSumToOne(const SamplerVariant& variant, const LightSampler& sampler, const ShadingPoint& point,
                    std::span<const double> pmf, std::size_t draws, std::size_t comparisons);

/// A light that adds less than this share of what all contribute may have no probability: local lights seen from 10¹⁸ m
/// are 10⁻³⁶ of a sky, less than a float holds beside 1.
inline constexpr double kReach = 1e-12;

/// Expects what holds at any point whatever: probabilities that add up as above, one above 0 for every light that
/// contributes, and draws that carry the probability that is queried.
/// \param reach  lights below this share of what all contribute may have a probability of 0
void expectSoundPmfs(const SamplerVariant& variant, const LightSampler& sampler, const Lights& lights,
                     const ShadingPoint& point, double reach = 0);

}  // namespace cellcut::test
