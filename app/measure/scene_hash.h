/// \file scene_hash.h
/// A scene's content as a number, so that what was computed of it is found again.
#pragma once

#include "renderer/scene/scene.h"

#include <cstdint>
#include <string>

namespace cellcut {

/// Of all that a picture of the scene depends on: geometry, attributes, materials, texels, lights, environment; neither
/// names nor cameras.
std::uint64_t hashOfScene(const Scene& scene);

/// Of what a camera sees, its name aside.
std::uint64_t hashOfCamera(const Camera& camera);

/// Sixteen digits: 64 bits do not fit into the numbers of JSON's other readers.
std::string hexOf(std::uint64_t hash);

}  // namespace cellcut
