#include "tests/support/gltf_builder.h"

#include <fstream>
#include <iterator>

namespace cellcut::test {
namespace {

void append(std::vector<std::byte>& bytes, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(word >> (8 * i)));
}

void append(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace

GltfBuilder::GltfBuilder()
    : json{{"asset", {{"version", "2.0"}, {"generator", "test"}}},
           {"scene", 0},
           {"scenes", Json::array({{{"nodes", Json::array()}}})}} {}

std::size_t GltfBuilder::add(const char* array, Json element) {
  json[array].push_back(std::move(element));
  return json[array].size() - 1;
}

std::size_t GltfBuilder::addBufferView(std::span<const std::byte> bytes, Json more) {
  buffer_.resize((buffer_.size() + 3) / 4 * 4);
  more.update({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
  append(buffer_, bytes);
  return add("bufferViews", std::move(more));
}

GltfBuilder::Json GltfBuilder::primitive(const std::vector<glm::vec3>& positions) {
  return {{"attributes", {{"POSITION", addAccessor(positions)}}}};
}

std::size_t GltfBuilder::addMesh(Json primitive) {
  return add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
}

std::size_t GltfBuilder::addTriangle() {
  return addMesh(primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

std::size_t GltfBuilder::addRoot(Json node) {
  const std::size_t index = add("nodes", std::move(node));
  json["scenes"][0]["nodes"].push_back(index);
  return index;
}

GltfBuilder::Json GltfBuilder::addLight(Json light) {
  Json& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back(std::move(light));
  return {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}};
}

GltfBuilder::Json GltfBuilder::finished() const {
  Json copy = json;
  if (!buffer_.empty() && !copy.contains("buffers")) copy["buffers"] = {{{"byteLength", buffer_.size()}}};
  return copy;
}

std::vector<std::byte> glbBytes(const nlohmann::json& json, std::vector<std::byte> data) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4);
  const std::size_t size = 20 + text.size() + (data.empty() ? 0 : 8 + data.size());
  std::vector<std::byte> bytes;
  append(bytes, 0x46546C67);
  append(bytes, 2);
  append(bytes, static_cast<std::uint32_t>(size));
  append(bytes, static_cast<std::uint32_t>(text.size()));
  append(bytes, 0x4E4F534A);
  append(bytes, std::as_bytes(std::span(text)));
  if (!data.empty()) {
    append(bytes, static_cast<std::uint32_t>(data.size()));
    append(bytes, 0x004E4942);
    append(bytes, data);
  }
  return bytes;
}

std::vector<std::byte> GltfBuilder::glb() const {
  return glbBytes(finished(), buffer_);
}

std::string GltfBuilder::gltf() const {
  Json copy = finished();
  if (!buffer_.empty() && !copy["buffers"][0].contains("uri")) {
    copy["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer_);
  }
  return copy.dump();
}

std::filesystem::path GltfBuilder::writeGlb(const std::filesystem::path& file) const {
  return writeFile(file, glb());
}

std::filesystem::path GltfBuilder::writeGltf(const std::filesystem::path& file) const {
  return writeFile(file, gltf());
}

std::filesystem::path writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::filesystem::path writeFile(const std::filesystem::path& file, const std::string& text) {
  return writeFile(file, std::as_bytes(std::span(text)));
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace cellcut::test
