#include "renderer/scene/decode_texels.h"

#include "renderer/base/error.h"

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

std::vector<ImageRgba8> decodeTexels(std::span<const EncodedImage> images, std::uint64_t maxBytes) {
  checkTextureBytes(images, maxBytes);
  std::vector<ImageRgba8> texels(images.size());
  std::vector<std::optional<InputError>> errors(images.size());  // so that the first is reported, whoever comes first
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    try {
      texels[i] = decodeImage8(images[i].bytes, images[i].name);
    } catch (const InputError& error) {
      errors[i] = error;
    }
  });
  for (const std::optional<InputError>& error : errors) {
    if (error) throw *error;
  }
  return texels;
}

}  // namespace cellcut
