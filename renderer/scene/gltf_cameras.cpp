#include "renderer/base/error.h"
#include "renderer/scene/gltf_nodes.h"

#include <map>
#include <numbers>

namespace cellcut {
namespace {

/// Orthonormal axes nearest to the node's; false if the node has none. A mirrored node's camera is not mirrored: right
/// follows.
bool setAxes(const glm::dmat4& world, Camera& camera) {
  const glm::dvec3 z(world[2]), y(world[1]);
  const double zLength = glm::length(z);
  if (!(zLength > 0 && std::isfinite(zLength))) return false;
  const glm::dvec3 back = z / zLength;
  const glm::dvec3 up = y - glm::dot(y, back) * back;
  const double upLength = glm::length(up);
  if (!(upLength > 0 && std::isfinite(upLength))) return false;
  camera.back = Vec3(back);
  camera.up = Vec3(up / upLength);
  camera.right = Vec3(glm::cross(up / upLength, back));
  return true;
}

void setLens(const tinygltf::Camera& source, const std::string& place, Camera& camera) {
  camera.orthographic = source.type == "orthographic";
  if (camera.orthographic) {
    camera.halfHeight = static_cast<float>(source.orthographic.ymag);
    if (!(camera.halfHeight > 0 && std::isfinite(camera.halfHeight))) throw InputError(place, "ymag must be positive");
  } else {
    camera.halfHeight = static_cast<float>(std::tan(0.5 * source.perspective.yfov));
    if (!(camera.halfHeight > 0 && source.perspective.yfov < std::numbers::pi)) {
      throw InputError(place, "yfov must lie between 0 and π");
    }
  }
}

/// Names that are taken, each with the number that is tried next for one more of its name.
using TakenNames = std::map<std::string, int>;

std::string uniqueName(const std::string& wanted, TakenNames& taken) {
  const auto [entry, isNew] = taken.try_emplace(wanted, 2);
  std::string name = wanted;
  for (bool isFree = isNew; !isFree; isFree = taken.try_emplace(name, 2).second) {
    name = wanted + '.' + std::to_string(entry->second++);
  }
  return name;
}

}  // namespace

void readCameras(const GltfDocument& document, const std::vector<GltfNode>& nodes, SceneDraft& draft) {
  TakenNames names;
  for (const GltfNode& node : nodes) {
    const tinygltf::Node& source = document.model.nodes[node.index];
    if (source.camera < 0) continue;
    const auto index = static_cast<std::size_t>(source.camera);
    const tinygltf::Camera& lens = document.model.cameras[index];
    Camera camera;
    setLens(lens, placeOf(document, "cameras", index), camera);
    if (!setAxes(node.world, camera)) {
      warnOnce(draft.scene, placeOf(document, "nodes", node.index) + ": a camera without directions is ignored");
      continue;
    }
    const std::string& ownName = source.name.empty() ? lens.name : source.name;
    camera.name = uniqueName(ownName.empty() ? "camera" : ownName, names);
    draft.scene.cameras.push_back(camera);
    draft.cameraPositions.emplace_back(node.world[3]);
  }
}

}  // namespace cellcut
