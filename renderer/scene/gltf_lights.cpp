#include "renderer/base/error.h"
#include "renderer/scene/gltf_nodes.h"
#include "renderer/scene/gltf_values.h"

#include <numbers>

namespace cellcut {
namespace {

/// A light of the file as one node places it.
struct PlacedLight {
  const tinygltf::Light& light;
  const glm::dmat4& world;
  std::string place;
  Vec3 power;  ///< W/sr or W/m²

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(place, "light \"" + printable(light.name) + "\" " + problem);
  }
};

/// Colour × intensity × scale.
/// \throws InputError if the result is no power
Vec3 powerOf(const PlacedLight& placed, double scale) {
  const glm::dvec3 color = vectorOr<3>(placed.light.color, glm::dvec3(1), placed.place + ": color");
  if (color.x < 0 || color.y < 0 || color.z < 0) placed.refuse("has a negative color; make it 0 or more");
  if (placed.light.intensity < 0) placed.refuse("has a negative intensity; make it 0 or more");
  const Vec3 power(color * placed.light.intensity * scale);
  if (!cellcut::isFinite(power)) placed.refuse("is brighter than a float can hold; lower its intensity");
  return power;
}

/// Where the light shines: −z of its node. Empty, with a warning, if the node is scaled to nothing.
std::optional<Vec3> axisOf(const PlacedLight& placed, Scene& scene) {
  const glm::dvec3 axis(-placed.world[2]);
  const double length = glm::length(axis);
  if (length > 0 && std::isfinite(length)) return Vec3(axis / length);
  warnOnce(scene, placed.place + ": a light whose node is scaled to nothing has no direction and is ignored");
  return std::nullopt;
}

void setCone(const PlacedLight& placed, Scene& scene, SpotLight& spot) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  double inner = placed.light.spot.innerConeAngle;
  double outer = placed.light.spot.outerConeAngle;
  if (!(outer > 0)) placed.refuse("has an outer cone angle that is not positive; it could light nothing");
  if (inner < 0) placed.refuse("has a negative inner cone angle");
  if (outer > kRightAngle) {
    warnOnce(scene, placed.place + ": an outer cone angle of more than 90° was clamped");
    outer = kRightAngle;
  }
  if (inner >= outer) {
    warnOnce(scene, placed.place + ": an inner cone angle that is not less than the outer one was clamped");
    inner = outer;
  }
  // The falloff divides by the difference of the cosines; in float it may be nothing even where the angles differ.
  spot.cosOuter = std::min(static_cast<float>(std::cos(outer)), std::nextafter(1.0f, 0.0f));
  spot.cosInner = std::max(static_cast<float>(std::cos(inner)), std::nextafter(spot.cosOuter, 1.0f));
}

void addLight(const PlacedLight& placed, SceneDraft& draft) {
  Scene& scene = draft.scene;
  if (placed.light.range > 0) warnOnce(scene, "lights shine beyond the range that the file gives them");
  const glm::dvec3 position(placed.world[3]);
  if (placed.light.type == "point") {
    scene.pointLights.push_back({Vec3(0), placed.power});
    draft.pointPositions.push_back(position);
  } else if (placed.light.type == "spot") {
    const std::optional<Vec3> axis = axisOf(placed, scene);
    if (!axis) return;
    SpotLight spot{Vec3(0), *axis, placed.power, 1, 0};
    setCone(placed, scene, spot);
    scene.spotLights.push_back(spot);
    draft.spotPositions.push_back(position);
  } else if (placed.light.type == "directional") {
    if (const std::optional<Vec3> axis = axisOf(placed, scene))
      scene.directionalLights.push_back({*axis, placed.power});
  } else {
    placed.refuse("is neither point, spot nor directional; export the file again");
  }
}

}  // namespace

void readLights(const GltfDocument& document, const std::vector<GltfNode>& nodes, const LoadOptions& options,
                SceneDraft& draft) {
  if (!(options.punctualScale >= 0 && std::isfinite(options.punctualScale))) {
    throw InputError("punctual scale", "must be a finite number that is 0 or more");
  }
  for (const GltfNode& node : nodes) {
    const tinygltf::Value* reference = extension(document.model.nodes[node.index].extensions, "KHR_lights_punctual");
    if (!reference) continue;
    const std::string nodePlace = placeOf(document, "nodes", node.index);
    const std::optional<int> index = indexMember(*reference, "light", nodePlace);
    if (!index) continue;
    const auto light = static_cast<std::size_t>(*index);
    if (light >= document.model.lights.size()) {
      throw InputError(nodePlace, "light " + std::to_string(*index) + " does not exist; export the file again");
    }
    PlacedLight placed{document.model.lights[light], node.world, placeOf(document, "lights", light), Vec3(0)};
    placed.power = powerOf(placed, options.punctualScale);
    if (!isBlack(placed.power)) addLight(placed, draft);  // else it is switched off, and no strategy shall choose it
  }
}

}  // namespace cellcut
