#include "renderer/scene/gltf_geometry.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_accessor.h"

#include <algorithm>
#include <numeric>

namespace cellcut {
namespace {

constexpr std::uint32_t kUnused = 0xFFFFFFFF;

/// A primitive with its place in the file.
struct Source {
  const GltfDocument& document;
  std::size_t mesh;
  const tinygltf::Primitive& primitive;

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(placeOf(document, "meshes", mesh), problem + "; export the file again");
  }
  /// The accessor of an attribute, if the primitive has it.
  /// \param types tinygltf's numbers of the types that it may have
  std::optional<AccessorView> attribute(const char* name, std::initializer_list<int> types) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    const int type = document.model.accessors[static_cast<std::size_t>(found->second)].type;
    if (std::find(types.begin(), types.end(), type) == types.end()) refuse(std::string(name) + " has a wrong type");
    return viewAccessor(document, found->second);
  }
};

std::size_t trianglesOf(int mode, std::size_t corners) {
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
      return corners / 3;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return corners < 3 ? 0 : corners - 2;
    default:
      return 0;
  }
}

/// Positions in the list of corners of triangle i, in its winding. Source: glTF 2.0 section 3.7.2.1.
glm::vec<3, std::size_t> cornersOf(int mode, std::size_t i) {
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return {i + 1, i + 2, 0};
    default:
      return {3 * i, 3 * i + 1, 3 * i + 2};
  }
}

std::vector<std::uint32_t> readCorners(const Source& source, std::size_t vertexCount) {
  std::vector<std::uint32_t> corners;
  if (source.primitive.indices < 0) {
    corners.resize(vertexCount);
    std::iota(corners.begin(), corners.end(), 0u);
    return corners;
  }
  const AccessorView view = viewAccessor(source.document, source.primitive.indices);
  if (view.components != 1 || view.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
      view.componentType == TINYGLTF_COMPONENT_TYPE_BYTE || view.componentType == TINYGLTF_COMPONENT_TYPE_SHORT) {
    source.refuse("indices must be unsigned integers");
  }
  corners = readUnsigned(view);
  for (const std::uint32_t corner : corners) {
    if (corner >= vertexCount) {
      source.refuse("index " + std::to_string(corner) + " is past its " + std::to_string(vertexCount) + " vertices");
    }
  }
  return corners;
}

/// Renumbers the corners 0, 1, 2 … in the order of their vertices and returns the vertices that they use; empty means
/// all. Several primitives often share one long accessor: reading it whole for each could take the square of the file's
/// size.
std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& corners, std::size_t vertexCount) {
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  const std::uint32_t first = *low;
  const std::size_t range = static_cast<std::size_t>(*high - first) + 1;
  std::vector<std::uint32_t> used;
  if (range / 8 > corners.size()) {  // few corners far apart: sorting them is cheaper than a table of the range
    used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& corner : corners) {
      corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    }
    return used;
  }
  std::vector<std::uint32_t> renumbered(range, kUnused);
  for (const std::uint32_t corner : corners) renumbered[corner - first] = 0;
  for (std::size_t i = 0; i < range; ++i) {
    if (renumbered[i] == kUnused) continue;
    renumbered[i] = static_cast<std::uint32_t>(used.size());
    used.push_back(first + static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t& corner : corners) corner = renumbered[corner - first];
  if (used.size() == vertexCount) used.clear();
  return used;
}

template <int N>
std::vector<glm::vec<N, float>> readAttribute(const Source& source, const std::optional<AccessorView>& view,
                                              std::size_t vertexCount, const std::vector<std::uint32_t>& used) {
  if (!view) return {};
  if (view->count != vertexCount) source.refuse("its attributes have different numbers of elements");
  return readVectors<N>(*view, used);
}

/// COLOR_0 holds reflectances; anything else would make a surface give back more light than it gets.
void clampColors(std::vector<Vec4>& colors) {
  for (Vec4& color : colors) {
    for (int c = 0; c < 4; ++c) color[c] = color[c] > 0 ? std::min(color[c], 1.0f) : 0.0f;  // NaN becomes 0
  }
}

void readAttributes(const Source& source, const Material& material, std::size_t vertexCount,
                    const std::vector<std::uint32_t>& used, Part& part) {
  part.normals = readAttribute<3>(source, source.attribute("NORMAL", {TINYGLTF_TYPE_VEC3}), vertexCount, used);
  if (!part.normals.empty() && material.slot(TextureUse::kNormal).texture) {
    part.tangents = readAttribute<4>(source, source.attribute("TANGENT", {TINYGLTF_TYPE_VEC4}), vertexCount, used);
  }
  const char* const texCoordNames[] = {"TEXCOORD_0", "TEXCOORD_1"};
  for (std::uint8_t set = 0; set < 2; ++set) {
    if (!usesTexCoords(material, set)) continue;
    part.texCoords[set] =
        readAttribute<2>(source, source.attribute(texCoordNames[set], {TINYGLTF_TYPE_VEC2}), vertexCount, used);
  }
  part.colors = readAttribute<4>(source, source.attribute("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}),
                                 vertexCount, used);
  clampColors(part.colors);
}

}  // namespace

std::size_t triangleCount(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return 0;
  const int corners = primitive.indices >= 0 ? primitive.indices : position->second;
  return trianglesOf(primitive.mode, document.model.accessors[static_cast<std::size_t>(corners)].count);
}

Part readPrimitive(const GltfDocument& document, std::size_t mesh, const tinygltf::Primitive& primitive, MaterialId id,
                   const Material& material) {
  const Source source{document, mesh, primitive};
  Part part;
  part.material = id;
  part.triangles.resize(triangleCount(document, primitive));
  if (part.triangles.empty()) return part;  // its corners, however many, are not looked at
  const std::optional<AccessorView> positions = source.attribute("POSITION", {TINYGLTF_TYPE_VEC3});
  std::vector<std::uint32_t> corners = readCorners(source, positions->count);
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) corners.resize(3 * part.triangles.size());  // one or two may be over

  std::vector<std::uint32_t> used;
  if (primitive.indices >= 0 || corners.size() < positions->count) used = compact(corners, positions->count);
  part.positions = readVectors<3>(*positions, used);
  readAttributes(source, material, positions->count, used, part);
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    const glm::vec<3, std::size_t> at = cornersOf(primitive.mode, i);
    part.triangles[i] = {corners[at.x], corners[at.y], corners[at.z]};
  }
  return part;
}

}  // namespace cellcut
