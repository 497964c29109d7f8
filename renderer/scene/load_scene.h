/// \file load_scene.h
/// A scene file of any known kind → Scene.
#pragma once

#include "renderer/scene/load_options.h"
#include "renderer/scene/scene.h"

#include <filesystem>

namespace cellcut {

/// Loads .gltf, .glb or .obj by the file's extension (any case). Bounded: a file that lies about its sizes is refused
/// before anything of that size is allocated.
/// \throws InputError naming file, place and remedy; nothing else
Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {});

/// Puts a lat-long picture around the scene, in place of any that it has. Texels that are NaN or infinite and
/// negative channels become 0 and are warned about.
/// \param scale     multiplies every texel
/// \param rotation  degrees about +Y, counter-clockwise seen from above
/// \param name      of the picture, for messages
/// \throws InputError if scale or rotation is not finite, scale is negative, or a scaled texel leaves the
/// range of a float
void setEnvironment(Scene& scene, ImageRgb radiance, double scale, double rotation, const std::string& name);

}  // namespace cellcut
