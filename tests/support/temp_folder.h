/// \file temp_folder.h
/// A folder of its own for a test that needs files.
#pragma once

#include <filesystem>
#include <string_view>

namespace cellcut {

/// An empty folder below the system's folder for temporary files; gone, with all in it, when the object goes.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace cellcut
