/// \file gltf_materials.h
/// glTF materials, textures and images → the scene's.
#pragma once

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

namespace cellcut {

/// Fills scene.materials (one per glTF material, in order, then glTF's default material if a primitive has none),
/// textures and texels. Images that no material uses are not decoded. Values that are only out of range are
/// clamped with a warning.
/// \throws InputError for values without meaning (negative emission by name) and pictures that cannot be decoded
void readMaterials(const GltfDocument& document, std::uint64_t maxTextureBytes, Scene& scene);

}  // namespace cellcut
