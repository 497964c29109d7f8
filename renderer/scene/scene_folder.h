/// \file scene_folder.h
/// The files that a scene file may name: those that lie beside or below it, and no others.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcut {

/// Largest file that a scene may consist of, in bytes: what the 32-bit lengths of a .glb can express.
inline constexpr std::uintmax_t kMaxSceneFileBytes = std::uintmax_t{1} << 32;

class SceneFolder {
 public:
  /// \param sceneFile the scene itself; its folder is the limit
  explicit SceneFolder(const std::filesystem::path& sceneFile);

  /// File that a decoded relative reference names, inside the folder even after symbolic links are followed.
  /// \throws InputError for absolute paths, "..", URI schemes, control characters and links that lead outside.
  std::filesystem::path resolve(const std::string& reference) const;

  /// The bytes of that file.
  /// \throws InputError as resolve() and readFile().
  std::vector<std::byte> read(const std::string& reference) const;

 private:
  std::string scene_;  ///< file name, for messages
  std::filesystem::path folder_;
};

}  // namespace cellcut
