#include "app/report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

nlohmann::ordered_json meanColour(const ImageRgb& picture) {
  glm::dvec3 sum(0.0);
  for (const Vec3& pixel : picture) sum += glm::dvec3(pixel);
  const glm::dvec3 mean = sum / static_cast<double>(picture.size());
  return {mean.x, mean.y, mean.z};
}

/// Keys of what the strategy has; none of what it has not.
void addStatistics(nlohmann::ordered_json& report, const SamplerStatistics& statistics) {
  if (const auto& grid = statistics.grid) {
    const double cells = static_cast<double>(grid->resolution[0]) * grid->resolution[1] * grid->resolution[2];
    report["grid"] = {{"resolution", grid->resolution},
                      {"cells", cells},
                      {"touched", grid->fine},
                      {"touched_coarse", grid->coarse},
                      {"touched_percent", 100 * static_cast<double>(grid->fine) / cells}};
  }
  if (const auto& cut = statistics.cut) {
    report["cut"] = {
        {"min", cut->min}, {"mean", cut->mean}, {"max", cut->max}, {"seconds", cut->seconds}, {"bytes", cut->bytes}};
  }
  if (const auto& tree = statistics.tree) {
    report["tree"] = {
        {"nodes", tree->nodes}, {"depth", tree->depth}, {"seconds", tree->seconds}, {"bytes", tree->bytes}};
  }
}

nlohmann::ordered_json toJson(const QualityChoice& choice) {
  nlohmann::ordered_json trials = nlohmann::ordered_json::array();
  for (const QualityTrial& t : choice.trials) {
    trials.push_back({{"name", t.quality.name},
                      {"options", pinningOptions(t.quality.settings)},
                      {"passes", t.passes},
                      {"seconds", t.seconds},
                      {"seconds_pass", t.passSeconds},
                      {"seconds_build", t.buildSeconds},
                      {"relative_variance", t.relativeVariance},
                      {"inefficiency", t.inefficiency.value},
                      {"inefficiency_low", t.inefficiency.low},
                      {"inefficiency_high", t.inefficiency.high}});
  }
  return {{"chosen", choice.chosen.name},
          {"options", pinningOptions(choice.chosen.settings)},
          {"trials", std::move(trials)}};
}

}  // namespace

std::size_t peakResidentBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

nlohmann::ordered_json toJson(const LightCounts& lights) {
  return {{"point", lights.point},
          {"spot", lights.spot},
          {"triangle", lights.triangle},
          {"directional", lights.directional},
          {"environment", lights.environment}};
}

nlohmann::ordered_json renderReport(const RenderRecord& record) {
  const Renderer& renderer = record.renderer;
  const RenderSettings& settings = renderer.settings();
  const RayCounts rays = renderer.rays();
  const MemoryUse memory = renderer.memory();
  const BadSamples bad = renderer.film().badSamples();
  nlohmann::ordered_json report;
  report["version"] = CELLCUT_VERSION;
  report["scene"] = record.options.scene.string();
  report["seconds_load"] = record.times.load;
  report["seconds_build"] = record.times.build;
  if (record.quality) report["seconds_quality"] = record.quality->seconds;
  report["seconds_render"] = record.times.render;
  report["passes"] = renderer.film().passes();
  report["spp"] = renderer.film().passes();
  report["interrupted"] = record.interrupted;
  report["width"] = settings.width;
  report["height"] = settings.height;
  report["max_depth"] = settings.maxDepth;
  report["strategy"] = nameOf(settings.strategy);
  report["sampler"] = nameOf(settings.sampling);
  if (record.quality) report["quality"] = toJson(*record.quality);
  report["seed"] = settings.seed;
  report["threads"] = renderer.threads();
  report["rays"] = {{"camera", rays.camera}, {"bounce", rays.bounce}, {"shadow", rays.shadow}};
  report["lights"] = toJson(renderer.lightCounts());
  report["memory"] = {{"peak_rss", peakResidentBytes()},
                      {"scene", memory.scene},
                      {"accel", memory.accel},
                      {"lights", memory.lights},
                      {"film", memory.film}};
  addStatistics(report, renderer.samplerStatistics());
  report["samples"] = {{"nan", bad.nan}, {"inf", bad.inf}, {"dropped", renderer.droppedSamples()}};
  report["mean"] = meanColour(renderer.film().mean());
  report["relative_error"] = renderer.film().relativeError();
  return report;
}

std::map<std::string, std::string> pictureMetadata(const RenderRecord& record, const std::string& commandLine) {
  const RenderSettings& settings = record.renderer.settings();
  return {
      {"software", "cellcut " CELLCUT_VERSION},
      {"commandLine", commandLine},
      {"scene", record.options.scene.string()},
      {"camera", record.scene.cameras[settings.camera].name},
      {"strategy", std::string(nameOf(settings.strategy))},
      {"sampler", std::string(nameOf(settings.sampling))},
      {"spp", std::to_string(record.renderer.film().passes())},
      {"seed", std::to_string(settings.seed)},
      {"maxDepth", std::to_string(settings.maxDepth)},
      {"secondsRender", std::to_string(record.times.render)},
  };
}

}  // namespace cellcut
