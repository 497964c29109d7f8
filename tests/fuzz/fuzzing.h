/// \file fuzzing.h
/// What the fuzz programs share. Each is one libFuzzer target: bytes → a reader of ours, which uses or refuses them.
#pragma once

#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/temporary_directory.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>

namespace cellcut::fuzz {

/// Calls a reader; InputError is the one way in which it may refuse.
template <class Read>
int read(const Read& reader) {
  try {
    reader();
  } catch (const InputError&) {
  }
  return 0;
}

inline std::span<const std::byte> bytes(const std::uint8_t* data, std::size_t size) {
  return std::as_bytes(std::span(data, size));
}

/// Loads the bytes as a scene file of this extension.
inline int loadAs(const std::string& extension, const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryDirectory folder;
  const auto file = folder / ("scene" + extension);
  {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  return read([&] { loadScene(file); });
}

}  // namespace cellcut::fuzz
