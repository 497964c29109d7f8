#include "renderer/scene/obj_materials.h"

#include "renderer/base/error.h"
#include "renderer/scene/decode_texels.h"
#include "renderer/scene/obj_lines.h"
#include "renderer/scene/scene_draft.h"

#include <algorithm>
#include <sstream>

// Debian builds the library for float and for double. Positions far from zero need double.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

namespace cellcut {
namespace {

/// The pictures of one MTL file, each read once and decoded together at the end.
class Pictures {
 public:
  /// \param library  the MTL file, relative to `folder`
  Pictures(const SceneFolder& folder, const std::string& library, Scene& scene)
      : folder_(folder), beside_(std::filesystem::path(library).parent_path()), scene_(scene) {}

  /// The slot of a map; empty if it names no file, and with a warning if the file is missing.
  TextureSlot slot(std::string reference, const tinyobj::texture_option_t& options) {
    TextureSlot slot;
    if (reference.empty()) return slot;
    std::replace(reference.begin(), reference.end(), '\\', '/');  // as programs on Windows write it
    if (const std::string beside = (beside_ / reference).string(); std::filesystem::exists(folder_.resolve(beside)))
      reference = beside;
    const std::filesystem::path file = folder_.resolve(reference);
    if (!std::filesystem::exists(file)) {
      warnOnce(scene_, printable(reference) + " is missing; its material is shown without it");
      return slot;
    }
    const auto [entry, isNew] = index_.try_emplace(file.string(), files_.size());
    if (isNew) {
      files_.push_back(folder_.read(reference));
      names_.push_back(file.filename().string());
    }
    const Wrap wrap = options.clamp ? Wrap::kClamp : Wrap::kRepeat;
    slot.texture = TextureId{static_cast<std::uint32_t>(scene_.textures.size())};
    scene_.textures.push_back({TexelsId{static_cast<std::uint32_t>(scene_.texels.size() + entry->second)}, wrap, wrap});
    // uv' = scale · uv + offset where v counts from the bottom; here it counts from the top.
    const Vec2 scale(options.scale[0], options.scale[1]), offset(options.origin_offset[0], options.origin_offset[1]);
    if (!std::isfinite(scale.x + scale.y + offset.x + offset.y))
      throw InputError(beside_ / reference, "-s and -o must be finite; export the file again");
    slot.uvLinear = glm::mat2(scale.x, 0, 0, scale.y);
    slot.uvOffset = {offset.x, 1 - scale.y - offset.y};
    return slot;
  }

  /// \param maxBytes  of all texels of the scene
  void decode(std::uint64_t maxBytes) {
    for (const ImageRgba8& before : scene_.texels) maxBytes -= std::min<std::uint64_t>(maxBytes, before.bytes());
    std::vector<EncodedImage> encoded;
    for (std::size_t i = 0; i < files_.size(); ++i) encoded.push_back({names_[i], files_[i]});
    std::vector<ImageRgba8> texels = decodeTexels(encoded, maxBytes, scene_);
    std::move(texels.begin(), texels.end(), std::back_inserter(scene_.texels));
  }

 private:
  const SceneFolder& folder_;
  std::filesystem::path beside_;
  Scene& scene_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::vector<std::byte>> files_;
  std::vector<std::string> names_;
};

/// NaN becomes `low`.
float clamped(double value, double low, double high) {
  return static_cast<float>(value > low ? std::min(value, high) : low);
}

Vec3 colorOf(const tinyobj::real_t (&c)[3]) {
  return {clamped(c[0], 0, 1), clamped(c[1], 0, 1), clamped(c[2], 0, 1)};
}

/// Roughness √α, α of the GGX lobe like that of a Blinn-Phong exponent: α² = 2 / (Ns + 2). Source: Walter et al. 2007,
/// section 5.2. A mirror for an exponent that is infinite; NaN becomes 0.
float roughnessOf(double exponent) {
  const double alphaSquared = 2 / (std::max(0.0, exponent) + 2);
  return static_cast<float>(std::sqrt(std::sqrt(alphaSquared)));
}

Vec3 emissionOf(const tinyobj::material_t& source, const std::string& place) {
  const Vec3 emission(glm::dvec3(source.emission[0], source.emission[1], source.emission[2]));
  if (!isFinite(emission) || emission.x < 0 || emission.y < 0 || emission.z < 0) {
    throw InputError(place, "Ke must be finite and 0 or more");
  }
  return emission;
}

Material materialOf(const tinyobj::material_t& source, const std::string& place, Pictures& pictures) {
  Material material;
  material.name = source.name;
  material.metallic = 0;
  material.baseColor = {colorOf(source.diffuse), clamped(source.dissolve, 0, 1)};
  material.setSlot(TextureUse::kBaseColor, pictures.slot(source.diffuse_texname, source.diffuse_texopt));
  // Illumination model 1 has no highlight whatever Ks says. Ks of 1 is a dielectric's full reflection, 4 % at normal
  // incidence.
  material.specular = source.illum == 1 ? 0.0f : maxComponent(colorOf(source.specular));
  material.roughness = material.specular > 0 ? roughnessOf(source.shininess) : 1.0f;
  material.emission = emissionOf(source, place);
  const TextureSlot picture = pictures.slot(source.emissive_texname, source.emissive_texopt);
  material.setSlot(TextureUse::kEmission, picture);
  if (picture.texture && isBlack(material.emission)) material.emission = Vec3(1);
  if (material.baseColor.w < 1) material.alphaMode = AlphaMode::kBlend;
  material.doubleSided = isBlack(material.emission);
  return material;
}

}  // namespace

std::map<std::string, MaterialId> readMtl(const SceneFolder& folder, const std::string& library,
                                          std::uint64_t maxTextureBytes, Scene& scene) {
  std::vector<std::byte> bytes = folder.read(library);
  const std::span text(reinterpret_cast<char*>(bytes.data()), bytes.size());
  joinContinuedLines(text);
  std::map<std::string, int> indices;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const PlainMtl plain = plainMtl({text.data(), text.size()});
  std::istringstream stream(plain.text);
  tinyobj::LoadMtl(&indices, &materials, &stream, &warnings, &errors);
  const std::string name = std::filesystem::path(library).filename().string();
  if (!errors.empty())
    throw InputError(name, printable(errors.substr(0, errors.find('\n'))) + "; export the file again");

  std::map<std::string, MaterialId> ids;
  for (std::size_t i = 0; i < plain.names.size(); ++i) {
    const auto index = static_cast<std::size_t>(indices.at(std::to_string(i)));
    materials[index].name = plain.names[i];
    ids.try_emplace(plain.names[i], MaterialId{static_cast<std::uint32_t>(scene.materials.size() + index)});
  }
  Pictures pictures(folder, library, scene);
  for (const tinyobj::material_t& source : materials) {
    scene.materials.push_back(materialOf(source, name + ": " + printable(source.name), pictures));
  }
  pictures.decode(maxTextureBytes);
  return ids;
}

}  // namespace cellcut
