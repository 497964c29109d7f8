#include "renderer/scene/gltf_accessor.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cellcut {
namespace {

constexpr std::size_t kElementsPerTask = 16384;

template <class T>
T loaded(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

std::size_t componentBytes(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// Columns of a matrix, 1 for everything else.
std::size_t columnsOf(int type) {
  switch (type) {
    case TINYGLTF_TYPE_MAT2:
      return 2;
    case TINYGLTF_TYPE_MAT3:
      return 3;
    case TINYGLTF_TYPE_MAT4:
      return 4;
    default:
      return 1;
  }
}

/// Bytes from the first to the last component of an element. Columns of a matrix begin at multiples of four
/// (glTF 2.0 section 3.6.2.4), and the last one need not be filled up.
std::size_t occupiedBytes(int type, std::size_t componentSize) {
  const std::size_t columns = columnsOf(type);
  const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  const std::size_t column = components / columns * componentSize;
  return (columns - 1) * ((column + 3) / 4 * 4) + column;
}

struct Refusal {
  const GltfDocument& document;
  std::size_t accessor;

  [[noreturn]] void operator()(const std::string& problem) const {
    throw InputError(placeOf(document, "accessors", accessor), problem + "; export the file again");
  }
};

/// First of `count` elements of `size` bytes, `stride` apart, `offset` bytes into a buffer view: checked without
/// overflow.
const std::byte* checkedStretch(const GltfDocument& document, const Refusal& refuse, int bufferView, std::size_t offset,
                                std::size_t count, std::size_t size, std::size_t stride) {
  if (bufferView < 0 || static_cast<std::size_t>(bufferView) >= document.model.bufferViews.size()) {
    refuse("bufferView " + std::to_string(bufferView) + " does not exist");
  }
  const std::span<const std::byte> bytes = bufferViewBytes(document.model, bufferView);
  if (count == 0) return bytes.data();
  const bool fits =
      offset <= bytes.size() && size <= bytes.size() - offset && count - 1 <= (bytes.size() - offset - size) / stride;
  if (!fits) refuse("reaches past its bufferView");
  return bytes.data() + offset;
}

template <class T>
void appendIndices(const std::byte* bytes, std::size_t count, std::vector<std::uint32_t>& indices) {
  for (std::size_t i = 0; i < count; ++i) indices.push_back(loaded<T>(bytes + i * sizeof(T)));
}

std::vector<std::uint32_t> sparseIndices(const GltfDocument& document, const Refusal& refuse, const auto& sparse,
                                         std::size_t elements) {
  const int type = sparse.indices.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    refuse("sparse indices must be unsigned integers");
  }
  const std::size_t size = componentBytes(type);
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::byte* bytes = checkedStretch(document, refuse, sparse.indices.bufferView,
                                          static_cast<std::size_t>(sparse.indices.byteOffset), count, size, size);
  std::vector<std::uint32_t> indices;
  indices.reserve(count);
  if (size == 1) appendIndices<std::uint8_t>(bytes, count, indices);
  if (size == 2) appendIndices<std::uint16_t>(bytes, count, indices);
  if (size == 4) appendIndices<std::uint32_t>(bytes, count, indices);
  if (std::adjacent_find(indices.begin(), indices.end(), std::greater_equal{}) != indices.end()) {
    refuse("sparse indices must increase");
  }
  if (!indices.empty() && indices.back() >= elements) refuse("a sparse index is past the last element");
  return indices;
}

void viewSparse(const GltfDocument& document, const Refusal& refuse, const tinygltf::Accessor& accessor,
                AccessorView& view) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > view.count) refuse("has more sparse than elements");
  if (std::cmp_less(sparse.indices.byteOffset, 0) || std::cmp_less(sparse.values.byteOffset, 0))
    refuse("a sparse byteOffset is negative");
  view.sparseIndices = sparseIndices(document, refuse, sparse, view.count);
  view.sparseValues =
      checkedStretch(document, refuse, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                     view.sparseIndices.size(), view.elementBytes, view.elementBytes);
}

/// A component as glTF 2.0 section 3.6.2.2 maps it; without `normalized` an integer is taken as it is
/// (KHR_mesh_quantization).
template <class T>
float asFloat(T value, bool normalized) {
  const auto number = static_cast<float>(value);
  if constexpr (std::is_floating_point_v<T>) {
    return number;
  } else {
    return normalized ? std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : number;
  }
}

