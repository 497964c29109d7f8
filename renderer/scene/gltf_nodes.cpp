#include "renderer/scene/gltf_nodes.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_values.h"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>

namespace cellcut {
namespace {

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

glm::dmat4 matrixOf(const std::vector<double>& numbers, const std::string& place) {
  if (numbers.size() != 16) throw InputError(place, "matrix must be 16 numbers; export the file again");
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
  // Exporters multiply in float: the last row may be off by its rounding.
  constexpr double kRounding = 0x1p-20;
  if (std::max({std::abs(m[0].w), std::abs(m[1].w), std::abs(m[2].w), std::abs(m[3].w - 1)}) > kRounding) {
    throw InputError(place, "matrix is not affine; its last row must be 0 0 0 1");
  }
  m[0].w = m[1].w = m[2].w = 0;
  m[3].w = 1;
  return m;
}

glm::dmat4 localTransform(const GltfDocument& document, std::size_t index) {
  const tinygltf::Node& node = document.model.nodes[index];
  const bool hasTransform =
      !(node.matrix.empty() && node.translation.empty() && node.rotation.empty() && node.scale.empty());
  if (!hasTransform) return glm::dmat4(1);
  const std::string place = placeOf(document, "nodes", index);
  if (!node.matrix.empty()) return matrixOf(node.matrix, place);
  const glm::dvec3 translation = vectorOr<3>(node.translation, glm::dvec3(0), place + ": translation");
  const glm::dvec4 rotation = vectorOr<4>(node.rotation, glm::dvec4(0, 0, 0, 1), place + ": rotation");
  const glm::dvec3 scale = vectorOr<3>(node.scale, glm::dvec3(1), place + ": scale");
  const double length = glm::length(rotation);
  if (!(length > 0 && std::isfinite(length)))
    throw InputError(place, "rotation is no quaternion; export the file again");
  const glm::dvec4 q = rotation / length;
  glm::dmat4 m = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(translation, 1);
  return m;
}

/// Nodes at the top of the scene that is shown: the default one, else the first, else (a file without scenes) of all.
std::vector<int> roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  std::vector<bool> isChild(model.nodes.size());
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < isChild.size(); ++i) {
    if (!isChild[i]) result.push_back(static_cast<int>(i));
  }
  return result;
}

}  // namespace

std::vector<GltfNode> activeNodes(const GltfDocument& document) {
  const tinygltf::Model& model = document.model;
  std::vector<GltfNode> nodes;
  const auto add = [&](int index, const glm::dmat4& parent) {
    const auto node = static_cast<std::size_t>(index);
    const glm::dmat4 world = parent * localTransform(document, node);
    if (!isFinite(world))
      throw InputError(placeOf(document, "nodes", node), "its transform is not finite; choose smaller scales");
    nodes.push_back({node, world});
  };
  // Breadth first, with the result itself as the queue. checkDocument made sure that these are trees.
  for (const int root : roots(model)) add(root, glm::dmat4(1));
  for (std::size_t next = 0; next < nodes.size(); ++next) {
    const glm::dmat4 world = nodes[next].world;
    for (const int child : model.nodes[nodes[next].index].children) add(child, world);
  }
  return nodes;
}

}  // namespace cellcut
