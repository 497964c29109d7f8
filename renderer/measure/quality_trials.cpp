#include "renderer/measure/quality_trials.h"

#include "renderer/base/relative_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace cellcut {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// Below it there are no two passes that show what one takes when the cells are known.
constexpr std::size_t kLeastPasses = 3;

constexpr int kGroupSide = 4;
using GroupSums = std::array<double, kGroupSide * kGroupSide>;

double steadySeconds(const TrialPass& pass) {
  return std::max(0.0, pass.seconds - pass.cutSeconds);
}

/// Trial passes that there is room for where passes are planned.
double roomOf(const PlannedLength& length, double scale) {
  return kTrialShare * static_cast<double>(length.passes) * scale / kSmallFilmCost;
}

/// Seconds that trials may take, with two passes of the first candidate behind us where passes are planned.
double budgetOf(const PlannedLength& length, double scale, const std::vector<TrialPass>& first) {
  if (length.passes == 0) return kTrialShare * length.seconds;
  if (first.size() < 2) return std::numeric_limits<double>::infinity();
  double pass = std::numeric_limits<double>::infinity();
  for (const TrialPass& p : first) pass = std::min(pass, steadySeconds(p));
  return roomOf(length, scale) * pass;
}

/// Means of all films in blocks of kGroupSide² pixels, one of each group: a pixel's own mean after a few passes may be
/// black, or all of it one sample.
ImageRgb blockMeans(const std::vector<const FilmState*>& films) {
  const int width = films[0]->mean.width(), height = films[0]->mean.height();
  const auto blocks = [](int side) { return (side + kGroupSide - 1) / kGroupSide; };
  Image<glm::dvec4> sums(blocks(width), blocks(height), glm::dvec4(0));
  for (const FilmState* film : films) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) sums.at(x / kGroupSide, y / kGroupSide) += glm::dvec4(film->mean.at(x, y), 1);
    }
  }
  ImageRgb means(sums.width(), sums.height());
  for (std::size_t i = 0; i < sums.size(); ++i) means[i] = Vec3(sums[i] / sums[i].w);
  return means;
}

/// Relative variance of a sample in each pixel, mean over its channels.
std::vector<double> variances(const FilmState& film, const ImageRgb& blocks) {
  std::vector<double> result;
  result.reserve(film.mean.size());
  const double unit = meanOfChannels(blocks);  // squares neither overflow nor vanish in it
  const auto n = static_cast<double>(film.passes);
  for (int y = 0; y < film.mean.height(); ++y) {
    for (int x = 0; x < film.mean.width(); ++x) {
      const glm::dvec3 error = glm::dvec3(film.standardError.at(x, y)) / unit;
      const glm::dvec3 mean = glm::dvec3(blocks.at(x / kGroupSide, y / kGroupSide)) / unit;
      const glm::dvec3 relative = n * error * error / (mean * mean + kRelativeEpsilon);
      result.push_back((relative.x + relative.y + relative.z) / 3);
    }
  }
  return result;
}

/// What a hundredth of all pixels is above. It is the same for all candidates: one with more bright specks keeps more
/// pixels that are as bad as can be.
double capOf(const std::vector<std::vector<double>>& variances) {
  std::vector<double> all;
  for (const std::vector<double>& v : variances) all.insert(all.end(), v.begin(), v.end());
  const auto cap = all.begin() + static_cast<std::ptrdiff_t>(all.size() - 1 - all.size() / 100);
  std::nth_element(all.begin(), cap, all.end());
  return *cap;
}

/// Of the pixels in each group.
GroupSums groupSums(const std::vector<double>& variances, int width, double cap) {
  GroupSums sums{};
  const auto side = static_cast<std::size_t>(kGroupSide), columns = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    sums[side * (i / columns % side) + i % columns % side] += std::min(variances[i], cap);
  }
  return sums;
}

Estimate ratioOf(const GroupSums& a, const GroupSums& b) {
  std::array<double, std::tuple_size_v<GroupSums>> ratios;
  for (std::size_t g = 0; g < ratios.size(); ++g) ratios[g] = a[g] / b[g];
  return estimatePositive(ratios);
}

/// Of passes that were run in the same turn; the first are spoilt by all that is built in them.
Estimate timeRatio(const std::vector<TrialPass>& a, const std::vector<TrialPass>& b) {
  std::vector<double> ratios;
  for (std::size_t r = 1; r < std::min(a.size(), b.size()); ++r) {
    ratios.push_back(steadySeconds(a[r]) / steadySeconds(b[r]));
  }
  return estimatePositive(ratios);
}

