#include "app/measure/options.h"

#include "app/numbers.h"
#include "app/option_text.h"
#include "renderer/base/error.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr std::uint64_t kMaxRuns = 10'000;

std::vector<std::string> split(const std::string& option, const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) throw InputError(option, "'" + text + "' has an empty entry");
    if (std::find(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), parts[i]) !=
        parts.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw InputError(option, "'" + text + "' names '" + parts[i] + "' twice");
    }
  }
  return parts;
}

/// Values are parsed here only to be refused early; the plan parses them again where it uses them.
void requireValue(const std::string& name, const std::string& value) {
  if (name == "quality") parseQuality("--sweep", value);
  if (name == "threshold") parseThreshold("--sweep", value);
  if (name == "max-cut") parseMaxCut("--sweep", value);
  if (name == "grid-resolution") parseGridResolution("--sweep", value);
  if (name == "in-cluster") parseInCluster("--sweep", value);
  if (name == "max-depth") parseMaxDepth("--sweep", value);
}

Sweep parseSweep(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (std::find(kSweepNames.begin(), kSweepNames.end(), name) == kSweepNames.end() || equals == std::string::npos) {
    throw InputError("--sweep",
                     "'" + text + "' is not of the form NAME=VALUE,VALUE with NAME one of " + joinedNames(kSweepNames));
  }
  Sweep sweep{name, split("--sweep", text.substr(equals + 1))};
  for (const std::string& value : sweep.values) requireValue(name, value);
  return sweep;
}

void addWhat(CLI::App& verb, MeasureOptions& o) {
  addText(
      verb, "SCENE", "", [&o](const std::string& t) { o.scene = t; },
      "Scene: .gltf, .glb, .obj, or a recipe's name: " + joinedNames(kRecipes))
      ->required();
  addText(
      verb, "-o,--output", "FOLDER", [&o](const std::string& t) { o.folder = t; },
      "Where the results go; made if need be")
      ->required();
  const auto strategies = [&o](const std::string& t) {
    o.strategies.clear();
    for (const std::string& name : split("--strategies", t))
      o.strategies.push_back(parseStrategy("--strategies", name));
  };
  addText(verb, "--strategies", "A,B,...", strategies, "What is compared; see below (default all)");
  const auto lights = [&o](const std::string& t) {
    o.lights.clear();
    for (const std::string& n : split("--lights", t)) {
      o.lights.push_back(parseWhole("--lights", n, {.most = kMaxRecipeLights}));
    }
  };
  addText(verb, "--lights", "N1,N2,...", lights,
          "Numbers of lights of a recipe (default " + std::to_string(kDefaultRecipeLights) + ")");
  const auto sweep = [&o](const std::vector<std::string>& all) {
    o.sweeps.clear();
    for (const std::string& t : all) o.sweeps.push_back(parseSweep(t));
  };
  verb.add_option_function<std::vector<std::string>>("--sweep", sweep,
                                                     "Vary one parameter, see below; may be given several times")
      ->type_name("NAME=V1,V2,...")
      ->allow_extra_args(false);
}

void addHowLong(CLI::App& verb, MeasureOptions& o) {
  const auto time = [&o](const std::string& t) {
    o.seconds = parseReal("--time", t, {.least = 0, .leastExcluded = true});
  };
  CLI::Option* timeOption =
      addText(verb, "--time", "SECONDS", time, "Of rendering in each run; errors are compared there (default 20)");
  const auto spp = [&o](const std::string& t) { o.passes = parseWhole("--spp", t, {.least = 1, .most = kMaxPasses}); };
  addText(verb, "--spp", "N", spp, "Samples per pixel of each run in place of a time: repeats bit for bit, times aside")
      ->excludes(timeOption);
  const auto runs = [&o](const std::string& t) {
    o.runs = static_cast<int>(parseWhole("--runs", t, {.least = 1, .most = kMaxRuns}));
  };
  addText(verb, "--runs", "K", runs, "Of each way to render, with seeds S, S+1, ... (default 5; 20 for claims)");
  CLI::Option* reference = addText(
      verb, "--reference", "FILE", [&o](const std::string& t) { o.reference = t; },
      "Compare with this picture, .exr, .pfm or .hdr (default: one is made and kept)");
  const auto passes = [&o](const std::string& t) {
    o.referencePasses = parseWhole("--reference-spp", t, {.least = 1, .most = kMaxPasses});
  };
  addText(verb, "--reference-spp", "N", passes,
          "Samples per pixel of the one that is made (default: 16 times --time or --spp)")
      ->excludes(reference);
  verb.add_flag("--resume", o.resume, "Go on with what is in FOLDER, or add runs to it");
}

}  // namespace

void addMeasureOptions(CLI::App& verb, MeasureOptions& options) {
  for (const StrategyName& s : kStrategies) options.strategies.push_back(s.strategy);
  options.picture.settings.width = 640;
  options.picture.settings.height = 360;
  addWhat(verb, options);
  addHowLong(verb, options);
  addSettingOptions(verb, options.picture);
}

void requireConsistent(const MeasureOptions& o) {
  const bool isRecipe = recipeFromName(o.scene).has_value();
  std::error_code error;  // what cannot be looked at, cannot be read either, and that says why
  if (!isRecipe && !std::filesystem::exists(o.scene, error) && !error) {
    throw InputError(o.scene, "is no file, and none of the recipes " + joinedNames(kRecipes));
  }
  if (!isRecipe && !o.lights.empty())
    throw InputError("--lights", "'" + o.scene + "' is a file; only recipes take a number of lights");
  const bool hasDepths =
      std::any_of(o.sweeps.begin(), o.sweeps.end(), [](const Sweep& s) { return s.name == "max-depth"; });
  if (o.reference && (hasDepths || o.lights.size() > 1)) {
    throw InputError("--reference", "one picture cannot judge several depths or numbers of lights; leave it out");
  }
}

}  // namespace cellcut
