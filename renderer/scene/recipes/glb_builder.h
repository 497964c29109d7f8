/// \file glb_builder.h
/// Triangles, materials, lights and cameras → the bytes of a .glb (glTF 2.0, section 4.4; KHR_lights_punctual,
/// KHR_materials_emissive_strength, KHR_materials_specular).
///
/// Geometry is merged: all triangles of a material are one primitive (two if some are smooth), so that a file with a
/// million lamps has a few hundred primitives. Point and spot lights cost a node each; lights of equal strength share a
/// definition.
#pragma once

#include "renderer/scene/recipes/shapes.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cellcut {

enum class GlbMaterialId : std::uint32_t {};
enum class GlbTextureId : std::uint32_t {};

/// A material of the file. The defaults are exactly Lambertian.
struct GlbMaterial {
  std::string name;
  Vec3 baseColor{0.5f};                              ///< linear RGB in [0, 1]
  float metallic = 0;                                ///< [0, 1]
  float roughness = 1;                               ///< [0, 1]
  float specular = 0;                                ///< [0, 1]; strength of the dielectric reflection
  Vec3 emission{0.0f};                               ///< W/(m² sr); a triangle of such a material is one light
  std::optional<GlbTextureId> emissionTexture = {};  ///< needs texture coordinates on all of the material's triangles
  bool doubleSided = false;
};

class GlbBuilder {
 public:
  /// \param recipe, lights, seed  what made the file; goes into `asset.extras`
  GlbBuilder(std::string recipe, std::size_t lights, std::uint64_t seed);

  GlbMaterialId addMaterial(const GlbMaterial& material);
  GlbTextureId addPng(std::vector<std::byte> png);
  /// A lat-long OpenEXR around the scene (root extension CELLCUT_environment).
  void setEnvironment(std::vector<std::byte> exr) { environment_ = std::move(exr); }

  /// Where the flat-shaded triangles of a material go. The reference stays valid.
  Surface& flat(GlbMaterialId material) { return surfaces_[static_cast<std::size_t>(material)].flat; }
  /// Where those with normals go.
  Surface& smooth(GlbMaterialId material) { return surfaces_[static_cast<std::size_t>(material)].smooth; }

  /// \param intensity W/sr, not black
  void addPoint(const Vec3& position, const Vec3& intensity);
  /// \param axis where it shines, any length > 0
  /// \param intensity on the axis, W/sr
  /// \param inner, outer radians from the axis, 0 ≤ inner < outer ≤ π/2
  void addSpot(const Vec3& position, const Vec3& axis, const Vec3& intensity, float inner, float outer);
  /// \param irradiance W/m² across the axis
  void addDirectional(const Vec3& axis, const Vec3& irradiance);
  /// The first camera that is added is the file's first.
  /// \param verticalFov radians
  void addCamera(const std::string& name, const Vec3& from, const Vec3& to, float verticalFov);

  /// Lights so far: emissive triangles and punctual lights.
  std::size_t lightCount() const;

  /// The file. \pre it stays below 4 GiB, which is as long as a .glb can be
  std::vector<std::byte> finish() const;

 private:
  friend class GlbWriter;
  struct MaterialSurfaces {
    Surface flat, smooth;
  };
  /// A definition of KHR_lights_punctual; equal ones are written once.
  struct LightDefinition {
    enum class Kind : std::uint8_t { kPoint, kSpot, kDirectional } kind;
    float r, g, b;
    float inner, outer;
    // clang-tidy 14 takes the 0 that comparisons are written with for a pointer.
    auto operator<=>(const LightDefinition&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  struct LightNode {
    Vec3 position;
    Vec3 axis;
    std::size_t definition;
  };
  struct CameraNode {
    std::string name;
    Vec3 from, to;
    float verticalFov;
  };
  void addLight(const LightDefinition& definition, const Vec3& position, const Vec3& axis);

  std::string recipe_;
  std::size_t lights_;
  std::uint64_t seed_;
  std::vector<GlbMaterial> materials_;
  std::deque<MaterialSurfaces> surfaces_;  ///< of materials_, in their order
  std::vector<std::vector<std::byte>> pngs_;
  std::vector<std::byte> environment_;
  std::map<LightDefinition, std::size_t> definitionIndex_;
  std::vector<LightDefinition> definitions_;
  std::vector<LightNode> lightNodes_;
  std::vector<CameraNode> cameras_;
};

}  // namespace cellcut
