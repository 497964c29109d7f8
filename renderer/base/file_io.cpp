// readFile and writeFileAtomically of image_io.h.
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace cellcut {

namespace {

namespace fs = std::filesystem;

std::string describe(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void refuseWriting(const fs::path& file, int error) {
  throw InputError(file.string(), "cannot be written (" + describe(error) + "); choose another place");
}

/// A new file that is removed again unless it is renamed.
class TemporaryFile {
 public:
  /// Beside `target`, so that the rename stays inside one file system.
  /// \throws InputError
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    constexpr int kAttempts = 100;  // names are taken only by leftovers of killed runs and by other threads
    for (int i = 0; i < kAttempts && !file_; ++i) {
      path_ = target;
      path_ += std::string(".").append(std::to_string(::getpid())).append("-").append(std::to_string(i)).append(".tmp");
      file_ = std::fopen(path_.c_str(), "wbx");
      if (!file_ && errno != EEXIST) break;
    }
    if (!file_) refuseWriting(target, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (file_) std::fclose(file_);
    std::error_code ignored;  // nothing can be done about it, and the target is whole either way
    if (!renamed_) fs::remove(path_, ignored);
  }

  void write(std::span<const std::byte> bytes) {
    // An empty span may hold a null pointer, which fwrite() may not be given.
    if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
      refuseWriting(target_, errno);
    }
  }

  /// Everything onto the disk, then under the target's name.
  void rename() {
    if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) refuseWriting(target_, errno);
    const int closed = std::fclose(file_);
    file_ = nullptr;
    if (closed != 0) refuseWriting(target_, errno);
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) refuseWriting(target_, error.value());
    renamed_ = true;
  }

 private:
  fs::path target_;
  fs::path path_;
  std::FILE* file_ = nullptr;
  bool renamed_ = false;
};

}  // namespace

void writeFileAtomically(const fs::path& file, std::span<const std::byte> bytes) {
  TemporaryFile temporary(file);
  temporary.write(bytes);
  temporary.rename();
}

std::vector<std::byte> readFile(const fs::path& file, std::uintmax_t maxBytes) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(file.string(), "does not exist");
  if (!fs::is_regular_file(status)) throw InputError(file.string(), "is no regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw InputError(file.string(), "cannot be read (" + error.message() + ")");
  if (size > maxBytes) {
    throw InputError(file.string(),
                     "has " + std::to_string(size) + " bytes, more than the limit of " + std::to_string(maxBytes));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "cannot be opened (" + describe(errno) + ")");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (stream.gcount() != static_cast<std::streamsize>(bytes.size())) {
    throw InputError(file.string(), "cannot be read to its end");
  }
  return bytes;
}

}  // namespace cellcut
