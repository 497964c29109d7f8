#include "renderer/scene/gltf_container.h"

#include "renderer/base/error.h"

#include <cstdint>

namespace cellcut {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Little-endian, \pre offset + 4 ≤ file.size()
std::uint32_t wordAt(std::span<const std::byte> file, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(file[offset + i]) << (8 * i);
  return word;
}

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool isBinaryGltf(std::span<const std::byte> file) {
  return file.size() >= 4 && wordAt(file, 0) == kMagic;
}

std::string_view gltfJson(std::span<const std::byte> file, const std::string& name) {
  if (!isBinaryGltf(file)) {
    const std::string_view text = textOf(file);
    constexpr std::string_view kBeforeAnObject = " \t\r\n\xEF\xBB\xBF";  // the last three: a byte order mark
    const std::size_t first = text.find_first_not_of(kBeforeAnObject);
    if (first == std::string_view::npos || text[first] != '{')
      throw InputError(name, "is no glTF file; export the scene again");
    return text;
  }
  if (file.size() < kHeaderBytes + kChunkHeaderBytes)
    throw InputError(name, "the file ends inside its header; copy it again");
  if (wordAt(file, 4) != 2) {
    throw InputError(name, "binary glTF version " + std::to_string(wordAt(file, 4)) + "; only version 2 is read");
  }
  const std::size_t length = wordAt(file, 8);
  if (length > file.size()) throw InputError(name, "the file is shorter than its header says; copy it again");

  std::string_view json;
  std::size_t chunk = 0;
  for (std::size_t at = kHeaderBytes; at < length; ++chunk) {
    const std::string place = name + ": chunk " + std::to_string(chunk);
    if (length - at < kChunkHeaderBytes) throw InputError(place, "the file ends inside its header; copy it again");
    const std::size_t size = wordAt(file, at);
    const std::uint32_t type = wordAt(file, at + 4);
    at += kChunkHeaderBytes;
    if (size > length - at) throw InputError(place, "reaches past the end of the file; copy it again");
    if ((chunk == 0) != (type == kJsonChunk))
      throw InputError(place, "the first chunk, and no other, must be JSON; export the file again");
    if (type == kBinaryChunk && chunk != 1)
      throw InputError(place, "binary data must be the second chunk; export the file again");
    if (chunk == 0) json = textOf(file.subspan(at, size));
    at += size;
  }
  return json;
}

void checkJsonShape(std::string_view json, const std::string& name, const std::string& remedy) {
  int depth = 0;
  std::size_t values = 1;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
      continue;
    }
    if (c == '"') inString = true;
    if (c == ',' || c == ':') ++values;
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > kMaxJsonDepth) {
      throw InputError(name, "JSON nested more than " + std::to_string(kMaxJsonDepth) + " deep; " + remedy);
    }
  }
  if (values > kMaxJsonValues)
    throw InputError(name, "more than " + std::to_string(kMaxJsonValues) + " JSON values; " + remedy);
}

}  // namespace cellcut
