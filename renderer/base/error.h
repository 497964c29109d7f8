/// \file error.h
/// The one exception of the library: input that cannot be used.
#pragma once

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

}  // namespace cellcut
