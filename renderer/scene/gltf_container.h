/// \file gltf_container.h
/// Checks of a glTF file's outer shape, made before the JSON library sees it: that one nests and copies without limit.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace cellcut {

/// Deepest nesting of JSON values; real files stay below 20.
inline constexpr int kMaxJsonDepth = 128;
/// Most JSON values in a file: each costs up to 200 bytes while the file is read.
inline constexpr std::size_t kMaxJsonValues = std::size_t{1} << 25;

/// True if the bytes begin like a binary glTF.
bool isBinaryGltf(std::span<const std::byte> file);

/// The JSON text of a .gltf or .glb, with header and chunks checked to lie inside the file and to come in order.
/// \throws InputError; `name` is used in messages only. Source: glTF 2.0 section 4.4.
std::string_view gltfJson(std::span<const std::byte> file, const std::string& name);

/// \param remedy  what the message ends with: how to come by a better text
/// \throws InputError if the text nests deeper than kMaxJsonDepth or holds more than kMaxJsonValues. Says nothing else
/// about it.
void checkJsonShape(std::string_view json, const std::string& name, const std::string& remedy);

}  // namespace cellcut