template <int N, class T>
void readTyped(const AccessorView& view, const std::vector<std::uint32_t>& chosen,
               std::vector<glm::vec<N, float>>& values) {
  const int components = std::min(N, view.components);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, values.size(), kElementsPerTask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::byte* bytes = view.element(chosen.empty() ? i : chosen[i]);
      glm::vec<N, float> value(0);
      if constexpr (N == 4) value.w = view.components < 4 ? 1.0f : 0.0f;
      for (int c = 0; c < components && bytes; ++c) {
        value[c] = asFloat(loaded<T>(bytes + static_cast<std::size_t>(c) * sizeof(T)), view.normalized);
      }
      values[i] = value;
    }
  });
}

}  // namespace

const std::byte* AccessorView::element(std::size_t i) const {
  if (!sparseIndices.empty()) {
    const auto found = std::lower_bound(sparseIndices.begin(), sparseIndices.end(), i);
    if (found != sparseIndices.end() && *found == i) {
      return sparseValues + static_cast<std::size_t>(found - sparseIndices.begin()) * elementBytes;
    }
  }
  return data ? data + i * stride : nullptr;
}

AccessorView viewAccessor(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  const Refusal refuse{document, static_cast<std::size_t>(index)};
  AccessorView view;
  view.count = accessor.count;
  view.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  view.componentType = accessor.componentType;
  view.normalized = accessor.normalized;
  const std::size_t componentSize = componentBytes(view.componentType);
  if (componentSize == 0) refuse("componentType " + std::to_string(view.componentType) + " is none of glTF's");
  view.elementBytes = occupiedBytes(accessor.type, componentSize);
  const bool isMatrix = columnsOf(accessor.type) > 1;

  if (accessor.bufferView == -1) {
    if (view.count > kMaxZeroElements) refuse("has no data for its " + std::to_string(view.count) + " elements");
  } else {
    if (accessor.bufferView < 0 || static_cast<std::size_t>(accessor.bufferView) >= document.model.bufferViews.size()) {
      refuse("bufferView " + std::to_string(accessor.bufferView) + " does not exist");
    }
    view.stride = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    if (view.stride == 0) view.stride = isMatrix ? (view.elementBytes + 3) / 4 * 4 : view.elementBytes;
    if (view.stride < view.elementBytes) refuse("its bufferView's byteStride is smaller than an element");
    view.data = checkedStretch(document, refuse, accessor.bufferView, accessor.byteOffset, view.count,
                               view.elementBytes, view.stride);
  }
  if (accessor.sparse.isSparse) viewSparse(document, refuse, accessor, view);
  return view;
}

std::vector<std::uint32_t> readUnsigned(const AccessorView& view) {
  std::vector<std::uint32_t> values(view.count);
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::byte* bytes = view.element(i);
    if (!bytes) continue;
    if (view.elementBytes == 1) values[i] = loaded<std::uint8_t>(bytes);
    if (view.elementBytes == 2) values[i] = loaded<std::uint16_t>(bytes);
    if (view.elementBytes == 4) values[i] = loaded<std::uint32_t>(bytes);
  }
  return values;
}

template <int N>
std::vector<glm::vec<N, float>> readVectors(const AccessorView& view, const std::vector<std::uint32_t>& chosen) {
  std::vector<glm::vec<N, float>> values(chosen.empty() ? view.count : chosen.size());
  switch (view.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      readTyped<N, std::int8_t>(view, chosen, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      readTyped<N, std::uint8_t>(view, chosen, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      readTyped<N, std::int16_t>(view, chosen, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      readTyped<N, std::uint16_t>(view, chosen, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      readTyped<N, std::uint32_t>(view, chosen, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      readTyped<N, float>(view, chosen, values);
      break;
    default:
      break;  // viewAccessor refuses every other
  }
  return values;
}

template std::vector<glm::vec2> readVectors<2>(const AccessorView&, const std::vector<std::uint32_t>&);
template std::vector<glm::vec3> readVectors<3>(const AccessorView&, const std::vector<std::uint32_t>&);
template std::vector<glm::vec4> readVectors<4>(const AccessorView&, const std::vector<std::uint32_t>&);

}  // namespace cellcut
