#include "ui/viewer/recent_files.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>

namespace cellcut {

RecentFiles::RecentFiles(std::optional<std::filesystem::path> file) : file_(std::move(file)) {
  if (!file_) return;
  std::ifstream stream(*file_);
  for (std::string line; list_.size() < kMost && std::getline(stream, line);) {
    if (!line.empty()) list_.emplace_back(line);
  }
}

void RecentFiles::add(const std::filesystem::path& opened) {
  std::error_code ignored;
  const std::filesystem::path file = std::filesystem::absolute(opened, ignored).lexically_normal();
  if (ignored || file.empty() || file.string().find('\n') != std::string::npos) return;
  list_.erase(std::remove(list_.begin(), list_.end(), file), list_.end());
  list_.insert(list_.begin(), file);
  if (list_.size() > kMost) list_.resize(kMost);
  if (!file_) return;
  std::string text;
  for (const std::filesystem::path& path : list_) text += path.string() + '\n';
  std::filesystem::create_directories(file_->parent_path(), ignored);
  try {
    writeFileAtomically(*file_, std::as_bytes(std::span(text)));
  } catch (const InputError&) {
    file_.reset();  // a read-only home: the list lives as long as the window
  }
}

std::string RecentFiles::nameOf(const std::filesystem::path& file) {
  return file.filename().string() + " (" + file.parent_path().filename().string() + ")";
}

std::optional<std::filesystem::path> recentFilesPath(bool onlyIfSet) {
  // As the specification has it, a relative path is none.
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && std::filesystem::path(state).is_absolute()) return std::filesystem::path(state) / "cellcut" / "recent";
  const char* home = std::getenv("HOME");
  if (onlyIfSet || !home || !std::filesystem::path(home).is_absolute()) return std::nullopt;
  return std::filesystem::path(home) / ".local" / "state" / "cellcut" / "recent";
}

}  // namespace cellcut
