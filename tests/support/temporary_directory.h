/// \file temporary_directory.h
/// A folder that a test may write into.
#pragma once

#include <filesystem>

namespace cellcut::test {

/// Empty at first; removed with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  std::size_t fileCount() const;

 private:
  std::filesystem::path path_;
};

}  // namespace cellcut::test
