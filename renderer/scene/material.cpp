#include "renderer/scene/material.h"

#include "renderer/base/capabilities.h"
#include "renderer/scene/texture.h"

namespace cellcut {
namespace {

const Material& materialOf(const Scene& scene, const SurfaceCoordinates& at) {
  return scene.materials[indexOf(at.mesh->material)];
}

/// Value of a vertex attribute at a point. By differences, so that what is the same at all vertices is exactly that in
/// between: an alpha of the cutoff has no holes.
template <class Attribute>
auto interpolate(const Attribute& values, const SurfaceCoordinates& at) {
  const Triangle& t = at.mesh->triangles[at.triangle];
  const auto& first = values[t.x];
  return first + at.barycentric.x * (values[t.y] - first) + at.barycentric.y * (values[t.z] - first);
}

bool hasTextures(const Material& material) {
  return kCanHaveTextures && material.slots;
}

TexelEncoding encodingOf(TextureUse use) {
  switch (use) {
    case TextureUse::kBaseColor:
    case TextureUse::kSpecularColor:
    case TextureUse::kEmission:
      return TexelEncoding::kSrgb;
    case TextureUse::kMetallicRoughness:
    case TextureUse::kSpecular:
    case TextureUse::kNormal:
      break;
  }
  return TexelEncoding::kLinear;
}

/// A slot's texel, or nothing to multiply by when the slot or its coordinates are absent. Most materials have no
/// texture: ask hasTextures() first.
Vec4 slotValue(const Scene& scene, TextureUse use, const SurfaceCoordinates& at) {
  const TextureSlot& slot = materialOf(scene, at).slot(use);
  if (!slot.texture) return Vec4(1.0f);
  const std::vector<Vec2>& texCoords = at.mesh->texCoords[slot.texCoord];
  const Vec2 uv = texCoords.empty() ? Vec2(0.0f) : interpolate(texCoords, at);
  return lookup(scene, scene.textures[indexOf(*slot.texture)], encodingOf(use), slotUv(slot, uv));
}

/// The normal that the normal map gives in place of `normal`. \pre the mesh has tangents
Vec3 mappedNormal(const Scene& scene, const SurfaceCoordinates& at, const Vec3& normal) {
  const Vec4 tangent4 = interpolate(at.mesh->tangents, at);
  const Vec3 inPlane = Vec3(tangent4) - glm::dot(Vec3(tangent4), normal) * normal;
  const float tangentLength = glm::length(inPlane);
  if (!(tangentLength > 0)) return normal;
  const Vec3 tangent = inPlane / tangentLength;
  const Vec3 bitangent = (tangent4.w < 0 ? -1.0f : 1.0f) * glm::cross(normal, tangent);
  const Vec3 texel = Vec3(slotValue(scene, TextureUse::kNormal, at)) * 2.0f - Vec3(1);
  const float scale = materialOf(scene, at).normalScale;
  const Vec3 bent = texel.x * scale * tangent + texel.y * scale * bitangent + texel.z * normal;
  const float bentLength = glm::length(bent);
  return bentLength > 0 ? bent / bentLength : normal;
}

Vec4 baseColorAlpha(const Scene& scene, const SurfaceCoordinates& at) {
  const Material& material = materialOf(scene, at);
  Vec4 color = material.baseColor;
  if (hasTextures(material)) color *= slotValue(scene, TextureUse::kBaseColor, at);
  if (!at.mesh->colors.empty()) color *= interpolate(at.mesh->colors, at);
  return color;
}

/// Corners of the triangle in a slot's texel coordinates; nothing without a texture.
struct TexelFootprint {
  std::array<Vec2, 3> corners;
  TexelsId texels;
};
std::optional<TexelFootprint> footprint(const Scene& scene, const TextureSlot& slot, const Mesh& mesh,
                                        std::uint32_t triangle) {
  if (!slot.texture || mesh.texCoords[slot.texCoord].empty()) return std::nullopt;
  const Texture& texture = scene.textures[indexOf(*slot.texture)];
  const ImageRgba8& texels = scene.texels[indexOf(texture.texels)];
  const Vec2 size(static_cast<float>(texels.width()), static_cast<float>(texels.height()));
  TexelFootprint result{{}, texture.texels};
  for (int k = 0; k < 3; ++k) {
    const Vec2 uv = mesh.texCoords[slot.texCoord][mesh.triangles[triangle][k]];
    result.corners[static_cast<std::size_t>(k)] = slotUv(slot, uv) * size;
  }
  return result;
}

/// Texels of one axis that a lookup between `lower` and `upper` can touch: all when the range wraps.
TexelRange texelRange(float lower, float upper, int size) {
  // Half a texel for the filter, one more for the rounding of the coordinates.
  if (!(lower >= 2 && upper <= static_cast<float>(size) - 2)) return {0, size - 1};
  return {static_cast<int>(lower) - 2, std::min(static_cast<int>(upper) + 2, size - 1)};
}

/// Where the material emits if its texture lets it.
ColorChannels emittingChannels(const Material& material) {
  const Vec3& e = material.emission;
  return static_cast<ColorChannels>((e.x > 0 ? 1 : 0) | (e.y > 0 ? 2 : 0) | (e.z > 0 ? 4 : 0));
}

}  // namespace

Vec3 emission(const Scene& scene, const SurfaceCoordinates& at) {
  const Material& material = materialOf(scene, at);
  if (!hasTextures(material)) return material.emission;
  return material.emission * Vec3(slotValue(scene, TextureUse::kEmission, at));
}

float coverage(const Scene& scene, const SurfaceCoordinates& at) {
  const Material& material = materialOf(scene, at);
  if (!kCanHaveAlpha || material.alphaMode == AlphaMode::kOpaque) return 1;
  const float alpha = std::clamp(baseColorAlpha(scene, at).w, 0.0f, 1.0f);
  if (material.alphaMode == AlphaMode::kMask) return alpha >= material.alphaCutoff ? 1.0f : 0.0f;
  return alpha;
}

Vec3 baseColor(const Scene& scene, const SurfaceCoordinates& at) {
  return Vec3(baseColorAlpha(scene, at));
}

Vec3 shadingNormal(const Scene& scene, const SurfaceCoordinates& at, const Vec3& geometricNormal) {
  const Material& material = materialOf(scene, at);
  const bool isMapped =
      hasTextures(material) && material.slot(TextureUse::kNormal).texture && !at.mesh->tangents.empty();
  Vec3 normal = geometricNormal;
  if (!at.mesh->normals.empty()) {
    const Vec3 interpolated = interpolate(at.mesh->normals, at);
    const float length = glm::length(interpolated);
    if (!(length > 0)) return geometricNormal;
    normal = interpolated / length;
  } else if (isMapped &&
             glm::dot(facetNormal(*at.mesh, at.mesh->triangles[at.triangle]), glm::dvec3(geometricNormal)) < 0) {
    normal = -geometricNormal;  // maps are of the front
  }
  if (isMapped) normal = mappedNormal(scene, at, normal);
  return glm::dot(normal, geometricNormal) < 0 ? -normal : normal;
}

bool canReflect(const Material& material) {
  // Textures multiply.
  return !material.unlit && (material.metallic > 0 || material.specular > 0);
}

Bsdf bsdfAt(const Scene& scene, const SurfaceCoordinates& at) {
  const Material& material = materialOf(scene, at);
  const Vec3 color = baseColor(scene, at);
  if (!kCanHaveGgx || !canReflect(material)) return Bsdf(BsdfParameters{.diffuse = color});
  float metallic = material.metallic, roughness = material.roughness, specular = material.specular;
  Vec3 specularColor = material.specularColor;
  if (hasTextures(material)) {
    const Vec4 metallicRoughness = slotValue(scene, TextureUse::kMetallicRoughness, at);
    metallic *= metallicRoughness.z;
    roughness *= metallicRoughness.y;
    specular *= slotValue(scene, TextureUse::kSpecular, at).w;
    specularColor *= Vec3(slotValue(scene, TextureUse::kSpecularColor, at));
  }
  const float reflectance = (material.ior - 1) / (material.ior + 1);
  const Vec3 dielectricF0 = glm::min(reflectance * reflectance * specularColor, Vec3(1.0f)) * specular;

  BsdfParameters parameters;
  parameters.diffuse = color * (1 - metallic);
  parameters.f0 = dielectricF0 * (1 - metallic) + color * metallic;
  parameters.f90 = specular * (1 - metallic) + metallic;
  parameters.dielectricF0 = maxComponent(dielectricF0);
  parameters.dielectricF90 = specular;
  parameters.roughness = roughness;
  return Bsdf(parameters);
}

int emissionResolution(const Scene& scene, const Mesh& mesh, std::uint32_t triangle) {
  const Material& material = scene.materials[indexOf(mesh.material)];
  float longest = 1;
  for (const TextureUse use : {TextureUse::kEmission, TextureUse::kBaseColor}) {
    if (const auto area = footprint(scene, material.slot(use), mesh, triangle)) {
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, glm::length(area->corners[(k + 1) % 3] - area->corners[k]));
      }
    }
  }
  // The limit keeps a million textured triangles affordable; a coarser mean costs variance, never correctness.
  return static_cast<int>(std::min(std::ceil(longest), 64.0f));
}

bool canEmit(const Scene& scene, const Material& material, LitTexelsOfScene& lit) {
  if (isBlack(material.emission) || material.unlit) return false;
  const TextureSlot& slot = material.slot(TextureUse::kEmission);
  return !slot.texture || lit.of(scene.textures[indexOf(*slot.texture)].texels).any(emittingChannels(material));
}

bool canEmit(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, LitTexelsOfScene& lit) {
  const Material& material = scene.materials[indexOf(mesh.material)];
  const auto area = footprint(scene, material.slot(TextureUse::kEmission), mesh, triangle);
  // Coverage is not searched: a triangle that may be transparent everywhere is kept.
  if (!area) return true;
  const ImageRgba8& texels = scene.texels[indexOf(area->texels)];
  const auto [x0, x1] = std::minmax({area->corners[0].x, area->corners[1].x, area->corners[2].x});
  const auto [y0, y1] = std::minmax({area->corners[0].y, area->corners[1].y, area->corners[2].y});
  return lit.of(area->texels)
      .any(texelRange(x0, x1, texels.width()), texelRange(y0, y1, texels.height()), emittingChannels(material));
}

}  // namespace cellcut
