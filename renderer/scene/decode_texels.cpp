#include "renderer/scene/decode_texels.h"

#include "renderer/base/error.h"
#include "renderer/scene/scene_draft.h"

#include <optional>

#include <tbb/parallel_for.h>

namespace cellcut {

namespace {

void checkTextureBytes(std::span<const EncodedImage> images, std::uint64_t maxBytes) {
  std::uint64_t bytes = 0;
  for (const EncodedImage& image : images) {
    const glm::u64vec2 size = imageSize8(image.bytes, image.name);
    bytes += size.x * size.y * sizeof(ImageRgba8::value_type);
    if (bytes > maxBytes) {
      throw InputError(image.name, "with it the textures have more than " + std::to_string(maxBytes) +
                                       " bytes, the limit (--max-texture-bytes)");
    }
  }
}

}  // namespace

std::vector<ImageRgba8> decodeTexels(std::span<const EncodedImage> images, std::uint64_t maxBytes, Scene& scene) {
  checkTextureBytes(images, maxBytes);
  std::vector<ImageRgba8> texels(images.size());
  // Reported in order, whoever comes first.
  std::vector<std::optional<InputError>> errors(images.size());
  std::vector<std::string> damages(images.size());
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    try {
      texels[i] = decodeImage8(images[i].bytes, images[i].name, &damages[i]);
    } catch (const InputError& error) {
      errors[i] = error;
    }
  });
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (errors[i]) throw *errors[i];
    if (!damages[i].empty()) warnOnce(scene, images[i].name + " is damaged and may show in parts only: " + damages[i]);
  }
  return texels;
}

}  // namespace cellcut
