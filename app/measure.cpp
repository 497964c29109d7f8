/// The verb `measure`: scene → errors, times and memory of every way to render it.
#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/json_text.h"
#include "app/measure/options.h"
#include "app/measure/progress.h"
#include "app/measure/report.h"
#include "app/measure/results.h"
#include "app/measure/scene_hash.h"
#include "app/measure/summary.h"
#include "app/numbers.h"
#include "app/option_text.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/verbs.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

std::string measureHelp() {
  return explainSettingOptions() + "\nParameters of --sweep:\n  " + joinedNames(kSweepNames) + R"(
(max-depth of every strategy, the others of those with cuts)

Run 1 of every strategy comes first, then run 2 of every one: a machine that slows down favours none. Errors are
taken against the reference after 1, 2, 4, 8, ... passes and the last, and between them interpolated on logarithmic
axes at --time; a strategy whose first pass takes longer is compared at the seconds that it took. Values are geometric
means over the runs, with the 95 % interval by Student's t on their logarithms: errors are positive, skewed and
compared by ratios.

The reference is made once by cell-cut in batches of different seeds and kept in $XDG_CACHE_HOME/cellcut by the
content of scene, camera, size and depth. How far the batches differ tells its own error; it is refused (exit code 2)
when its relMSE is more than a tenth of one that it is to judge. That of --reference is estimated from what two runs'
differences from it have in common.

FOLDER gets results.json (everything), results.csv, report.html (a page that needs no network), images/ and scenes/
(of recipes). Ctrl-C keeps every finished run and --resume goes on; with more --runs, --strategies or --sweep it adds
to what is there.

Columns of results.csv; those of seconds and errors are followed by NAME_low and NAME_high, their intervals:
)" + csvHelp() +
         R"(
Examples:
  cellcut measure rooms -o out/rooms --lights 4000 --strategies cell-cut,light-tree --runs 20
  cellcut measure street -o out/street --lights 1000,10000,100000 --time 10 --sweep max-depth=1,8
  cellcut measure hall -o out/presets --strategies cell-cut --sweep quality=preview,balanced,accurate
  cellcut measure room.glb -o out/room --reference room.exr --resume)";
}

/// Everything that a measurement works with.
struct Work {
  const MeasureOptions& options;
  const Console& console;
  const std::atomic<bool>& cancel;
  MeasureProgress progress;
  MeasureResults results;

  std::optional<double> seconds() const { return options.passes ? std::nullopt : std::optional(options.seconds); }
  /// Of the reference that is made; nothing: as many as judge runs of a time.
  std::optional<std::uint64_t> referencePasses() const {
    if (options.referencePasses || !options.passes) return options.referencePasses;
    return kReferenceFactor * *options.passes;
  }
  fs::path image(const std::string& name) const { return options.folder / "images" / name; }
};

// ---- scenes

/// Of a recipe the file is made first, so that what was measured can be looked at and rendered again.
fs::path sceneFile(const MeasureOptions& options, const MeasureCase& c) {
  if (!c.recipe) return options.scene;
  fs::path file = options.folder / "scenes" / (options.scene + "-" + std::to_string(c.lights) + ".glb");
  if (!fs::exists(file)) {
    fs::create_directories(file.parent_path());
    writeBytes(file, generateRecipe(*c.recipe, c.lights, 0));
  }
  return file;
}

/// The scene of a case, kept as long as the next case has the same.
class SceneSource {
 public:
  explicit SceneSource(const MeasureOptions& options) : options_(options) {}

  const Scene& of(const MeasureCase& c) {
    const fs::path file = sceneFile(options_, c);
    if (!scene_ || file != file_) {
      scene_.reset();  // two of them need not fit into memory
      RenderOptions loading = options_.picture;
      loading.scene = file;
      scene_ = std::make_unique<Scene>(loadWithOptions(loading));
      file_ = file;
    }
    return *scene_;
  }

 private:
  const MeasureOptions& options_;
  fs::path file_;
  std::unique_ptr<Scene> scene_;
};

LightCounts lightCounts(const Scene& scene) {
  return Lights(scene).counts();
}

