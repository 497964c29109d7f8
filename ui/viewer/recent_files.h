/// \file recent_files.h
/// The scenes that were opened last, kept from one run to the next.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cellcut {

class RecentFiles {
 public:
  static constexpr std::size_t kMost = 10;

  /// \param file  a path per line, newest first; nothing: they are forgotten at the end. One that cannot be read counts
  /// as empty
  explicit RecentFiles(std::optional<std::filesystem::path> file);

  /// Newest first.
  const std::vector<std::filesystem::path>& list() const { return list_; }
  /// Moves a file to the front, and writes the list; that it cannot be written is no reason to stop.
  void add(const std::filesystem::path& opened);
  /// "room.glb (scenes)": as a list shows it.
  static std::string nameOf(const std::filesystem::path& file);

 private:
  std::optional<std::filesystem::path> file_;
  std::vector<std::filesystem::path> list_;
};

/// $XDG_STATE_HOME/cellcut/recent, or ~/.local/state/cellcut/recent. Nothing without either, and where `onlyIfSet` and
/// the variable is not set. Source: XDG Base Directory Specification 0.8.
std::optional<std::filesystem::path> recentFilesPath(bool onlyIfSet);

}  // namespace cellcut
