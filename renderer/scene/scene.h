/// \file scene.h
/// A scene as plain data, in world space: what a loader fills in and everything downstream reads.
///
/// Space: metres, right-handed, +Y up, the scene's centre already subtracted (Scene::origin).
/// Light: radiometric, linear Rec. 709 RGB.
#pragma once

#include "renderer/base/image_io.h"
#include "renderer/base/math.h"

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat2x2.hpp>

namespace cellcut {

enum class MeshId : std::uint32_t {};
enum class MaterialId : std::uint32_t {};
enum class TextureId : std::uint32_t {};
enum class TexelsId : std::uint32_t {};

/// Index of a typed id, for subscripting.
template <class Id>
constexpr std::size_t indexOf(Id id) {
  return static_cast<std::size_t>(id);
}

enum class Wrap : std::uint8_t { kRepeat, kClamp, kMirror };

/// A sampler over shared texels. Lookups: texture.h.
struct Texture {
  TexelsId texels{};
  Wrap wrapS = Wrap::kRepeat;
  Wrap wrapT = Wrap::kRepeat;
  bool nearest = false;  ///< magnification filter; otherwise bilinear
};

/// Where a material's parameter comes from: nothing, or a texture with its coordinates.
struct TextureSlot {
  std::optional<TextureId> texture;
  std::uint8_t texCoord = 0;  ///< 0 or 1: which set of Mesh::texCoords
  glm::mat2 uvLinear{1.0f};   ///< KHR_texture_transform: uv' = uvLinear · uv + uvOffset
  Vec2 uvOffset{0.0f};
};

/// What a material's textures say, each in the channels and the encoding that glTF gives it.
enum class TextureUse : std::uint8_t {
  kBaseColor,          ///< sRGB, alpha linear
  kMetallicRoughness,  ///< linear; G roughness, B metallic
  kSpecular,           ///< linear; A
  kSpecularColor,      ///< sRGB
  kNormal,             ///< linear, tangent space
  kEmission            ///< sRGB
};
using TextureSlots = std::array<TextureSlot, 6>;  ///< by TextureUse
inline const TextureSlot kNoTexture;

enum class AlphaMode : std::uint8_t { kOpaque, kMask, kBlend };

/// glTF 2.0 metallic-roughness with KHR_materials_specular, _ior, _emissive_strength and _unlit.
/// A slot's texel multiplies the factor of its name, channel for channel as the specification says.
struct Material {
  std::string name;
  Vec4 baseColor{1.0f};      ///< linear RGB in [0, 1], alpha = coverage
  float metallic = 1;        ///< [0, 1]
  float roughness = 1;       ///< [0, 1]; GGX alpha = roughness²
  float specular = 1;        ///< strength of the dielectric reflection, F90
  Vec3 specularColor{1.0f};  ///< tint of F0
  float ior = 1.5f;          ///< F0 = ((ior − 1) / (ior + 1))²; 0 means F0 = 1 (KHR_materials_ior)
  float normalScale = 1;
  Vec3 emission{0.0f};  ///< W/(m² sr): emissiveFactor · emissiveStrength
  AlphaMode alphaMode = AlphaMode::kOpaque;
  float alphaCutoff = 0.5f;                   ///< of kMask
  bool doubleSided = false;                   ///< also: emits from both sides
  bool unlit = false;                         ///< shows baseColor as radiance, scatters nothing, is no light
  std::shared_ptr<const TextureSlots> slots;  ///< null: none has a texture

  const TextureSlot& slot(TextureUse use) const { return slots ? (*slots)[static_cast<std::size_t>(use)] : kNoTexture; }
  /// A slot without a texture changes nothing.
  void setSlot(TextureUse use, const TextureSlot& slot);
};

/// Leaves 16 bytes after the last element, as Embree needs of a vertex buffer that it shares with us.
template <class T>
struct PaddedAllocator {
  using value_type = T;
  PaddedAllocator() = default;
  template <class U>
  PaddedAllocator(const PaddedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T) + 16)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p); }
  bool operator==(const PaddedAllocator&) const { return true; }
};

using Triangle = glm::uvec3;  ///< three indices into Mesh::positions, counter-clockwise seen from the front

/// All triangles of one material with one set of attributes, instances included, in world space.
/// An attribute that no triangle has is empty; otherwise it has one value per position.
struct Mesh {
  MaterialId material{};
  std::vector<Vec3, PaddedAllocator<Vec3>> positions;  ///< metres
  std::vector<Vec3> normals;                           ///< unit; empty: flat shading
  std::vector<Vec4> tangents;                  ///< unit, w = ±1 handedness; only where a normal texture needs it
  std::array<std::vector<Vec2>, 2> texCoords;  ///< TEXCOORD_0 and TEXCOORD_1
  std::vector<Vec4> colors;                    ///< COLOR_0, linear; multiplies baseColor
  std::vector<Triangle> triangles;             ///< none degenerate: every area > 0 and finite
};

/// Twice the area times the unit normal, of the rounded positions, in double: no product of two differences of floats
/// leaves its range, so that a triangle of any size has an area unless its corners lie on a line.
glm::dvec3 facetNormal(const Mesh& mesh, const Triangle& triangle);

/// Those that a file has switched off are left out: no light here is black.
struct PointLight {
  Vec3 position;
  Vec3 intensity;  ///< W/sr
};

/// KHR_lights_punctual: intensity · clamp((cos θ − cosOuter) / (cosInner − cosOuter), 0, 1)².
struct SpotLight {
  Vec3 position;
  Vec3 axis;       ///< unit, where it shines
  Vec3 intensity;  ///< W/sr on the axis
  float cosInner;
  float cosOuter;  ///< < cosInner
};

struct DirectionalLight {
  Vec3 axis;        ///< unit, where it shines
  Vec3 irradiance;  ///< W/m² on a plane across the axis
};

/// Lat-long radiance at infinity. See environment.h for the mapping.
struct Environment {
  ImageRgb radiance;   ///< W/(m² sr), scale applied; finite and not negative
  float rotation = 0;  ///< radians about +Y, counter-clockwise seen from above
};

/// Looks along −z of its frame, y up.
struct Camera {
  std::string name;
  bool orthographic = false;
  Vec3 position{0.0f};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  ///< unit and orthogonal
  /// Half of what is seen from top to bottom: in perspective at distance 1, the tangent of half of the vertical angle;
  /// else in metres.
  float halfHeight = 0.4f;
};

/// What the file held before it was flattened, for `info`.
struct SceneCounts {
  std::size_t meshes = 0;
  std::size_t instances = 0;            ///< nodes with a mesh
  std::size_t degenerateTriangles = 0;  ///< skipped: zero area, NaN or Inf
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<ImageRgba8> texels;
  std::vector<PointLight> pointLights;
  std::vector<SpotLight> spotLights;
  std::vector<DirectionalLight> directionalLights;
  std::optional<Environment> environment;
  std::vector<Camera> cameras;  ///< at least one after loading: a default view is added when the file has none

  Bounds bounds;           ///< of all triangles and local lights, around the origin
  glm::dvec3 origin{0.0};  ///< file coordinates of our (0, 0, 0)
  std::string generator;   ///< who wrote the file, if it says so
  SceneCounts counts;
  std::vector<std::string> warnings;  ///< each once, ready to be shown

  std::size_t triangleCount() const;
  std::size_t bytes() const;  ///< of geometry, attributes, texels and environment
};

}  // namespace cellcut
