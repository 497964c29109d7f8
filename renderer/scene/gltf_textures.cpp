#include "renderer/scene/gltf_textures.h"

#include "renderer/base/error.h"
#include "renderer/scene/decode_texels.h"
#include "renderer/scene/gltf_values.h"
#include "renderer/scene/scene_draft.h"

namespace cellcut {
namespace {

Wrap wrapOf(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::kClamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::kMirror;
    default:
      return Wrap::kRepeat;
  }
}

/// uv' = offset + rotation · scale · uv, counter-clockwise in a picture whose v runs down.
/// Source: KHR_texture_transform, "rotation".
void applyTransform(const tinygltf::Value& transform, const std::string& place, TextureSlot& slot) {
  const glm::dvec2 offset = numbersOr<2>(transform, "offset", glm::dvec2(0), place);
  const glm::dvec2 scale = numbersOr<2>(transform, "scale", glm::dvec2(1), place);
  const double rotation = numberOr(transform, "rotation", 0, place);
  const double c = std::cos(rotation), s = std::sin(rotation);
  slot.uvOffset = Vec2(offset);
  slot.uvLinear = glm::mat2(Vec2(scale.x * glm::dvec2(c, -s)), Vec2(scale.y * glm::dvec2(s, c)));
  const auto isFinite2 = [](Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); };
  if (!isFinite2(slot.uvOffset) || !isFinite2(slot.uvLinear[0]) || !isFinite2(slot.uvLinear[1])) {
    throw InputError(place, "KHR_texture_transform is larger than a float can hold; choose a smaller one");
  }
}

}  // namespace

GltfTextures::GltfTextures(const GltfDocument& document, Scene& scene)
    : document_(document),
      scene_(scene),
      textures_(document.model.textures.size()),
      texels_(document.model.images.size()) {}

std::optional<TextureId> GltfTextures::addTexture(std::size_t index) {
  if (textures_[index]) return textures_[index];
  const tinygltf::Texture& source = document_.model.textures[index];
  if (source.source < 0) {
    warnOnce(scene_, placeOf(document_, "textures", index) + " has no PNG or JPEG and is ignored");
    return std::nullopt;
  }
  std::optional<TexelsId>& texels = texels_[static_cast<std::size_t>(source.source)];
  if (!texels) {
    texels = TexelsId{static_cast<std::uint32_t>(images_.size())};
    images_.push_back(static_cast<std::size_t>(source.source));
  }
  Texture texture{*texels};
  if (source.sampler >= 0) {
    const tinygltf::Sampler& sampler = document_.model.samplers[static_cast<std::size_t>(source.sampler)];
    texture.wrapS = wrapOf(sampler.wrapS);
    texture.wrapT = wrapOf(sampler.wrapT);
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  textures_[index] = TextureId{static_cast<std::uint32_t>(scene_.textures.size())};
  scene_.textures.push_back(texture);
  return textures_[index];
}

TextureSlot GltfTextures::slot(const GltfTextureInfo& info, const std::string& place) {
  TextureSlot slot;
  if (info.index < 0) return slot;
  int texCoord = info.texCoord;
  if (info.transform) {
    applyTransform(*info.transform, place, slot);
    texCoord = indexMember(*info.transform, "texCoord", place).value_or(texCoord);
  }
  if (texCoord < 0 || texCoord > 1) {
    warnOnce(scene_,
             place + ": a texture uses TEXCOORD_" + std::to_string(texCoord) + " and is ignored; 0 and 1 are read");
    return {};
  }
  slot.texCoord = static_cast<std::uint8_t>(texCoord);
  slot.texture = addTexture(static_cast<std::size_t>(info.index));
  return slot;
}

std::span<const std::byte> GltfTextures::encoded(std::size_t image) const {
  const int bufferView = document_.model.images[image].bufferView;
  return bufferView >= 0 ? bufferViewBytes(document_.model, bufferView) : std::span(document_.images[image]);
}

void GltfTextures::decode(std::uint64_t maxBytes) {
  std::vector<EncodedImage> images;
  for (const std::size_t image : images_) images.push_back({placeOf(document_, "images", image), encoded(image)});
  scene_.texels = decodeTexels(images, maxBytes, scene_);
}

}  // namespace cellcut
