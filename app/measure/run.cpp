#include "app/measure/run.h"

#include "renderer/base/stopwatch.h"
#include "renderer/trace/renderer.h"

#include <algorithm>
#include <bit>

namespace cellcut {
namespace {

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Checkpoint checkpointOf(const Renderer& renderer, const std::vector<double>& passSeconds, double seconds,
                        const ImageRgb& picture, const ImageRgb& reference) {
  const ImageComparison error = compareImages(picture, reference);
  const SamplerStatistics statistics = renderer.samplerStatistics();
  return {.passes = renderer.film().passes(),
          .seconds = seconds,
          .passSeconds = medianOf(passSeconds),
          .mse = error.mse,
          .relmse = error.relmse,
          .smape = error.smape,
          .flip = error.flip,
          .flipLdr = error.flipLdr,
          .cutSize = statistics.cut ? statistics.cut->mean : 0,
          .cells = statistics.grid ? statistics.grid->made() : 0,
          .bytes = renderer.memory().lights};
}

bool isDone(const RunLimit& limit, std::uint64_t passes, double seconds) {
  return limit.passes ? passes >= *limit.passes : seconds >= limit.seconds;
}

}  // namespace

std::optional<MeasuredRun> measureRun(const Scene& scene, const RenderSettings& settings, const RunLimit& limit,
                                      const ImageRgb& reference, const std::atomic<bool>& cancel,
                                      const std::function<void(std::uint64_t, double)>& onPass) {
  MeasuredRun run;
  const Stopwatch building;
  Renderer renderer(scene, settings);
  run.buildSeconds = building.seconds();
  std::vector<double> passSeconds;
  double seconds = 0;
  for (bool done = false; !done;) {
    const Stopwatch pass;
    if (!renderer.renderPass(cancel)) return std::nullopt;
    passSeconds.push_back(pass.seconds());
    seconds += passSeconds.back();
    const std::uint64_t passes = renderer.film().passes();
    done = isDone(limit, passes, seconds);
    if (done || std::has_single_bit(passes)) {
      run.picture = renderer.film().mean();
      run.checkpoints.push_back(checkpointOf(renderer, passSeconds, seconds, run.picture, reference));
    }
    onPass(passes, seconds);
  }
  const BadSamples bad = renderer.film().badSamples();
  run.badSamples = bad.nan + bad.inf;
  return run;
}

}  // namespace cellcut
