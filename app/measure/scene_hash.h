/// \file scene_hash.h
/// A scene's content as a number, so that what was computed of it is found again.
#pragma once

#include "renderer/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace cellcut {

/// 64-bit hash of bytes, for caches: nobody is kept from making two inputs collide.
/// Source: Fowler, Noll, Vo, FNV-1a, over words of eight bytes.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t start = 14695981039346656037ull);

/// Of all that a picture of the scene depends on: geometry, attributes, materials, texels, lights, environment; neither
/// names nor cameras.
std::uint64_t hashOfScene(const Scene& scene);

/// Of what a camera sees, its name aside.
std::uint64_t hashOfCamera(const Camera& camera);

}  // namespace cellcut
