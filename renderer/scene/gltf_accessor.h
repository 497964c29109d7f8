/// \file gltf_accessor.h
/// Typed reading of a glTF accessor whose every element is known to lie inside the file's data.
#pragma once

#include "renderer/scene/gltf_document.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cellcut {

/// Where an accessor's elements lie. Source: glTF 2.0 section 3.6.2.
struct AccessorView {
  const std::byte* data = nullptr;  ///< first element; null: all elements are zero
  std::size_t count = 0;
  std::size_t stride = 0;
  int components = 0;     ///< 1 … 4; matrices 4, 9, 16
  int componentType = 0;  ///< GL's number: 5120 … 5126
  bool normalized = false;
  std::vector<std::uint32_t> sparseIndices;  ///< strictly increasing; these elements are replaced
  const std::byte* sparseValues = nullptr;   ///< tightly packed
  std::size_t elementBytes = 0;

  /// First byte of element i, null if it is zero. \pre i < count
  const std::byte* element(std::size_t i) const;
};

/// Accessors without data hold zeros; so many, a small file may ask for.
inline constexpr std::size_t kMaxZeroElements = std::size_t{1} << 22;

/// \throws InputError if the accessor, its sparse part or their buffer views do not lie inside the data.
/// \pre `index` names an accessor; every buffer view lies in its buffer
AccessorView viewAccessor(const GltfDocument& document, int index);

/// Elements of a scalar accessor of unsigned integers. \pre its type is that
std::vector<std::uint32_t> readUnsigned(const AccessorView& view);

/// Chosen elements as floats, normalized integers mapped to [0, 1] or [−1, 1]; missing components are 0, the fourth 1.
/// \param chosen indices < view.count; empty: all of them
template <int N>
std::vector<glm::vec<N, float>> readVectors(const AccessorView& view, const std::vector<std::uint32_t>& chosen);

}  // namespace cellcut
