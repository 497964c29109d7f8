#include "tests/support/glb_reader.h"

#include <cstring>
#include <stdexcept>

namespace cellcut::test {

namespace {

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t offset) {
  if (offset + 4 > bytes.size()) throw std::runtime_error("glb: cut short");
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, 4);
  return word;
}

std::span<const std::byte> chunk(std::span<const std::byte> bytes, std::size_t offset, std::uint32_t type) {
  const std::uint32_t length = wordAt(bytes, offset);
  if (wordAt(bytes, offset + 4) != type) throw std::runtime_error("glb: unexpected chunk");
  if (length % 4 != 0 || offset + 8 + length > bytes.size()) throw std::runtime_error("glb: bad chunk length");
  return bytes.subspan(offset + 8, length);
}

/// Bytes of an accessor, checked against its view.
std::span<const std::byte> accessorBytes(const Glb& glb, std::size_t index, std::size_t elementSize) {
  const auto& accessor = glb.json["accessors"].at(index);
  const auto& view = glb.json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
  const auto offset = view["byteOffset"].get<std::size_t>(), length = view["byteLength"].get<std::size_t>();
  const std::size_t size = accessor["count"].get<std::size_t>() * elementSize;
  if (offset % 4 != 0 || size > length || offset + length > glb.binary.size()) {
    throw std::runtime_error("glb: bad accessor");
  }
  return std::span(glb.binary).subspan(offset, size);
}

template <class T>
std::vector<T> elements(std::span<const std::byte> bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

std::vector<std::uint32_t> indices(const Glb& glb, std::size_t accessor) {
  if (glb.json["accessors"].at(accessor)["componentType"] == 5125) {
    return elements<std::uint32_t>(accessorBytes(glb, accessor, 4));
  }
  const auto narrow = elements<std::uint16_t>(accessorBytes(glb, accessor, 2));
  return {narrow.begin(), narrow.end()};
}

}  // namespace

std::vector<GlbTriangle> Glb::triangles() const {
  std::vector<GlbTriangle> all;
  if (!json.contains("meshes")) return all;
  for (const auto& mesh : json["meshes"]) {
    for (const auto& primitive : mesh["primitives"]) {
      const auto positions = elements<Vec3>(accessorBytes(*this, primitive["attributes"]["POSITION"], sizeof(Vec3)));
      const auto index = indices(*this, primitive["indices"]);
      for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
        all.push_back({{positions.at(index[i]), positions.at(index[i + 1]), positions.at(index[i + 2])},
                       primitive["material"].get<std::size_t>()});
      }
    }
  }
  return all;
}

bool Glb::isEmissive(std::size_t material) const {
  return json["materials"].at(material).contains("emissiveFactor");
}

bool Glb::isDoubleSided(std::size_t material) const {
  return json["materials"].at(material).contains("doubleSided");
}

std::size_t Glb::punctualCount(const std::string& type) const {
  std::size_t count = 0;
  for (const auto& node : json["nodes"]) {
    if (!node.contains("extensions")) continue;
    const std::size_t light = node["extensions"]["KHR_lights_punctual"]["light"];
    count += json["extensions"]["KHR_lights_punctual"]["lights"].at(light)["type"] == type;
  }
  return count;
}

std::size_t Glb::lightCount() const {
  std::size_t count = punctualCount("point") + punctualCount("spot") + punctualCount("directional");
  if (!json.contains("meshes")) return count;
  for (const auto& mesh : json["meshes"]) {
    for (const auto& primitive : mesh["primitives"]) {
      if (!isEmissive(primitive["material"])) continue;
      count += json["accessors"].at(primitive["indices"].get<std::size_t>())["count"].get<std::size_t>() / 3;
    }
  }
  return count;
}

Glb readGlb(std::span<const std::byte> bytes) {
  if (wordAt(bytes, 0) != 0x46546c67 || wordAt(bytes, 4) != 2) throw std::runtime_error("glb: bad header");
  if (wordAt(bytes, 8) != bytes.size()) throw std::runtime_error("glb: bad length");
  const auto text = chunk(bytes, 12, 0x4e4f534a);
  Glb glb;
  glb.json = nlohmann::json::parse(reinterpret_cast<const char*>(text.data()),
                                   reinterpret_cast<const char*>(text.data()) + text.size());
  const std::size_t next = 12 + 8 + text.size();
  if (next < bytes.size()) {
    const auto binary = chunk(bytes, next, 0x004e4942);
    glb.binary.assign(binary.begin(), binary.end());
  }
  return glb;
}

}  // namespace cellcut::test
