#include "renderer/scene/gltf_materials.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_textures.h"
#include "renderer/scene/gltf_values.h"
#include "renderer/scene/scene_draft.h"

namespace cellcut {
namespace {

/// One material being read.
struct Reader {
  const GltfDocument& document;
  Scene& scene;
  GltfTextures& textures;
  std::string place;

  double clamped(double value, double low, double high, const char* what) const {
    if (value >= low && value <= high) return value;
    warnOnce(scene, place + ": " + what + " is out of its range and was clamped");
    return value < low ? low : high;
  }
  Vec3 clampedColor(const glm::dvec3& color, double high, const char* what) const {
    return {clamped(color.x, 0, high, what), clamped(color.y, 0, high, what), clamped(color.z, 0, high, what)};
  }
  /// A texture named in an extension's JSON.
  TextureSlot slot(const tinygltf::Value& object, const char* key) const {
    const tinygltf::Value* info = member(object, key);
    if (!info) return {};
    const std::optional<int> index = indexMember(*info, "index", place);
    if (!index) throw InputError(place, std::string(key) + " names no texture; export the file again");
    if (static_cast<std::size_t>(*index) >= document.model.textures.size()) {
      throw InputError(
          place, std::string(key) + ": texture " + std::to_string(*index) + " does not exist; export the file again");
    }
    const tinygltf::Value* extensions = member(*info, "extensions");
    return textures.slot({*index, indexMember(*info, "texCoord", place).value_or(0),
                          extensions ? member(*extensions, "KHR_texture_transform") : nullptr},
                         place);
  }
  template <class TextureInfo>
  TextureSlot slot(const TextureInfo& info) const {
    return textures.slot({info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform")}, place);
  }
};

void readMetallicRoughness(const Reader& reader, const tinygltf::PbrMetallicRoughness& pbr, Material& material) {
  const glm::dvec4 color = vectorOr<4>(pbr.baseColorFactor, glm::dvec4(1), reader.place + ": baseColorFactor");
  material.baseColor = {reader.clampedColor(glm::dvec3(color), 1, "baseColorFactor"),
                        static_cast<float>(reader.clamped(color.w, 0, 1, "baseColorFactor"))};
  material.setSlot(TextureUse::kBaseColor, reader.slot(pbr.baseColorTexture));
  material.metallic = static_cast<float>(reader.clamped(pbr.metallicFactor, 0, 1, "metallicFactor"));
  material.roughness = static_cast<float>(reader.clamped(pbr.roughnessFactor, 0, 1, "roughnessFactor"));
  material.setSlot(TextureUse::kMetallicRoughness, reader.slot(pbr.metallicRoughnessTexture));
}

void readSpecular(const Reader& reader, const tinygltf::ExtensionMap& extensions, Material& material) {
  constexpr double kMaxFloat = std::numeric_limits<float>::max();
  if (const tinygltf::Value* ior = extension(extensions, "KHR_materials_ior")) {
    const double value = numberOr(*ior, "ior", 1.5, reader.place);
    material.ior = value == 0 ? 0.0f : static_cast<float>(reader.clamped(value, 1, kMaxFloat, "ior"));
  }
  if (const tinygltf::Value* specular = extension(extensions, "KHR_materials_specular")) {
    const double strength = numberOr(*specular, "specularFactor", 1, reader.place);
    material.specular = static_cast<float>(reader.clamped(strength, 0, 1, "specularFactor"));
    material.setSlot(TextureUse::kSpecular, reader.slot(*specular, "specularTexture"));
    material.specularColor = reader.clampedColor(
        numbersOr<3>(*specular, "specularColorFactor", glm::dvec3(1), reader.place), kMaxFloat, "specularColorFactor");
    material.setSlot(TextureUse::kSpecularColor, reader.slot(*specular, "specularColorTexture"));
  }
}

void readEmission(const Reader& reader, const tinygltf::Material& source, Material& material) {
  double strength = 1;
  if (const tinygltf::Value* emissive = extension(source.extensions, "KHR_materials_emissive_strength")) {
    strength = numberOr(*emissive, "emissiveStrength", 1, reader.place);
  }
  const glm::dvec3 factor = vectorOr<3>(source.emissiveFactor, glm::dvec3(0), reader.place + ": emissiveFactor");
  if (factor.x < 0 || factor.y < 0 || factor.z < 0 || strength < 0) {
    throw InputError(reader.place,
                     "\"" + printable(source.name) + "\" emits negative light; make its emission 0 or more");
  }
  material.emission = Vec3(factor * strength);
  if (!isFinite(material.emission)) {
    throw InputError(reader.place,
                     "\"" + printable(source.name) + "\" emits more than a float can hold; lower its emission");
  }
  material.setSlot(TextureUse::kEmission, reader.slot(source.emissiveTexture));
}

AlphaMode alphaModeOf(const std::string& name, const std::string& place) {
  if (name == "OPAQUE") return AlphaMode::kOpaque;
  if (name == "MASK") return AlphaMode::kMask;
  if (name == "BLEND") return AlphaMode::kBlend;
  throw InputError(place, "alphaMode must be OPAQUE, MASK or BLEND");
}

Material readMaterial(const Reader& reader, const tinygltf::Material& source) {
  Material material;
  material.name = source.name;
  readMetallicRoughness(reader, source.pbrMetallicRoughness, material);
  readSpecular(reader, source.extensions, material);
  readEmission(reader, source, material);
  material.setSlot(TextureUse::kNormal, reader.slot(source.normalTexture));
  material.normalScale = static_cast<float>(source.normalTexture.scale);
  if (!std::isfinite(material.normalScale))
    throw InputError(reader.place, "the normal texture's scale is too large; choose a smaller one");
  material.alphaMode = alphaModeOf(source.alphaMode, reader.place);
  material.alphaCutoff =
      static_cast<float>(reader.clamped(source.alphaCutoff, 0, std::numeric_limits<float>::max(), "alphaCutoff"));
  material.doubleSided = source.doubleSided;
  material.unlit = extension(source.extensions, "KHR_materials_unlit") != nullptr;
  return material;
}

bool needsDefaultMaterial(const tinygltf::Model& model) {
  const auto hasNone = [](const tinygltf::Primitive& primitive) { return primitive.material < 0; };
  return std::any_of(model.meshes.begin(), model.meshes.end(), [&](const tinygltf::Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), hasNone);
  });
}

}  // namespace

void readMaterials(const GltfDocument& document, std::uint64_t maxTextureBytes, Scene& scene) {
  GltfTextures textures(document, scene);
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const Reader reader{document, scene, textures, placeOf(document, "materials", i)};
    scene.materials.push_back(readMaterial(reader, document.model.materials[i]));
  }
  if (needsDefaultMaterial(document.model)) {
    scene.materials.emplace_back();
    scene.materials.back().name = "default";
  }
  textures.decode(maxTextureBytes);
}

}  // namespace cellcut
