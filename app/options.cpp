#include "app/options.h"

#include "app/numbers.h"
#include "app/option_text.h"
#include "renderer/base/error.h"
#include "renderer/base/exact_number.h"
#include "renderer/measure/quality_choice.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <oneapi/tbb/info.h>

namespace cellcut {
namespace {

constexpr std::string_view kAutoQuality = "auto";

constexpr const char* kNoiseExplanation = R"(
Noise: rendering stops when the root of relMSE (see compare) against the unknown truth is below REL with 97 %, as far
as the samples tell. It is looked at after 16, 20, 25, 32, 40, 50, 64, ... passes.
)";

constexpr const char* kBlenderExplanation = R"(
Blender's exporter multiplies point, spot and directional lights by 683 (lumen per watt) and emissive surfaces not:
--punctual-scale blender undoes it.
)";

PixelSampling parseSampler(const std::string& name) {
  return requireNamed(std::array{PixelSampling::kSobol, PixelSampling::kIndependent}, "--sampler", name);
}

double parsePunctualScale(const std::string& text) {
  // Lumen per watt at 555 nm: what Blender's exporter multiplies its lights by (glTF wants candela).
  if (text == "blender") return 1.0 / 683.0;
  return parseReal("--punctual-scale", text, {.least = 0, .alsoKnown = "blender"});
}

int parseSide(const std::string& text) {
  return static_cast<int>(parseWhole("--size", text, {.least = 1, .most = kMaxPictureSide}));
}

void parseSize(const std::string& text, RenderSettings& settings) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) throw InputError("--size", "'" + text + "' is not of the form 1280x720");
  settings.width = parseSide(text.substr(0, cross));
  settings.height = parseSide(text.substr(cross + 1));
}

void addFiles(CLI::App& verb, RenderOptions& o) {
  addText(
      verb, "SCENE", "", [&o](const std::string& t) { o.scene = t; }, "Scene: .gltf, .glb or .obj")
      ->required();
  addText(
      verb, "-o,--output", "FILE", [&o](const std::string& t) { o.output = checkedOutput(t); },
      "Picture: .exr (linear, all layers), .pfm (raw), .png (tone mapped)")
      ->required();
  const auto report = [&o](const std::string& t) {
    requireWritable(t);
    o.report = t;
  };
  addText(verb, "--report", "FILE", report, "Write a JSON report of what was done");
}

void addStopRule(CLI::App& verb, std::optional<StopRule>& stop) {
  const auto spp = [&stop](const std::string& t) {
    stop = {.kind = StopRule::Kind::kPasses, .passes = parseWhole("--spp", t, {.least = 1, .most = kMaxPasses})};
  };
  const auto time = [&stop](const std::string& t) {
    stop = {.kind = StopRule::Kind::kSeconds, .seconds = parseReal("--time", t, {.least = 0, .leastExcluded = true})};
  };
  const auto noise = [&stop](const std::string& t) {
    stop = {.kind = StopRule::Kind::kNoise, .noise = parseReal("--noise", t, {.least = 0, .leastExcluded = true})};
  };
  CLI::Option* sppOption = addText(verb, "--spp", "N", spp,
                                   "Stop after N samples per pixel (default 64, screenshot 16; the viewer goes on)");
  CLI::Option* timeOption =
      addText(verb, "--time", "SECONDS", time, "Stop at the end of the pass in which SECONDS of rendering run out");
  CLI::Option* noiseOption =
      addText(verb, "--noise", "REL", noise, "Stop when the relative error is below REL; see below");
  sppOption->excludes(timeOption)->excludes(noiseOption);
  timeOption->excludes(noiseOption);
}

void addStrategy(CLI::App& verb, RenderSettings& s) {
  addText(
      verb, "--strategy", "NAME", [&s](const std::string& t) { s.strategy = parseStrategy("--strategy", t); },
      "How a light is chosen; see below (default " + std::string(nameOf(s.strategy)) + ")");
}

void addSampling(CLI::App& verb, RenderSettings& s) {
  addText(
      verb, "--sampler", "NAME", [&s](const std::string& t) { s.sampling = parseSampler(t); },
      "Random numbers: sobol (Owen-scrambled) or independent (default sobol)");
  addText(
      verb, "--size", "WxH", [&s](const std::string& t) { parseSize(t, s); },
      "Pixels, each side up to " + std::to_string(kMaxPictureSide) + " (default " + sizeText(s.width, s.height) + ")");
  const auto depth = [&s](const std::string& t) { s.maxDepth = parseMaxDepth("--max-depth", t); };
  addText(verb, "--max-depth", "D", depth,
          "Times a path may scatter: 0 emitters only, 1 direct light only (default 8)");
  addText(
      verb, "--seed", "S", [&s](const std::string& t) { s.seed = parseWhole("--seed", t, {}); },
      "Another seed, another noise (default 0)");
  const auto threads = [&s](const std::string& t) {
    s.threads = static_cast<int>(parseWhole("--threads", t, {.most = kMaxThreads}));
  };
  addText(verb, "--threads", "T", threads, "0 is one per hardware thread (default); the picture is the same for any");
}

