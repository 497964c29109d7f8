/// \file obj_materials.h
/// MTL materials and their pictures → the scene's.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_folder.h"

#include <istream>
#include <map>
#include <string>
#include <vector>

namespace cellcut {

/// Read-only stream over bytes that outlive it.
class ByteStream : private std::streambuf, public std::istream {
 public:
  explicit ByteStream(std::vector<std::byte>& bytes);
};

/// Reads the materials of an MTL file and appends them and their pictures to the scene.
/// A picture that is missing is a warning.
/// \throws InputError for references out of the folder, damaged pictures and
/// emission that is negative or not finite
/// \return id by name
std::map<std::string, MaterialId> readMtl(const SceneFolder& folder, std::vector<std::byte> bytes,
                                          const std::string& name, std::uint64_t maxTextureBytes, Scene& scene);

}  // namespace cellcut
