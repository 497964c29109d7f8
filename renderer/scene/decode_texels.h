/// \file decode_texels.h
/// Many pictures at once.
#pragma once

#include "renderer/base/image_io.h"
#include "renderer/scene/scene.h"

#include <span>
#include <string>
#include <vector>

namespace cellcut {

struct EncodedImage {
  std::string name;  ///< for messages
  std::span<const std::byte> bytes;
};

/// decodeImage8 of each, in parallel and in order.
/// \param maxBytes  of all together, decoded
/// \param scene  gets a warning for each that is damaged
/// \throws InputError of the first that cannot be decoded, or past which they are too large
std::vector<ImageRgba8> decodeTexels(std::span<const EncodedImage> images, std::uint64_t maxBytes, Scene& scene);

}  // namespace cellcut