void setQuality(RenderOptions& o, const std::string& name, bool autoQuality) {
  o.candidates.clear();
  if (autoQuality && name == kAutoQuality) {
    o.candidates = autoQualities();
    o.settings.sampler = o.candidates[0].settings;
  } else {
    o.settings.sampler = parseQuality("--quality", name, autoQuality ? kAutoQuality : "").settings;
  }
}

/// An option that wins over the preset, and over those that --quality auto tries.
template <class Parse>
void addExplicit(CLI::App& verb, RenderOptions& o, const std::string& name, const std::string& type,
                 const std::string& description, const Parse& parse) {
  const auto use = [&o, parse](const std::string& text) {
    parse(o.settings.sampler, text);
    for (Quality& candidate : o.candidates) parse(candidate.settings, text);
  };
  addText(verb, name, type, use, description);
}

void addCuts(CLI::App& verb, RenderOptions& o, bool autoQuality) {
  const SamplerSettings& defaults = o.settings.sampler;
  std::ostringstream threshold;
  threshold << defaults.threshold;
  // Options are applied in the order in which they are declared here, whatever their order on the command line: an
  // explicit one wins over the preset.
  addText(
      verb, "--quality", "NAME", [&o, autoQuality](const std::string& t) { setQuality(o, t, autoQuality); },
      "Preset of the next four options; see below (default balanced)");
  addExplicit(verb, o, "--threshold", "X",
              "Split clusters above this share of a cut's estimate (default " + threshold.str() + ")",
              [](SamplerSettings& s, const std::string& t) { s.threshold = parseThreshold("--threshold", t); });
  addExplicit(verb, o, "--max-cut", "K", "Most clusters of a cut (default " + std::to_string(defaults.maxCut) + ")",
              [](SamplerSettings& s, const std::string& t) { s.maxCut = parseMaxCut("--max-cut", t); });
  addExplicit(
      verb, o, "--grid-resolution", "R",
      "Cells along the longest axis of what is seen (default " + std::to_string(defaults.gridResolution) + ")",
      [](SamplerSettings& s, const std::string& t) { s.gridResolution = parseGridResolution("--grid-resolution", t); });
  addExplicit(verb, o, "--in-cluster", "intensity|descent",
              "How a light is chosen inside a cluster (default " + std::string(nameOf(defaults.inCluster)) + ")",
              [](SamplerSettings& s, const std::string& t) { s.inCluster = parseInCluster("--in-cluster", t); });
  addExplicit(verb, o, "--cell-memory", "MB",
              "Kept cuts; beyond it the same are found again, slower (default " +
                  std::to_string(defaults.cellMemory >> 20) + ")",
              [](SamplerSettings& s, const std::string& t) {
                s.cellMemory = static_cast<std::size_t>(parseWhole("--cell-memory", t, {.most = kMaxCellMegabytes}))
                               << 20;
              });
}

}  // namespace

void addLoadLimits(CLI::App& verb, LoadLimits& limits) {
  addText(
      verb, "--max-triangles", "N",
      [&limits](const std::string& t) {
        limits.maxTriangles = parseWhole("--max-triangles", t, {.most = kMaxTriangles});
      },
      "Refuse scenes with more, instances written out (default " + std::to_string(limits.maxTriangles) + ")");
  addText(
      verb, "--max-texture-bytes", "N",
      [&limits](const std::string& t) { limits.maxTextureBytes = parseWhole("--max-texture-bytes", t, {}); },
      "Refuse more in a scene's textures or environment, decoded (default " + std::to_string(limits.maxTextureBytes) +
          ")");
}

namespace {

void addSceneOptions(CLI::App& verb, RenderOptions& o) {
  addText(
      verb, "--camera", "NAME|INDEX",
      [&o](const std::string& t) {
        if (t.empty()) throw InputError("--camera", "names none; leave it out for the first");
        o.camera = t;
      },
      "A camera of the scene by its name or its number from 0 (default 0)");
  EnvironmentOptions& e = o.environment;
  CLI::Option* file = addText(
      verb, "--environment", "FILE", [&e](const std::string& t) { e.file = t; },
      "Light from all around: a lat-long .exr or .hdr, in place of the scene's own");
  const auto scale = [&e](const std::string& t) { e.scale = parseReal("--environment-scale", t, {.least = 0}); };
  addText(verb, "--environment-scale", "X", scale, "Multiplies its radiance (default 1)")->needs(file);
  const auto rotation = [&e](const std::string& t) { e.rotation = parseReal("--environment-rotation", t, {}); };
  addText(verb, "--environment-rotation", "DEG", rotation,
          "Turns it about +Y, counter-clockwise seen from above (default 0)")
      ->needs(file);
  addText(
      verb, "--punctual-scale", "X|blender",
      [&o](const std::string& t) { o.load.punctualScale = parsePunctualScale(t); },
      "Multiplies point, spot and directional lights; see below");
  addLoadLimits(verb, o.load.limits);
}

bool givesLight(const Scene& scene) {
  return scene.environment || !scene.pointLights.empty() || !scene.spotLights.empty() ||
         !scene.directionalLights.empty() ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.unlit || m.emission != Vec3(0); });
}

