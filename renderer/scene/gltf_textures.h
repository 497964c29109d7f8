/// \file gltf_textures.h
/// The textures that a glTF's materials use, each once, their pictures decoded in parallel.
#pragma once

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace cellcut {

/// A use of a texture. Source: glTF 2.0 section 5.30 (textureInfo).
struct GltfTextureInfo {
  int index = -1;  ///< −1: none
  int texCoord = 0;
  const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform, if there is one
};

class GltfTextures {
 public:
  /// Both must outlive this.
  GltfTextures(const GltfDocument& document, Scene& scene);

  /// The slot of a use; its texture joins the scene if it is new there. Empty, with a warning, if the texture has no
  /// picture that can be read or wants a third set of coordinates.
  /// \throws InputError at `place` if the transform is broken
  TextureSlot slot(const GltfTextureInfo& info, const std::string& place);

  /// Decodes the pictures of all slots so far into scene.texels.
  /// \throws InputError if one cannot be decoded or they are too large
  /// \param maxBytes  of all together
  void decode(std::uint64_t maxBytes);

 private:
  std::span<const std::byte> encoded(std::size_t image) const;
  std::optional<TextureId> addTexture(std::size_t index);

  const GltfDocument& document_;
  Scene& scene_;
  std::vector<std::optional<TextureId>> textures_;  ///< of the scene, by glTF texture
  std::vector<std::optional<TexelsId>> texels_;     ///< of the scene, by glTF image
  std::vector<std::size_t> images_;                 ///< glTF images, by TexelsId
};

}  // namespace cellcut
