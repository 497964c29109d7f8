/// \file obj_materials.h
/// MTL materials and their pictures → the scene's.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_folder.h"

#include <map>
#include <string>

namespace cellcut {

/// Appends the materials of an MTL file and their pictures to the scene. Pictures are looked for beside the library, then
/// beside the scene; one that is missing is a warning.
/// \param library  the file, relative to `folder`
/// \throws InputError for references out of the folder, damaged pictures and emission that is negative or not finite
/// \return id by name
std::map<std::string, MaterialId> readMtl(const SceneFolder& folder, const std::string& library,
                                          std::uint64_t maxTextureBytes, Scene& scene);

}  // namespace cellcut
