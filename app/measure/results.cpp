#include "app/measure/results.h"

#include "app/json_text.h"
#include "app/measure/scene_hash.h"
#include "app/measure/summary.h"
#include "app/report.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/measure/convergence.h"
#include "renderer/scene/gltf_container.h"

#include <algorithm>
#include <fstream>
#include <sys/utsname.h>
#include <thread>

namespace cellcut {
namespace {

using Json = nlohmann::ordered_json;

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

Json machineJson(const MeasureOptions& options) {
  utsname system{};
  uname(&system);
  const unsigned threads = std::thread::hardware_concurrency();
  return {{"processor", processorName()},
          {"hardware_threads", threads},
          {"threads",
           options.picture.settings.threads > 0 ? static_cast<unsigned>(options.picture.settings.threads) : threads},
          {"memory_bytes", installedMemory()},
          {"system", std::string(system.sysname) + " " + system.release + " " + system.machine},
          {"compiler", __VERSION__}};
}

Json samplerJson(const SamplerSettings& s) {
  return {{"threshold", s.threshold},
          {"max_cut", s.maxCut},
          {"grid_resolution", s.gridResolution},
          {"in_cluster", nameOf(s.inCluster)},
          {"cell_memory", s.cellMemory}};
}

Json caseJson(const MeasureCase& c, const CaseRecord& record) {
  Json json{{"name", c.name},
            {"max_depth", c.maxDepth},
            {"scene_hash", hexOf(record.sceneHash)},
            {"lights", toJson(record.lights)}};
  if (const auto& r = record.reference) {
    json["reference"] = {
        {"file", r->file.string()}, {"relmse", r->relmse}, {"spp", r->passes}, {"seconds", r->seconds}};
  }
  return json;
}

Json configurationJson(const MeasurePlan& plan, const Configuration& c) {
  Json json{
      {"name", c.name}, {"case", plan.cases[c.caseIndex].name}, {"strategy", nameOf(c.strategy)}, {"base", c.isBase}};
  if (hasCuts(c.strategy)) json["parameters"] = samplerJson(c.sampler);
  Json points = Json::array();
  for (const SweepPoint& p : c.points) points.push_back({{"name", p.name}, {"value", p.value}});
  json["sweeps"] = points;
  return json;
}

Json checkpointJson(const Checkpoint& c) {
  return {{"spp", c.passes},  {"seconds", c.seconds},   {"pass_seconds", c.passSeconds},
          {"mse", c.mse},     {"relmse", c.relmse},     {"smape", c.smape},
          {"flip", c.flip},   {"flip_ldr", c.flipLdr},  {"cut_size", c.cutSize},
          {"cells", c.cells}, {"memory_bytes", c.bytes}};
}

/// Errors that are not finite were written as null.
double numberOf(const Json& json, const char* key) {
  const Json& value = json.at(key);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Checkpoint checkpointOf(const Json& j) {
  return {.passes = j.at("spp"),
          .seconds = j.at("seconds"),
          .passSeconds = j.at("pass_seconds"),
          .mse = numberOf(j, "mse"),
          .relmse = numberOf(j, "relmse"),
          .smape = numberOf(j, "smape"),
          .flip = numberOf(j, "flip"),
          .flipLdr = numberOf(j, "flip_ldr"),
          .cutSize = j.at("cut_size"),
          .cells = j.at("cells"),
          .bytes = j.at("memory_bytes")};
}

Json runJson(const MeasurePlan& plan, const RunRecord& run) {
  Json checkpoints = Json::array();
  for (const Checkpoint& c : run.checkpoints) checkpoints.push_back(checkpointJson(c));
  return {{"configuration", plan.configurations[run.configuration].name},
          {"run", run.run},
          {"seed", run.seed},
          {"build_seconds", run.buildSeconds},
          {"bad_samples", run.badSamples},
          {"checkpoints", checkpoints}};
}

Json toJson(const Estimate& e) {
  return {e.value, e.low, e.high};
}

Json rowJson(const MeasurePlan& plan, const SummaryRow& r) {
  return {{"configuration", plan.configurations[r.configuration].name},
          {"at", r.equalTime ? "time" : "passes"},
          {"runs", r.runs},
          {"spp", r.passes},
          {"seconds", toJson(r.seconds)},
          {"mse", toJson(r.mse)},
          {"relmse", toJson(r.relmse)},
          {"smape", toJson(r.smape)},
          {"flip", toJson(r.flip)},
          {"flip_ldr", toJson(r.flipLdr)},
          {"inefficiency", toJson(r.inefficiency)},
          {"pass_seconds", r.passSeconds},
          {"build_seconds", r.buildSeconds},
          {"cut_size", r.cutSize},
          {"cells", r.cells},
          {"memory_bytes", r.bytes}};
}

Json slopesJson(const MeasureResults& results) {
  Json slopes = Json::array();
  for (std::size_t i = 0; i < results.plan.configurations.size(); ++i) {
    const Slopes s = slopesOf(results, i);
    slopes.push_back({{"configuration", results.plan.configurations[i].name},
                      {"over_spp", toJson(s.overPasses)},
                      {"over_seconds", toJson(s.overSeconds)}});
  }
  return slopes;
}

Json gainsJson(const MeasureResults& results, std::optional<double> seconds) {
  Json gains = Json::array();
  for (const Gain& g : gainsOf(results, seconds)) {
    gains.push_back({{"configuration", results.plan.configurations[g.configuration].name},
                     {"relmse_ratio", toJson(g.relmse)},
                     {"inefficiency_ratio", toJson(g.inefficiency)}});
  }
  return gains;
}

/// What of everything that was measured on a case is worth its time.
Json frontsJson(const MeasureResults& results, const std::vector<SummaryRow>& rows) {
  Json fronts = Json::array();
  for (std::size_t i = 0; i < results.plan.cases.size(); ++i) {
    std::vector<const SummaryRow*> own;
    std::vector<CurvePoint> points;
    for (const SummaryRow& row : rows) {
      if (results.plan.configurations[row.configuration].caseIndex != i) continue;
      own.push_back(&row);
      points.push_back({row.seconds.value, row.relmse.value});
    }
    Json front = Json::array();
    for (const std::size_t k : paretoFront(points)) {
      front.push_back({{"configuration", results.plan.configurations[own[k]->configuration].name},
                       {"spp", own[k]->passes},
                       {"seconds", points[k].x},
                       {"relmse", points[k].y}});
    }
    fronts.push_back({{"case", results.plan.cases[i].name}, {"points", front}});
  }
  return fronts;
}

/// What the file has otherwise than the command, in any order: "seed 5 in place of 0, parameters/threshold …"; empty if
/// there is nothing.
std::string differences(const nlohmann::json& file, const nlohmann::json& command) {
  const nlohmann::json there = file.flatten();
  nlohmann::json here = command.flatten();
  std::string text;
  const auto add = [&](const std::string& path, const std::string& before, const std::string& now) {
    text += (text.empty() ? "" : ", ") + path.substr(path.starts_with('/')) + ' ' + before + " in place of " + now;
  };
  for (const auto& [path, value] : there.items()) {
    if (!here.contains(path)) add(path, jsonText(value), "none");
    if (here.contains(path) && here[path] != value) add(path, jsonText(value), jsonText(here[path]));
    here.erase(path);
  }
  for (const auto& [path, value] : here.items()) add(path, "none", jsonText(value));
  return text;
}

void takeOverCase(MeasureResults& results, const Json& json, const std::string& file) {
  const auto& cases = results.plan.cases;
  const auto name = json.at("name").get<std::string>();
  const auto same = std::find_if(cases.begin(), cases.end(), [&](const MeasureCase& c) { return c.name == name; });
  if (same == cases.end()) return;
  CaseRecord& record = results.cases[static_cast<std::size_t>(same - cases.begin())];
  if (json.at("scene_hash") != hexOf(record.sceneHash)) {
    throw InputError(file, "was measured on another content of '" + same->name + "'; choose another folder");
  }
  if (!json.contains("reference")) return;
  const Json& r = json.at("reference");
  record.reference =
      MeasureReference{{}, numberOf(r, "relmse"), r.at("spp"), r.at("seconds"), r.at("file").get<std::string>()};
}

RunRecord runOf(const MeasurePlan& plan, const Json& json, const std::string& file) {
  const auto& all = plan.configurations;
  const std::string name = json.at("configuration");
  const auto same = std::find_if(all.begin(), all.end(), [&](const Configuration& c) { return c.name == name; });
  if (same == all.end()) {
    throw InputError(file, "holds runs of '" + name + "', which this command does not ask for; choose another folder");
  }
  RunRecord run{static_cast<std::size_t>(same - all.begin()),
                json.at("run"),
                json.at("seed"),
                json.at("build_seconds"),
                json.at("bad_samples"),
                {}};
  for (const Json& c : json.at("checkpoints")) run.checkpoints.push_back(checkpointOf(c));
  if (run.checkpoints.empty()) throw InputError(file, "has a run without checkpoints; choose another folder");
  return run;
}

}  // namespace

Json settingsJson(const MeasureOptions& options) {
  const RenderOptions& p = options.picture;
  const RenderSettings& s = p.settings;
  Json json{{"scene", options.scene},
            {"camera", p.camera},
            {"width", s.width},
            {"height", s.height},
            {"sampler", nameOf(s.sampling)},
            {"seed", s.seed},
            {"threads", s.threads},
            {"parameters", samplerJson(s.sampler)},
            {"punctual_scale", p.load.punctualScale}};
  if (const auto& file = p.environment.file) {
    json["environment"] = {
        {"file", file->string()}, {"scale", p.environment.scale}, {"rotation", p.environment.rotation}};
  }
  if (options.passes) json["spp"] = *options.passes;
  if (!options.passes) json["seconds"] = options.seconds;
  return json;
}

Json resultsJson(const MeasureResults& results, const MeasureOptions& options) {
  const std::optional<double> seconds = options.passes ? std::nullopt : std::optional(options.seconds);
  Json json{{"version", CELLCUT_VERSION},
            {"commands", results.commands},
            {"machine", machineJson(options)},
            {"settings", results.settings},
            {"confidence", kConfidence}};
  for (const char* key : {"cases", "configurations", "summary", "runs"}) json[key] = Json::array();
  for (std::size_t i = 0; i < results.cases.size(); ++i)
    json["cases"].push_back(caseJson(results.plan.cases[i], results.cases[i]));
  for (const Configuration& c : results.plan.configurations)
    json["configurations"].push_back(configurationJson(results.plan, c));
  const std::vector<SummaryRow> rows = summaryOf(results, seconds);
  for (const SummaryRow& row : rows) json["summary"].push_back(rowJson(results.plan, row));
  json["fronts"] = frontsJson(results, rows);
  json["slopes"] = slopesJson(results);
  json["cell_cut_gains"] = gainsJson(results, seconds);
  for (const RunRecord& run : results.runs) json["runs"].push_back(runJson(results.plan, run));
  return json;
}

void takeOver(MeasureResults& results, const std::filesystem::path& path) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;
  const std::string file = path.string();
  const std::vector<std::byte> bytes = readFile(path, kMostBytes);
  try {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    checkJsonShape(text, file, "choose another folder");
    const Json json = Json::parse(text);
    // Through text, as the numbers in the file went: 0.002f there is the double nearest to it.
    const std::string others = differences(json.at("settings"), Json::parse(jsonText(results.settings)));
    if (!others.empty()) throw InputError(file, "was made with " + others + "; use that or another folder");
    for (const Json& c : json.at("cases")) takeOverCase(results, c, file);
    for (const Json& run : json.at("runs")) results.runs.push_back(runOf(results.plan, run, file));
    results.commands = json.at("commands").get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception& problem) {
    throw InputError(file, std::string("is damaged (") + problem.what() + "); choose another folder");
  }
}

}  // namespace cellcut
