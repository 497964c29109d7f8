#include "renderer/scene/decode_texels.h"

#include "renderer/base/error.h"

#include <optional>

#include <tbb/parallel_for.h>

namespace cellcut {

std::vector<ImageRgba8> decodeTexels(std::span<const EncodedImage> images) {
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
