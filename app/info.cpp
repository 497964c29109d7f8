/// The verb `info`: what is in a scene, as JSON.
#include "app/command_line.h"
#include "app/json_text.h"
#include "app/options.h"
#include "app/report.h"
#include "app/verbs.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/scene/load_scene.h"

#include <limits>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kInfoExamples =
    "Prints JSON: meshes, triangles, materials, textures, cameras, lights by kind, bounds, memory, warnings.\n"
    "\n"
    "Example:\n"
    "  cellcut info room.glb";

Json toJson(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json camerasOf(const Scene& scene) {
  Json cameras = Json::array();
  for (const Camera& camera : scene.cameras) {
    cameras.push_back({{"name", camera.name}, {"kind", camera.orthographic ? "orthographic" : "perspective"}});
  }
  return cameras;
}

/// In the file's own coordinates; null for a scene without anything in it.
Json boundsOf(const Scene& scene) {
  if (scene.bounds.empty()) return nullptr;
  return {{"lower", toJson(glm::dvec3(scene.bounds.lower) + scene.origin)},
          {"upper", toJson(glm::dvec3(scene.bounds.upper) + scene.origin)}};
}

/// Of the strongest light to the faintest, each by its peak intensity; local and distant ones apart, for W/sr and W/m² do
/// not compare. 1 without lights.
double intensityRatio(const Lights& lights) {
  double ratio = 1;
  const std::size_t distant = static_cast<std::size_t>(lights.idOf(LightKind::kDirectional, 0));
  for (const auto& [first, last] : {std::pair(std::size_t{0}, distant), std::pair(distant, lights.size())}) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t i = first; i < last; ++i) {
      const double intensity = peakIntensity(lights, static_cast<LightId>(i));
      if (!(intensity > 0)) continue;
      least = std::min(least, intensity);
      most = std::max(most, intensity);
    }
    if (most > 0) ratio = std::max(ratio, most / least);
  }
  return ratio;
}

/// Up to this ratio every light of a scene is proved to be reachable.
constexpr double kProvedRatio = 1e12;

Json warningsOf(const Scene& scene, double ratio) {
  Json warnings = scene.warnings;
  if (ratio > kProvedRatio) {
    std::ostringstream text;
    text << "the strongest light is " << ratio << " times as intense as the faintest; beyond " << kProvedRatio
         << " the faintest may never be chosen";
    warnings.push_back(text.str());
  }
  return warnings;
}

Json describe(const Scene& scene) {
  const Lights lights(scene);
  const double ratio = intensityRatio(lights);
  Json info;
  info["meshes"] = scene.counts.meshes;
  info["instances"] = scene.counts.instances;
  info["triangles"] = scene.triangleCount();
  info["degenerate_triangles"] = scene.counts.degenerateTriangles;
  info["materials"] = scene.materials.size();
  info["textures"] = scene.textures.size();
  info["cameras"] = camerasOf(scene);
  info["lights"] = toJson(lights.counts());
  info["intensity_ratio"] = ratio;
  info["bounds"] = boundsOf(scene);
  info["origin"] = toJson(scene.origin);
  info["memory"] = {{"scene", scene.bytes()}, {"peak_rss", peakResidentBytes()}};
  info["generator"] = scene.generator;
  info["warnings"] = warningsOf(scene, ratio);
  return info;
}

struct InfoOptions {
  std::string scene;
  LoadOptions load;
};

int showInfo(const InfoOptions& options, const Console& console) {
  console.out << jsonText(describe(loadScene(options.scene, options.load)), 2) << '\n';
  return kDone;
}

}  // namespace

Verb addInfo(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("info", "Print what is in a scene");
  const auto options = std::make_shared<InfoOptions>();
  verb->add_option("SCENE", options->scene, "Scene: .gltf, .glb or .obj")->required()->type_name("");
  addLoadLimits(*verb, options->load.limits);
  verb->footer(kInfoExamples);
  return {verb, [options](const Console& console) { return showInfo(*options, console); }};
}

}  // namespace cellcut
