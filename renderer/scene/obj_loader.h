/// \file obj_loader.h
/// Wavefront OBJ with MTL → SceneDraft.
///
/// Read are Kd, Ks and Ns (roughly, as a dielectric's specular and roughness), Ke, d, map_Kd and map_Ke. OBJ says
/// nothing about sidedness: emitters emit from their front, everything else has two sides.
#pragma once

#include "renderer/scene/scene_draft.h"

#include <filesystem>

namespace cellcut {

/// A material library or picture that is missing is a warning; a reference out of the folder is refused.
/// \throws InputError for everything else that is wrong with the file
SceneDraft loadObj(const std::filesystem::path& file, const LoadLimits& limits);

}  // namespace cellcut
