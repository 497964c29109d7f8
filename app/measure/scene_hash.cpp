#include "app/measure/scene_hash.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <span>

namespace cellcut {
namespace {

/// For caches: nobody is kept from making two inputs collide.
/// Source: Fowler, Noll, Vo, FNV-1a, over words of eight bytes.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t start = 14695981039346656037ull) {
  constexpr std::uint64_t kPrime = 1099511628211ull;
  std::uint64_t hash = start;
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32;  // else a word's upper bits would only ever reach the hash's upper bits
  };
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), 8);
    mix(word);
  }
  for (const std::byte byte : bytes) mix(std::to_integer<std::uint64_t>(byte));
  return hash;
}

/// Numbers one after the other; of a structure only what is given, never its padding.
class Hash {
 public:
  /// \pre no value has padding
  template <class Range>
  void range(const Range& values) {
    number(static_cast<double>(values.size()));
    value_ = hashBytes(std::as_bytes(std::span(values.data(), values.size())), value_);
  }
  void number(double v) { value_ = hashBytes(std::as_bytes(std::span(&v, 1)), value_); }
  void numbers(std::initializer_list<float> values) {
    value_ = hashBytes(std::as_bytes(std::span(values.begin(), values.size())), value_);
  }
  void vector(const Vec3& v) { numbers({v.x, v.y, v.z}); }
  template <class Pixel>
  void image(const Image<Pixel>& image) {
    number(image.width());
    value_ = hashBytes(std::as_bytes(std::span(image.data(), image.size())), value_);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = hashBytes({});
};

void add(Hash& hash, const TextureSlot& slot) {
  hash.number(slot.texture ? static_cast<double>(indexOf(*slot.texture)) : -1);
  const glm::mat2& m = slot.uvLinear;
  hash.numbers({static_cast<float>(slot.texCoord), m[0].x, m[0].y, m[1].x, m[1].y, slot.uvOffset.x, slot.uvOffset.y});
}

void add(Hash& hash, const Material& m) {
  hash.numbers({m.baseColor.x, m.baseColor.y, m.baseColor.z, m.baseColor.w, m.metallic, m.roughness, m.specular, m.ior,
                m.normalScale, m.alphaCutoff, m.doubleSided ? 1.0f : 0.0f, m.unlit ? 1.0f : 0.0f,
                static_cast<float>(m.alphaMode)});
  hash.vector(m.specularColor);
  hash.vector(m.emission);
  for (const TextureSlot& slot : m.slots ? *m.slots : TextureSlots{}) add(hash, slot);
}

void add(Hash& hash, const Mesh& mesh) {
  hash.number(static_cast<double>(indexOf(mesh.material)));
  hash.range(mesh.positions);
  hash.range(mesh.normals);
  hash.range(mesh.tangents);
  for (const auto& coordinates : mesh.texCoords) hash.range(coordinates);
  hash.range(mesh.colors);
  hash.range(mesh.triangles);
}

void add(Hash& hash, const Texture& t) {
  hash.numbers({static_cast<float>(indexOf(t.texels)), static_cast<float>(t.wrapS), static_cast<float>(t.wrapT),
                t.nearest ? 1.0f : 0.0f});
}

}  // namespace

std::uint64_t hashOfScene(const Scene& scene) {
  Hash hash;
  for (const Mesh& mesh : scene.meshes) add(hash, mesh);
  for (const Material& material : scene.materials) add(hash, material);
  for (const Texture& texture : scene.textures) add(hash, texture);
  for (const ImageRgba8& texels : scene.texels) hash.image(texels);
  static_assert(sizeof(PointLight) == 6 * sizeof(float) && sizeof(SpotLight) == 11 * sizeof(float) &&
                    sizeof(DirectionalLight) == 6 * sizeof(float),
                "lights are hashed as floats alone");
  hash.range(scene.pointLights);
  hash.range(scene.spotLights);
  hash.range(scene.directionalLights);
  if (scene.environment) {
    hash.image(scene.environment->radiance);
    hash.number(scene.environment->rotation);
  }
  return hash.value();
}

std::uint64_t hashOfCamera(const Camera& camera) {
  Hash hash;
  for (const Vec3& v : {camera.position, camera.right, camera.up, camera.back}) hash.vector(v);
  hash.numbers({camera.halfHeight, camera.orthographic ? 1.0f : 0.0f});
  return hash.value();
}

std::string hexOf(std::uint64_t hash) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace cellcut