// ---- files

void writeResults(const Work& work) {
  writeText(work.options.folder / "results.json", jsonText(resultsJson(work.results, work.options), 1) + "\n");
  writeText(work.options.folder / "results.csv", toCsv(work.results, summaryOf(work.results, work.seconds())));
}

void writeReport(const Work& work) {
  writeText(work.options.folder / "report.html",
            reportPage(resultsJson(work.results, work.options), work.options.folder));
}

/// The same picture as it is and as a person sees it.
void writeImage(const Work& work, const std::string& name, const ImageRgb& picture,
                std::map<std::string, std::string> metadata) {
  writePicture({work.image(name + ".exr"), PictureKind::kExr}, picture, std::move(metadata));
  writePicture({work.image(name + ".png"), PictureKind::kPng}, picture);
}

// ---- what is left to do

double expectedSeconds(const Work& work) {
  return work.options.passes ? 1 : work.options.seconds;  // without a time all runs count the same
}

double expectedReference(const Work& work) {
  if (!work.options.passes) return kReferenceFactor * work.options.seconds;
  return static_cast<double>(*work.referencePasses()) / static_cast<double>(*work.options.passes);
}

bool isDone(const MeasureResults& results, std::size_t configuration, int run) {
  return std::any_of(results.runs.begin(), results.runs.end(),
                     [&](const RunRecord& r) { return r.configuration == configuration && r.run == run; });
}

void expectRuns(Work& work) {
  for (int run = 0; run < work.options.runs; ++run) {
    for (std::size_t i = 0; i < work.results.plan.configurations.size(); ++i) {
      if (!isDone(work.results, i, run)) work.progress.expect(expectedSeconds(work));
    }
  }
}

// ---- references

MeasureReference readReference(const fs::path& file, const RenderSettings& settings) {
  MeasureReference reference{readImage(file), std::numeric_limits<double>::quiet_NaN(), 0, 0, file};
  if (reference.picture.width() != settings.width || reference.picture.height() != settings.height) {
    throw InputError(file.string(), "is " + sizeText(reference.picture.width(), reference.picture.height()) +
                                        " and --size is " + sizeText(settings.width, settings.height) +
                                        "; only equal sizes compare");
  }
  return reference;
}

std::optional<MeasureReference> madeReference(Work& work, const Scene& scene, std::size_t index) {
  const MeasureOptions& o = work.options;
  RenderSettings settings = o.picture.settings;
  settings.maxDepth = work.results.plan.cases[index].maxDepth;
  settings.camera = findCamera(scene, o.picture.camera);
  const std::string label = "reference of " + work.results.plan.cases[index].name;
  const ReferenceRequest request{scene, settings, work.referencePasses(), o.seconds, cacheFolder(o.folder)};
  const double expected = expectedReference(work);
  const auto onPass = [&](std::uint64_t passes, double seconds, std::uint64_t aim) {
    const double share = static_cast<double>(passes) / static_cast<double>(aim);
    work.progress.update(
        label + ": " + std::to_string(passes) + " of " + std::to_string(aim) + " spp, " + formatDuration(seconds),
        share, expected);
  };
  auto reference = makeReference(request, work.cancel, onPass);
  if (!reference) return std::nullopt;
  std::ostringstream text;
  text << std::setprecision(3) << label << ": " << reference->passes << " spp, its own relMSE " << reference->relmse;
  work.progress.finish(text.str(), expected);
  return reference;
}

/// Whether nothing finer is asked for than the folder's reference. Of files only their pixels tell: prepareCase().
bool isAsked(const MeasureReference& reference, const MeasureOptions& options) {
  return !options.reference && (!options.referencePasses || reference.passes >= *options.referencePasses);
}

bool hasRuns(const MeasureResults& results, std::size_t caseIndex) {
  return std::any_of(results.runs.begin(), results.runs.end(), [&](const RunRecord& r) {
    return results.plan.configurations[r.configuration].caseIndex == caseIndex;
  });
}

