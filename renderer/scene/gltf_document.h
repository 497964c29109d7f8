/// \file gltf_document.h
/// A glTF file in memory: parsed, its buffers read, its references checked.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace cellcut {

struct GltfDocument {
  std::string name;  ///< of the file, for messages
  tinygltf::Model model;
  /// PNG or JPEG as stored, of images that lie outside of buffers; empty for one that names the file of another, in whose
  /// place its textures name that one
  std::vector<std::vector<std::byte>> images;
  std::string complaint;  ///< what the parser could not read and left out; empty if nothing
};

/// Reads and parses a .gltf or .glb with the files beside it, and runs checkDocument on it.
/// \throws InputError for everything that is wrong with it
GltfDocument readGltf(const std::filesystem::path& file);

/// Bytes of a buffer view. \pre checkDocument passed
std::span<const std::byte> bufferViewBytes(const tinygltf::Model& model, int bufferView);

/// Where something is wrong, for messages: "lamp.gltf: accessors[3]".
std::string placeOf(const GltfDocument& document, const char* array, std::size_t index);

}  // namespace cellcut
