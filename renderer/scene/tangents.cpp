#include "renderer/scene/tangents.h"

#include "renderer/scene/texture.h"

#include <cassert>

namespace cellcut {
namespace {

template <class Values>
void appendCopies(const std::vector<std::uint32_t>& vertices, Values& values) {
  if (values.empty()) return;
  values.reserve(values.size() + vertices.size());
  for (const std::uint32_t vertex : vertices) values.push_back(values[vertex]);
}

/// > 0 where v runs up in the picture and the triangle is counter-clockwise in it.
double uvDeterminant(const Mesh& mesh, const TextureSlot& slot, const Triangle& triangle) {
  const std::vector<Vec2>& uvs = mesh.texCoords[slot.texCoord];
  const auto uv = [&](int i) { return glm::dvec2(slotUv(slot, uvs[triangle[i]])); };
  const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  return d1.x * d2.y - d1.y * d2.x;
}

/// Gives every triangle of a mesh without normals its own vertices, for its normal is its own. In others a vertex
/// between triangles that have the picture upright and mirrored becomes two. Source: Mikkelsen 2008, "Simulation of
/// Wrinkled Surfaces Revisited", section 3.2: tangent spaces of both orientations are never averaged.
void splitVertices(const TextureSlot& slot, Mesh& mesh) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Vertex {
    bool isUsed = false, isMirrored = false;
    std::uint32_t twin = kNone;
  };
  std::vector<Vertex> vertices(mesh.positions.size());
  std::vector<std::uint32_t> copies;
  const auto copyOf = [&](std::uint32_t vertex) {
    copies.push_back(vertex);
    return static_cast<std::uint32_t>(vertices.size() + copies.size() - 1);
  };
  for (Triangle& triangle : mesh.triangles) {
    const double determinant = uvDeterminant(mesh, slot, triangle);
    const bool isMirrored = determinant > 0;
    if (!mesh.normals.empty() && determinant == 0) continue;  // it has no tangent of its own
    for (int i = 0; i < 3; ++i) {
      Vertex& vertex = vertices[triangle[i]];
      if (!vertex.isUsed) {
        vertex = {true, isMirrored};
      } else if (mesh.normals.empty()) {
        triangle[i] = copyOf(triangle[i]);
      } else if (vertex.isMirrored != isMirrored) {
        if (vertex.twin == kNone) vertex.twin = copyOf(triangle[i]);
        triangle[i] = vertex.twin;
      }
    }
  }
  appendCopies(copies, mesh.positions);
  appendCopies(copies, mesh.normals);
  for (std::vector<Vec2>& texCoords : mesh.texCoords) appendCopies(copies, texCoords);
  appendCopies(copies, mesh.colors);
}

/// Sums over a vertex's triangles, each weighted by its area.
struct TangentSum {
  glm::dvec3 tangent{0.0};
  glm::dvec3 normal{0.0};
  double orientation = 0;  ///< > 0: most of the area has its picture upright
};

void addTriangle(const Mesh& mesh, const TextureSlot& slot, const Triangle& triangle, std::vector<TangentSum>& sums) {
  const std::vector<Vec2>& uvs = mesh.texCoords[slot.texCoord];
  const auto position = [&](int i) { return glm::dvec3(mesh.positions[triangle[i]]); };
  const auto uv = [&](int i) { return glm::dvec2(slotUv(slot, uvs[triangle[i]])); };
  const glm::dvec3 e1 = position(1) - position(0), e2 = position(2) - position(0);
  const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const glm::dvec3 normal = glm::cross(e1, e2);
  const double determinant = uvDeterminant(mesh, slot, triangle);
  const double sign = determinant < 0 ? -1 : 1;
  const glm::dvec3 alongU = sign * (d2.y * e1 - d1.y * e2);  // ∂p/∂u · |determinant|
  const double length = glm::length(alongU);
  const bool mapped = determinant != 0 && std::isfinite(determinant) && std::isfinite(length) && length > 0;
  const double area = glm::length(normal);
  for (int i = 0; i < 3; ++i) {
    TangentSum& sum = sums[triangle[i]];
    sum.normal += normal;
    if (!mapped) continue;
    sum.tangent += area / length * alongU;
    sum.orientation -= sign * area;  // v runs down: an upright picture has a negative determinant
  }
}

Vec4 tangentOf(const TangentSum& sum, const Vec3* normal) {
  glm::dvec3 n = normal ? glm::dvec3(*normal) : sum.normal;
  const double normalLength = glm::length(n);
  n = normalLength > 0 ? n / normalLength : glm::dvec3(0, 0, 1);
  const glm::dvec3 t = sum.tangent - glm::dot(sum.tangent, n) * n;
  const double length = glm::length(t);
  const float w = sum.orientation < 0 ? -1.0f : 1.0f;
  // Opposite tangents cancel to rounding noise, whose direction means nothing: 1e-6 of the sum is well above double's.
  if (!(length > 1e-6 * glm::length(sum.tangent))) return {Frame(glm::normalize(Vec3(n))).x, w};
  return {Vec3(t / length), w};
}

}  // namespace

void computeTangents(Mesh& mesh, const TextureSlot& slot) {
  assert(mesh.texCoords[slot.texCoord].size() == mesh.positions.size());
  splitVertices(slot, mesh);
  std::vector<TangentSum> sums(mesh.positions.size());
  for (const Triangle& triangle : mesh.triangles) addTriangle(mesh, slot, triangle, sums);
  mesh.tangents.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    mesh.tangents[i] = tangentOf(sums[i], mesh.normals.empty() ? nullptr : &mesh.normals[i]);
  }
}

}  // namespace cellcut
