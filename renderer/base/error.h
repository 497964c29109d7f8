/// \file error.h
/// The one exception of the library: input that cannot be used.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace cellcut {

/// Bad input: a file, an option or a scene that cannot be used. Everything else is an assertion.
/// what() is one line, ready to be shown: "lamp.gltf: accessors[3]: reaches past its bufferView; export the file
/// again".
class InputError : public std::runtime_error {
 public:
  /// \param where   the file, and the place in it when there is one ("lamp.gltf: accessors[3]")
  /// \param problem what is wrong there, and what the person can do about it
  InputError(const std::string& where, const std::string& problem) : std::runtime_error(where + ": " + problem) {}
};

/// A word of a file that is broken or hostile, as it may be shown: neither longer than `most` bytes and "…" nor with
/// control characters. No character of UTF-8 is cut in half; bytes that are none stay as they are.
inline std::string printable(const std::string& word, std::size_t most = 80) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(word[i]); };
  std::size_t size = std::min(word.size(), most);
  // A character has at most three bytes after its first.
  for (int i = 0; i < 3 && size > 0 && size < word.size() && (byte(size) & 0xc0) == 0x80; ++i) --size;
  std::string text = word.substr(0, size);
  for (std::size_t i = 0; i < size; ++i) {
    if (byte(i) < 0x20 || byte(i) == 0x7f) text[i] = '?';
    // U+0080 to U+009F, which terminals obey, too.
    if (i + 1 < size && byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0) text[i] = text[i + 1] = '?';
  }
  return size < word.size() ? text + "…" : text;
}

}  // namespace cellcut