/// The reference that the case's runs are compared with: of the folder, if it has one and no finer one is asked for. Every
/// run that is there was judged by one that was fine enough for it; only a file may hold anything.
bool prepareCase(Work& work, const Scene& scene, std::size_t index) {
  CaseRecord& record = work.results.cases[index];
  const std::string name = work.results.plan.cases[index].name + ".reference";
  const fs::path kept = work.image(name + ".exr");
  const RenderSettings& settings = work.options.picture.settings;
  const auto takeKept = [&] { record.reference->picture = readReference(kept, settings).picture; };
  const bool isKept = record.reference && fs::exists(kept);
  if (isKept && isAsked(*record.reference, work.options)) {
    takeKept();
    return true;
  }
  const bool judgedByFile = isKept && hasRuns(work.results, index) && record.reference->passes == 0;
  if (work.options.reference) {
    MeasureReference given = readReference(*work.options.reference, settings);
    if (isKept && hasRuns(work.results, index)) {
      takeKept();
      if (!std::equal(given.picture.begin(), given.picture.end(), record.reference->picture.begin())) {
        throw InputError("--reference", "runs in " + work.options.folder.string() +
                                            " were judged by another picture; leave it out, or choose another folder");
      }
      return true;
    }
    record.reference = std::move(given);
    if (work.options.runs < 2) {
      work.console.warn("with a single run nothing is known of the error of " + work.options.reference->string() +
                        "; below it no error can be measured");
    }
  } else if (judgedByFile) {
    throw InputError("--reference-spp", "runs in " + work.options.folder.string() + " were judged by " +
                                            record.reference->file.string() +
                                            "; leave it out, or choose another folder");
  } else {
    record.reference = madeReference(work, scene, index);
  }
  if (!record.reference) return false;
  writeImage(work, name, record.reference->picture,
             {{"software", "cellcut " CELLCUT_VERSION}, {"commandLine", work.console.commandLine}});
  return true;
}

// ---- runs

std::string describe(const MeasureResults& results, std::size_t configuration, int run, int runs) {
  return "run " + std::to_string(run + 1) + " of " + std::to_string(runs) + ", " +
         results.plan.configurations[configuration].name;
}

/// Returns false when the person had enough.
bool doRun(Work& work, const Scene& scene, std::size_t configuration, int run) {
  const MeasureOptions& o = work.options;
  const Configuration& c = work.results.plan.configurations[configuration];
  MeasureReference& reference = *work.results.cases[c.caseIndex].reference;
  RenderSettings settings = settingsOf(o, work.results.plan, c);
  settings.camera = findCamera(scene, o.picture.camera);
  settings.seed = o.picture.settings.seed + static_cast<std::uint64_t>(run);
  const std::string label = describe(work.results, configuration, run, o.runs);
  const RunLimit limit{o.seconds, o.passes};
  const auto onPass = [&](std::uint64_t passes, double seconds) {
    const double share = o.passes ? static_cast<double>(passes) / static_cast<double>(*o.passes) : seconds / o.seconds;
    work.progress.update(label + ": " + std::to_string(passes) + " spp, " + formatDuration(seconds), share,
                         expectedSeconds(work));
  };
  const auto measured = measureRun(scene, settings, limit, reference.picture, work.cancel, onPass);
  if (!measured) return false;
  const Checkpoint& last = measured->checkpoints.back();
  if (std::isnan(reference.relmse) && run > 0) {
    const ImageRgb first = readImage(work.image(c.name + ".exr"));  // of run 0, whose seed is another
    reference.relmse = std::max(0.0, referenceError(first, measured->picture, reference.picture));
  }
  requireFineReference(reference, last.relmse);
  if (run == 0) {
    writeImage(work, c.name, measured->picture,
               {{"software", "cellcut " CELLCUT_VERSION},
                {"commandLine", work.console.commandLine},
                {"strategy", std::string(nameOf(c.strategy))},
                {"spp", std::to_string(last.passes)},
                {"seed", std::to_string(settings.seed)},
                {"maxDepth", std::to_string(settings.maxDepth)},
                {"secondsRender", std::to_string(last.seconds)}});
  }
  work.results.runs.push_back(
      {configuration, run, settings.seed, measured->buildSeconds, measured->badSamples, measured->checkpoints});
  writeResults(work);
  std::ostringstream text;
  text << std::setprecision(3) << label << ": " << last.passes << " spp, " << formatDuration(last.seconds)
       << ", relMSE " << last.relmse;
  work.progress.finish(text.str(), expectedSeconds(work));
  return true;
}