std::string describeCameras(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " '" + scene.cameras[i].name + "'";
  }
  return text;
}

}  // namespace

Strategy parseStrategy(const std::string& option, const std::string& name) {
  return requireNamed(kStrategies, option, name).strategy;
}

InCluster parseInCluster(const std::string& option, const std::string& name) {
  return requireNamed(std::array{InCluster::kIntensity, InCluster::kDescent}, option, name);
}

Quality parseQuality(const std::string& option, const std::string& name, std::string_view alsoKnown) {
  return requireNamed(kQualities, option, name, alsoKnown);
}

float parseThreshold(const std::string& option, const std::string& text) {
  return static_cast<float>(parseReal(option, text, {.least = 0, .most = 1}));
}

int parseMaxCut(const std::string& option, const std::string& text) {
  return static_cast<int>(parseWhole(option, text, {.least = 2, .most = kMaxCutSize}));
}

int parseGridResolution(const std::string& option, const std::string& text) {
  return static_cast<int>(parseWhole(option, text, {.least = 1, .most = kMaxGridResolution}));
}

int parseMaxDepth(const std::string& option, const std::string& text) {
  return static_cast<int>(parseWhole(option, text, {.most = kMaxDepthLimit}));
}

std::string pinningOptions(const SamplerSettings& s) {
  return "--threshold " + exactNumber(s.threshold) + " --max-cut " + std::to_string(s.maxCut) + " --grid-resolution " +
         std::to_string(s.gridResolution) + " --in-cluster " + std::string(nameOf(s.inCluster));
}

namespace {

void addSettings(CLI::App& verb, RenderOptions& options, bool autoQuality) {
  addSampling(verb, options.settings);
  addCuts(verb, options, autoQuality);
  addSceneOptions(verb, options);
}

void addPicture(CLI::App& verb, RenderOptions& options, bool autoQuality) {
  addStopRule(verb, options.stop);
  addStrategy(verb, options.settings);
  addSettings(verb, options, autoQuality);
}

}  // namespace

void addRenderOptions(CLI::App& verb, RenderOptions& options) {
  addFiles(verb, options);
  addPicture(verb, options, true);
}

void addPictureOptions(CLI::App& verb, RenderOptions& options) {
  addPicture(verb, options, false);
}

void addSettingOptions(CLI::App& verb, RenderOptions& options) {
  addSettings(verb, options, false);
}

std::string explainPictureOptions() {
  return explainSettingOptions() + kNoiseExplanation;
}

std::string explainSettingOptions() {
  return "Strategies:\n" + explained(kStrategies) + "\nQualities:\n" + explained(kQualities) + kBlenderExplanation;
}

double installedMemory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void requireMemory(const RenderSettings& settings) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  const double needed = pixels * static_cast<double>(Film::bytesPerPixel(settings.auxiliary));
  const double installed = installedMemory();
  if (needed <= installed) return;
  std::ostringstream problem;
  problem << settings.width << "x" << settings.height << " pixels take " << std::llround(needed / 1e9)
          << " GB while they are rendered and this machine has " << std::llround(installed / 1e9) << " GB; choose fewer"
          << (settings.auxiliary ? ", or .png or .pfm, which need half" : "");
  throw InputError("--size", problem.str());
}

std::size_t findCamera(const Scene& scene, const std::string& nameOrIndex) {
  if (nameOrIndex.empty()) return 0;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].name == nameOrIndex) return i;
  }
  std::size_t index = 0;
  const char* end = nameOrIndex.data() + nameOrIndex.size();
  const auto [stop, error] = std::from_chars(nameOrIndex.data(), end, index);
  if (error == std::errc{} && stop == end && index < scene.cameras.size()) return index;
  throw InputError("--camera", "the scene has no '" + nameOrIndex + "'; it has " + describeCameras(scene));
}

std::vector<NamedFile> inputsOf(const RenderOptions& options) {
  return {{"SCENE", options.scene}, {"--environment", options.environment.file.value_or("")}};
}

tbb::global_control allowThreads(const RenderSettings& settings) {
  const auto cores = static_cast<std::size_t>(tbb::info::default_concurrency());
  return {tbb::global_control::max_allowed_parallelism, std::max(cores, static_cast<std::size_t>(settings.threads))};
}

Scene loadWithOptions(const RenderOptions& options) {
  Scene scene = loadScene(options.scene, options.load);
  const EnvironmentOptions& environment = options.environment;
  if (environment.file) {
    const std::string name = environment.file->string();
    setEnvironment(scene, readImage(*environment.file, options.load.limits.maxTextureBytes), environment.scale,
                   environment.rotation, name);
  }
  if (!givesLight(scene)) {
    scene.warnings.emplace_back(
        "nothing in the scene gives light, so that the picture is black; --environment lights it");
  }
  return scene;
}

}  // namespace cellcut
