/// The verb `render`: scene file → picture file.
#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/json_text.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/verbs.h"
#include "renderer/base/stopwatch.h"
#include "renderer/measure/quality_choice.h"
#include "renderer/trace/noise_watch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr const char* kRenderExplanations = R"(
Quality auto tries balanced, its clusters by intensity, preview and accurate on small films for up to 5 % of --time, or
of the time that --spp will take, or for half a second with --noise. Balanced stays unless another has less relMSE ×
seconds beyond doubt (95 %), and so it does when the rendering is too short to tell. The trials come before the seconds
of --time and their samples are thrown away; what they take, what they measured and the options that make the same
picture again are reported. Explicit options hold in all that is tried.

Ctrl-C discards the pass in flight and writes what has been accumulated (exit code 0, or 1 when no pass was complete);
a second one quits at once. Exit codes: 0 done, 2 bad usage or input, 1 anything else.

Examples:
  cellcut render room.glb -o room.png
  cellcut render room.glb -o room.exr --time 60 --report room.json
  cellcut render room.glb -o room.exr --time 600 --quality auto
  cellcut render lamp.obj -o lamp.exr --environment sky.hdr --environment-rotation 90
  cellcut render blender.glb -o direct.png --max-depth 1 --punctual-scale blender)";

ProgressState progressOf(const Renderer& renderer, const StopRule& rule, const RenderState& state) {
  const RayCounts rays = renderer.rays();
  const auto traced = static_cast<double>(rays.camera + rays.bounce + rays.shadow);
  return {.doneShare = doneShare(rule, state),
          .passes = state.passes,
          .seconds = state.seconds,
          .raysPerSecond = state.seconds > 0 ? traced / state.seconds : 0};
}

/// Passes until the rule is met or the person has had enough. Returns the seconds that it took.
double renderPasses(Renderer& renderer, const StopRule& rule, const std::atomic<bool>& cancel, Progress& progress) {
  const Stopwatch watch;
  NoiseWatch noise;
  RenderState state;
  while (!isReached(rule, state)) {
    if (!renderer.renderPass(cancel)) break;
    state.passes = renderer.film().passes();
    if (rule.kind == StopRule::Kind::kNoise) noise.look(renderer.film());
    state.relativeError = noise.noise().bound;
    state.seconds = watch.seconds();
    progress.update(progressOf(renderer, rule, state));
  }
  state.seconds = watch.seconds();
  if (state.passes > 0) progress.finish(progressOf(renderer, rule, state));
  return state.seconds;
}

PlannedLength plannedLength(const StopRule& rule) {
  switch (rule.kind) {
    case StopRule::Kind::kPasses:
      return {.passes = rule.passes};
    case StopRule::Kind::kSeconds:
      return {.seconds = rule.seconds};
    case StopRule::Kind::kNoise:
      break;
  }
  return {};
}

void showQuality(const QualityChoice& choice, std::ostream& err) {
  const auto compared = std::count_if(choice.trials.begin(), choice.trials.end(),
                                      [](const QualityTrial& t) { return std::isfinite(t.inefficiency.value); });
  const std::string trials =
      compared < 2 ? "nothing compared in " : std::to_string(compared) + " settings compared in ";
  err << "cellcut: quality " << choice.chosen.name << ", " << trials << formatDuration(choice.seconds)
      << "; the same again: " << pinningOptions(choice.chosen.settings) << '\n';
}

void showOutcome(const RenderRecord& record, const Console& console) {
  const BadSamples bad = record.renderer.film().badSamples();
  if (bad.nan + bad.inf > 0) {
    console.warn(std::to_string(bad.nan) + " samples were NaN and " + std::to_string(bad.inf) +
                 " infinite; they count as black");
  }
  const auto passes = record.renderer.film().passes();
  if (record.interrupted) {
    console.err << "cellcut: interrupted; the picture holds the " << passes << " complete passes\n";
  }
  console.err << "wrote " << record.options.output.file.string() << '\n';
}

int renderPicture(const RenderOptions& options, const Console& console) {
  const StopRule stop = options.stop.value_or(StopRule{});
  requireDistinct({{"--output", options.output.file}, {"--report", options.report.value_or("")}}, inputsOf(options));
  RenderSettings settings = options.settings;
  settings.auxiliary = options.output.kind == PictureKind::kExr;
  requireMemory(settings);

  const tbb::global_control threads = allowThreads(settings);
  const InterruptRequest interrupt;
  RenderTimes times;
  const Stopwatch loading;
  const Scene scene = loadWithOptions(options);
  times.load = loading.seconds();
  for (const std::string& warning : scene.warnings) console.warn(warning);

  settings.camera = findCamera(scene, options.camera);
  const Stopwatch building;
  Renderer renderer(scene, settings);
  times.build = building.seconds();

  std::optional<QualityChoice> quality;
  if (!options.candidates.empty()) {
    quality = chooseQuality(renderer, options.candidates, plannedLength(stop), interrupt.requested());
    showQuality(*quality, console.err);
  }

  Progress progress(console.err, console.terminal);
  times.render = renderPasses(renderer, stop, interrupt.requested(), progress);
  if (renderer.film().passes() == 0) {
    console.err << "cellcut: interrupted before the first pass was complete; nothing was written\n";
    return kFailed;
  }
  const RenderRecord record{options, scene, renderer, times, interrupt.requested(), quality ? &*quality : nullptr};
  writePicture(options.output, renderer.film(), pictureMetadata(record, console.commandLine));
  if (options.report) writeText(*options.report, jsonText(renderReport(record), 2) + "\n");
  showOutcome(record, console);
  return kDone;
}

}  // namespace

Verb addRender(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("render", "Render a scene to a picture");
  const auto options = std::make_shared<RenderOptions>();
  addRenderOptions(*verb, *options);
  verb->footer(explainPictureOptions() + kRenderExplanations);
  return {verb, [options](const Console& console) { return renderPicture(*options, console); }};
}

}  // namespace cellcut
