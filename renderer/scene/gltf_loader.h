/// \file gltf_loader.h
/// glTF 2.0 files (.gltf with files beside it, .glb) → SceneDraft.
///
/// Extensions: KHR_mesh_quantization, KHR_texture_transform, KHR_materials_emissive_strength, _specular, _ior, _unlit,
/// KHR_lights_punctual, and CELLCUT_environment: root-level {"bufferView": i}, the bytes of a lat-long EXR or HDR.
/// Skins, animations and morph targets are ignored. Source: glTF 2.0, Khronos 2021.
#pragma once

#include "renderer/scene/load_scene.h"
#include "renderer/scene/scene_draft.h"

namespace cellcut {

/// \throws InputError for everything that is wrong with the file
SceneDraft loadGltf(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace cellcut