/// Seconds of the rendering per pass, over those of a pass when the cells are known.
double buildingFactor(const QualityTrial& trial, const PlannedLength& length) {
  if (length.passes > 0) return 1 + trial.buildSeconds / (static_cast<double>(length.passes) * trial.passSeconds);
  const double left = length.seconds - trial.buildSeconds;
  return left > 0 ? length.seconds / left : std::numeric_limits<double>::infinity();
}

/// Errors of independent factors add as squares of logarithms.
Estimate product(const Estimate& a, const Estimate& b, double factor) {
  const auto distance = [](double x, double y) { return std::hypot(std::log(x), std::log(y)); };
  const double value = a.value * b.value * factor;
  return {value, value * std::exp(-distance(a.low / a.value, b.low / b.value)),
          value * std::exp(distance(a.high / a.value, b.high / b.value))};
}

QualityTrial timesOf(const Quality& quality, const std::vector<TrialPass>& passes, double scale) {
  QualityTrial trial{quality, passes.size(), 0, kUnknown, kUnknown, kUnknown, {kUnknown, kUnknown, kUnknown}};
  std::vector<double> steady;
  for (const TrialPass& pass : passes) {
    trial.seconds += pass.seconds;
    steady.push_back(steadySeconds(pass));
  }
  if (passes.size() < kLeastPasses) return trial;
  const double pass = estimatePositive(std::span(steady).subspan(1)).value;
  trial.passSeconds = scale * pass;
  trial.buildSeconds = std::max(0.0, trial.seconds - static_cast<double>(passes.size()) * pass);
  return trial;
}

}  // namespace

std::vector<std::vector<TrialPass>> runTrials(std::size_t count, const PlannedLength& length, double scale,
                                              const RunTrialPass& run) {
  std::vector<std::vector<TrialPass>> passes(count);
  if (count < 2) return passes;
  if (length.passes > 0 && roomOf(length, scale) < 2 * static_cast<double>(count)) return passes;
  double spent = 0;
  const auto left = [&] { return budgetOf(length, scale, passes[0]) - spent; };
  const auto runOne = [&](std::size_t candidate, double most) {
    const TrialPass pass = most > 0 ? run(candidate, most) : TrialPass{};
    spent += pass.seconds;
    if (pass.complete) passes[candidate].push_back(pass);
    return pass.complete;
  };
  const auto part = [&](std::size_t begun) { return left() / static_cast<double>(count - begun + 1); };
  if (!runOne(0, part(0)) || !runOne(0, left())) return passes;
  for (std::size_t c = 1; c < count; ++c) runOne(c, part(c));
  for (std::size_t turn = 1; turn < kMostTrialPasses; ++turn) {
    for (std::size_t c = 0; c < count; ++c) {
      const bool isDue = passes[c].size() == turn;  // not the second pass of 0, nor those that were given up
      if (isDue && !runOne(c, left())) return passes;
    }
  }
  return passes;
}

std::vector<QualityTrial> judgeTrials(std::span<const Quality> candidates,
                                      const std::vector<std::vector<TrialPass>>& passes,
                                      std::span<const FilmState> films, const PlannedLength& length, double scale) {
  assert(candidates.size() == passes.size() && candidates.size() == films.size());
  std::vector<QualityTrial> trials;
  std::vector<const FilmState*> judged;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    trials.push_back(timesOf(candidates[c], passes[c], scale));
    if (passes[c].size() >= kLeastPasses) judged.push_back(&films[c]);
  }
  if (passes[0].size() < kLeastPasses) return trials;
  const ImageRgb blocks = blockMeans(judged);
  if (!(meanOfChannels(blocks) > 0)) return trials;
  std::vector<std::vector<double>> pixels;
  pixels.reserve(judged.size());
  for (const FilmState* film : judged) pixels.push_back(variances(*film, blocks));
  const double cap = capOf(pixels);
  const int width = films[0].mean.width();
  const GroupSums first = groupSums(pixels[0], width, cap);
  std::size_t j = 0;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (passes[c].size() < kLeastPasses) continue;
    const GroupSums sums = groupSums(pixels[j++], width, cap);
    double sum = 0;
    for (const double s : sums) sum += s;
    trials[c].relativeVariance = sum / static_cast<double>(pixels[0].size());
    const double building = buildingFactor(trials[c], length) / buildingFactor(trials[0], length);
    trials[c].inefficiency = product(ratioOf(sums, first), timeRatio(passes[c], passes[0]), building);
  }
  return trials;
}

std::size_t bestTrial(std::span<const QualityTrial> trials) {
  assert(!trials.empty());
  std::size_t best = 0;
  double least = 1;
  for (std::size_t c = 1; c < trials.size(); ++c) {
    const Estimate& inefficiency = trials[c].inefficiency;
    if (!(inefficiency.high < 1 && inefficiency.value < least)) continue;
    best = c;
    least = inefficiency.value;
  }
  return best;
}

}  // namespace cellcut
