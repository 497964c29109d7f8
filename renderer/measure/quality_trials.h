/// \file quality_trials.h
/// Which settings suit a scene, by short trials of each: how long they may take, and what their numbers say.
///
/// A setting's inefficiency is the relative variance of a sample times the seconds that it takes: error² × time of a
/// rendering, whatever its length. Everything here is told how long things took and looks at no clock.
#pragma once

#include "renderer/measure/intervals.h"
#include "renderer/sampling/sampler_settings.h"
#include "renderer/trace/noise.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cellcut {

/// The part of a rendering's seconds that trials may take. 5 % is what is promised; the rest of it is for what nobody
/// can give up half-way: a tile, and judging.
inline constexpr double kTrialShare = 0.045;
/// A pixel of a small film takes up to so many times as long as one of the picture, whose neighbours are nearer and
/// share more of the caches (160×90 against 640×360: 1.4 in `rooms`, direct light, 1.8 in `kinds`, depth 5).
inline constexpr double kSmallFilmCost = 2;
/// Passes of a setting, after which more would say little.
inline constexpr std::size_t kMostTrialPasses = 64;

/// How long the rendering behind the trials will be.
struct PlannedLength {
  std::uint64_t passes = 0;  ///< 0: `seconds` counts
  double seconds = 10;       ///< > 0; where nobody knows the end: half a second of trials at most
};

struct TrialPass {
  double seconds = 0;     ///< that went by, whatever was done
  double cutSeconds = 0;  ///< those of them in which cuts of cells were found
  bool complete = false;  ///< false: it was given up, and its samples with it
};

/// One more pass of a setting that may take `most` seconds (perhaps infinite), the first with all that is built for it.
using RunTrialPass = std::function<TrialPass(std::size_t candidate, double most)>;

/// Runs passes of candidates 0 … count − 1 in turn, so that a drifting machine favours none, until kTrialShare of the
/// planned rendering or kMostTrialPasses are over. The first pass of a candidate may take an even part of what is left;
/// one that needs more is not run again. Candidate 0 goes first; without two passes of it nothing else is run, and
/// nothing at all where a number of passes is planned that leaves no room for two of each.
/// \param scale  samples of a pass of the picture over those of a trial pass, ≥ 1
/// \return       complete passes by candidate
std::vector<std::vector<TrialPass>> runTrials(std::size_t count, const PlannedLength& length, double scale,
                                              const RunTrialPass& run);

/// What was measured of a setting.
struct QualityTrial {
  Quality quality;
  std::size_t passes = 0;
  double seconds = 0;           ///< of these passes, building included
  double passSeconds = 0;       ///< of a pass of the picture when its cells are known
  double buildSeconds = 0;      ///< for trees, cells and their cuts
  double relativeVariance = 0;  ///< of a sample, without the brightest specks: about passes · relMSE
  Estimate inefficiency{};      ///< over that of the first setting, building spread over the planned passes
};

/// Numbers that nothing is known of are NaN: those of settings with fewer than three passes.
///
/// Variances are divided by the squared means of 4×4 pixels of all films, and those above what a hundredth of all
/// pixels exceeds count as that: samples so rare that a few passes meet them by chance say nothing about a setting. The
/// intervals are Student's over 16 interleaved groups of pixels and over the passes but the first.
/// \param films  by candidate, of one size and independent samples; those with fewer than two passes are not looked at
std::vector<QualityTrial> judgeTrials(std::span<const Quality> candidates,
                                      const std::vector<std::vector<TrialPass>>& passes,
                                      std::span<const FilmState> films, const PlannedLength& length, double scale);

/// The setting of least inefficiency among those that are better than the first one beyond doubt (their interval lies
/// below 1); without any the first.
/// \pre at least one trial
std::size_t bestTrial(std::span<const QualityTrial> trials);

}  // namespace cellcut
