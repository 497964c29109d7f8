/// The verb `info`: what is in a scene, as JSON.
#include "app/command_line.h"
#include "app/report.h"
#include "app/verbs.h"
#include "renderer/lights/lights.h"
#include "renderer/scene/load_scene.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExamples =
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

Json notesOf(const Scene& scene) {
  Json notes = Json::array();
  if (scene.generator.find("Blender") != std::string::npos) {
    notes.push_back(
        "written by Blender, which multiplies point, spot and directional lights by 683 and emissive surfaces not: "
        "render with --punctual-scale blender");
  }
  return notes;
}

Json describe(const Scene& scene) {
  Json info;
  info["meshes"] = scene.counts.meshes;
  info["instances"] = scene.counts.instances;
  info["triangles"] = scene.triangleCount();
  info["degenerate_triangles"] = scene.counts.degenerateTriangles;
  info["materials"] = scene.materials.size();
  info["textures"] = scene.textures.size();
  info["cameras"] = camerasOf(scene);
  info["lights"] = toJson(Lights(scene).counts());
  info["bounds"] = boundsOf(scene);
  info["origin"] = toJson(scene.origin);
  info["memory"] = {{"scene", scene.bytes()}, {"peak_rss", peakResidentBytes()}};
  info["generator"] = scene.generator;
  info["notes"] = notesOf(scene);
  info["warnings"] = scene.warnings;
  return info;
}

int showInfo(const std::string& file, const Console& console) {
  console.out << describe(loadScene(file)).dump(2) << '\n';
  return kDone;
}

}  // namespace

Verb addInfo(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("info", "Print what is in a scene");
  const auto file = std::make_shared<std::string>();
  verb->add_option("SCENE", *file, "Scene: .gltf, .glb or .obj")->required()->type_name("");
  verb->footer(kExamples);
  return {verb, [file](const Console& console) { return showInfo(*file, console); }};
}

}  // namespace cellcut