bool doAllRuns(Work& work, SceneSource& scenes) {
  const MeasurePlan& plan = work.results.plan;
  for (int run = 0; run < work.options.runs; ++run) {
    for (std::size_t i = 0; i < plan.configurations.size(); ++i) {
      if (isDone(work.results, i, run)) continue;
      if (!doRun(work, scenes.of(plan.cases[plan.configurations[i].caseIndex]), i, run)) return false;
    }
  }
  return true;
}

// ---- the verb

void prepareFolder(const MeasureOptions& options) {
  const fs::path& folder = options.folder;
  std::error_code error;
  fs::create_directories(folder / "images", error);
  if (error || !isWritable(folder)) throw InputError(folder.string(), "cannot be written to; choose another folder");
  if (!options.resume && fs::exists(folder / "results.json")) {
    throw InputError(folder.string(), "has results already; add --resume to go on with them, or choose another folder");
  }
}

void showEqualTime(const Work& work) {
  std::ostream& err = work.console.err;
  std::ostringstream text;
  text << std::setprecision(3);
  for (const SummaryRow& row : summaryOf(work.results, work.seconds())) {
    if (!row.equalTime) continue;
    text << work.results.plan.configurations[row.configuration].name << ": relMSE " << row.relmse.value;
    if (row.runs > 1) text << " (" << row.relmse.low << " to " << row.relmse.high << ")";
    text << " after " << row.seconds.value << " s, " << std::llround(row.passes) << " spp, " << row.passSeconds
         << " s per pass\n";
  }
  err << text.str();
}

int measure(const MeasureOptions& options, const Console& console) {
  requireConsistent(options);
  RenderSettings film = options.picture.settings;
  film.auxiliary = false;
  requireMemory(film);
  prepareFolder(options);
  const tbb::global_control threads = allowThreads(film);
  const InterruptRequest interrupt;
  Work work{options, console, interrupt.requested(), MeasureProgress(console.err, console.terminal), {}};
  MeasureResults& results = work.results;
  results.plan = planOf(options);
  results.settings = settingsJson(options);
  results.cases.resize(results.plan.cases.size());
  SceneSource scenes(options);
  for (std::size_t i = 0; i < results.cases.size(); ++i) {
    const Scene& scene = scenes.of(results.plan.cases[i]);
    findCamera(scene, options.picture.camera);
    for (const std::string& warning : scene.warnings) console.warn(warning);
    results.cases[i].sceneHash = hashOfScene(scene);
    results.cases[i].lights = lightCounts(scene);
  }
  const fs::path file = options.folder / "results.json";
  if (options.resume && fs::exists(file)) takeOver(results, file);
  results.commands.push_back(console.commandLine);
  expectRuns(work);
  if (!options.reference) {
    for (const CaseRecord& c : results.cases) {
      if (!c.reference || !isAsked(*c.reference, options)) work.progress.expect(expectedReference(work));
    }
  }
  bool complete = true;
  for (std::size_t i = 0; i < results.cases.size() && complete; ++i) {
    complete = prepareCase(work, scenes.of(results.plan.cases[i]), i);
  }
  complete = complete && doAllRuns(work, scenes);
  writeResults(work);
  if (!complete) console.err << "cellcut: interrupted; the same command with --resume goes on\n";
  if (results.runs.empty()) return complete ? kDone : kFailed;
  writeReport(work);
  showEqualTime(work);
  console.err << "wrote " << options.folder.string() << '\n';
  return kDone;
}

}  // namespace

Verb addMeasure(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("measure", "Compare strategies and settings: error against time");
  const auto options = std::make_shared<MeasureOptions>();
  addMeasureOptions(*verb, *options);
  verb->footer(measureHelp());
  return {verb, [options](const Console& console) { return measure(*options, console); }};
}

}  // namespace cellcut
