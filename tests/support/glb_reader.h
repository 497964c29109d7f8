/// \file glb_reader.h
/// A .glb read back by the letter of the specification, and by nothing that the loader shares: for tests of what writes
/// them. Knows what the recipes use: triangles with indices, untransformed nodes, embedded buffers.
#pragma once

#include "renderer/base/math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cellcut::test {

struct GlbTriangle {
  std::array<Vec3, 3> corners;
  std::size_t material;
  Vec3 centroid() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
  /// Twice the area long, to the side that it is counter-clockwise from.
  Vec3 normal() const { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }
};

struct Glb {  // NOLINT(bugprone-exception-escape): the JSON library checks itself in its move constructor
  nlohmann::json json;
  std::vector<std::byte> binary;

  std::vector<GlbTriangle> triangles() const;
  bool isEmissive(std::size_t material) const;
  bool isDoubleSided(std::size_t material) const;
  std::string materialName(std::size_t material) const { return json["materials"][material]["name"]; }
  /// Nodes with a light of that type.
  std::size_t punctualCount(const std::string& type) const;
  /// Emissive triangles and nodes with lights.
  std::size_t lightCount() const;
};

/// \throws std::runtime_error if the container is not as section 4.4 of glTF 2.0 wants it
Glb readGlb(std::span<const std::byte> bytes);

}  // namespace cellcut::test
