/// \file gltf_builder.h
/// Writes small glTF files from a few lines of a test.
///
///     GltfBuilder file;
///     file.addRoot({{"mesh", file.addTriangle()}});
///     const Scene scene = loadScene(file.writeGlb(folder / "a.glb"));
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace cellcut::test {

class GltfBuilder {
 public:
  using Json = nlohmann::json;

  GltfBuilder();

  /// The document, to be changed at will; everything below appends to it. Buffer 0 holds all data.
  Json json;

  /// All of these return the index of what they append.
  std::size_t add(const char* array, Json element);
  std::size_t addBufferView(std::span<const std::byte> bytes, Json more = Json::object());
  /// \param type           "SCALAR", "VEC2" …
  /// \param componentType  GL's number, of T
  template <class T>
  std::size_t addAccessor(const std::vector<T>& values, const char* type, int componentType,
                          Json more = Json::object()) {
    more.update({{"bufferView", addBufferView(std::as_bytes(std::span(values)))},
                 {"componentType", componentType},
                 {"type", type}});
    if (!more.contains("count")) more["count"] = values.size();
    return add("accessors", std::move(more));
  }
  std::size_t addAccessor(const std::vector<glm::vec2>& values) { return addAccessor(values, "VEC2", 5126); }
  std::size_t addAccessor(const std::vector<glm::vec3>& values) { return addAccessor(values, "VEC3", 5126); }
  std::size_t addAccessor(const std::vector<glm::vec4>& values) { return addAccessor(values, "VEC4", 5126); }
  std::size_t addAccessor(const std::vector<std::uint32_t>& values) { return addAccessor(values, "SCALAR", 5125); }

  /// A primitive with these positions, three per triangle.
  Json primitive(const std::vector<glm::vec3>& positions);
  /// A mesh of one primitive.
  std::size_t addMesh(Json primitive);
  /// A mesh of one triangle: (0,0,0), (1,0,0), (0,1,0). It faces +z.
  std::size_t addTriangle();
  /// Appends to the scene's roots, too.
  std::size_t addRoot(Json node);
  /// A KHR_lights_punctual light; returns the node's "extensions" that refer to it.
  Json addLight(Json light);

  std::vector<std::byte> glb() const;
  std::filesystem::path writeGlb(const std::filesystem::path& file) const;
  /// JSON text with the buffer in a data URI.
  std::string gltf() const;
  std::filesystem::path writeGltf(const std::filesystem::path& file) const;

 private:
  Json finished() const;
  std::vector<std::byte> buffer_;
};

/// A .glb of a document and its buffer 0.
std::vector<std::byte> glbBytes(const nlohmann::json& json, std::vector<std::byte> data);

/// Writes text or bytes and returns the file.
std::filesystem::path writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
std::filesystem::path writeFile(const std::filesystem::path& file, const std::string& text);
std::string contentOf(const std::filesystem::path& file);

}  // namespace cellcut::test
