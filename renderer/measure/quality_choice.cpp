#include "renderer/measure/quality_choice.h"

#include "renderer/base/stopwatch.h"
#include "renderer/trace/prepared_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace cellcut {
namespace {

/// Pixels of a trial's film: a sixteenth of the picture's, but enough for the variance of a group of them to mean
/// something (64×36).
double trialPixels(double pixels) {
  return std::min(pixels, std::max(pixels / 16, 64.0 * 36));
}

/// The same view on a small film, with samples that are neither the picture's nor another candidate's.
RenderSettings trialSettings(const RenderSettings& settings, const Quality& quality, std::size_t candidate) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  const double shrink = std::sqrt(trialPixels(pixels) / pixels);
  const auto side = [&](int s) { return std::max(1, static_cast<int>(std::lround(s * shrink))); };
  RenderSettings trial = settings;
  trial.sampler = quality.settings;
  trial.width = side(settings.width);
  trial.height = side(settings.height);
  trial.auxiliary = false;
  trial.seed += 1 + candidate;
  return trial;
}

std::vector<Quality> distinct(std::span<const Quality> candidates, const RenderSettings& settings) {
  std::vector<Quality> kept;
  for (const Quality& candidate : candidates) {
    const auto isSame = [&](const Quality& other) {
      return haveSameSampler(trialSettings(settings, candidate, 0), trialSettings(settings, other, 0));
    };
    if (std::none_of(kept.begin(), kept.end(), isSame)) kept.push_back(candidate);
  }
  return kept;
}

/// Renderers of the candidates, each made when its first pass is asked for.
class Trials {
 public:
  Trials(const Renderer& renderer, std::span<const Quality> candidates, const std::atomic<bool>& cancel)
      : renderer_(renderer), candidates_(candidates), cancel_(cancel), renderers_(candidates.size()) {
    const SamplerStatistics statistics = renderer.samplerStatistics();
    if (statistics.tree) treeSeconds_ = statistics.tree->seconds;
  }

  TrialPass pass(std::size_t candidate, double most) {
    if (cancel_.load()) return {};
    std::optional<Renderer>& trial = renderers_[candidate];
    const Stopwatch watch;
    if (!trial) {
      if (candidate > 0 && treeSeconds_ > most) return {};  // building trees cannot be given up half-way
      trial.emplace(renderer_, trialSettings(renderer_.settings(), candidates_[candidate], candidate));
    }
    const double before = cutSeconds(*trial);
    const bool complete = trial->renderPass(cancel_, most - watch.seconds());
    const double cuts = (cutSeconds(*trial) - before) / trial->threads();
    return {watch.seconds(), cuts, complete};
  }

  std::vector<FilmState> films() const {
    std::vector<FilmState> states;
    for (const std::optional<Renderer>& r : renderers_) {
      states.push_back(r ? FilmState{r->film().passes(), r->film().mean(), r->film().standardError()} : FilmState{});
    }
    return states;
  }

  /// With the cells that the trial has found.
  Renderer finalRenderer(std::size_t candidate) const {
    RenderSettings settings = renderer_.settings();
    settings.sampler = candidates_[candidate].settings;
    return {renderers_[candidate] ? *renderers_[candidate] : renderer_, settings};
  }

 private:
  /// Of all threads together.
  static double cutSeconds(const Renderer& renderer) {
    const std::optional<CutStatistics> cut = renderer.samplerStatistics().cut;
    return cut ? cut->seconds : 0;
  }

  const Renderer& renderer_;
  std::span<const Quality> candidates_;
  const std::atomic<bool>& cancel_;
  std::vector<std::optional<Renderer>> renderers_;
  double treeSeconds_ = 0;
};

}  // namespace

std::vector<Quality> autoQualities() {
  const auto named = [](std::string_view name) {
    return *std::find_if(kQualities.begin(), kQualities.end(), [&](const Quality& q) { return q.name == name; });
  };
  Quality intensity = named("balanced");
  intensity.name = "balanced-intensity";
  intensity.settings.inCluster = InCluster::kIntensity;
  return {named("balanced"), intensity, named("preview"), named("accurate")};
}

QualityChoice chooseQuality(Renderer& renderer, std::span<const Quality> candidates, const PlannedLength& length,
                            const std::atomic<bool>& cancel) {
  assert(!candidates.empty() && candidates[0].settings == renderer.settings().sampler);
  const Stopwatch watch;
  const std::vector<Quality> tried = distinct(candidates, renderer.settings());
  const RenderSettings size = trialSettings(renderer.settings(), tried[0], 0);
  const double scale = static_cast<double>(renderer.settings().width) * renderer.settings().height /
                       (static_cast<double>(size.width) * size.height);
  Trials trials(renderer, tried, cancel);
  const auto passes = runTrials(tried.size(), length, scale,
                                [&](std::size_t candidate, double most) { return trials.pass(candidate, most); });
  QualityChoice choice;
  choice.trials = judgeTrials(tried, passes, trials.films(), length, scale);
  const std::size_t best = bestTrial(choice.trials);
  choice.chosen = tried[best];
  if (best > 0) renderer = trials.finalRenderer(best);
  choice.seconds = watch.seconds();
  return choice;
}

}  // namespace cellcut
