// readFile, writtenFile, writeFileAtomically and lowerExtension of image_io.h.
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
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
      // Not the target's name with more behind it: that may be as long as names can be.
      path_ = target.parent_path() / (".cellcut-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp");
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

/// A file that is opened first and looked at then, so that it is the same one all the while, whatever its name stands
/// for by now.
class OpenFile {
 public:
  /// \throws InputError
  explicit OpenFile(const fs::path& file) : file_(file) {
    // Without O_NONBLOCK a pipe is waited for until somebody writes into it.
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) refuseOpening(errno);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { ::close(descriptor_); }

  /// \throws InputError if it is no regular file or larger than that
  std::size_t size(std::uintmax_t maxBytes) const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) refuse("cannot be read (" + describe(errno) + "); copy it again");
    if (S_ISDIR(status.st_mode)) refuse("is a folder; name a file in it");
    if (!S_ISREG(status.st_mode)) refuse("is no regular file but a pipe or a device; copy what it holds into a file");
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    if (size > maxBytes) {
      refuse("has " + std::to_string(size) + " bytes, more than the limit of " + std::to_string(maxBytes) +
             "; make it smaller");
    }
    return static_cast<std::size_t>(size);
  }

  /// \throws InputError if it has fewer bytes by now
  void read(std::span<std::byte> bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) refuse("cannot be read to its end (" + describe(errno) + "); copy it again");
      if (count == 0) refuse("became shorter while it was read; try again when it is whole");
      done += static_cast<std::size_t>(count);
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const { throw InputError(file_.string(), problem); }

  [[noreturn]] void refuseOpening(int error) const {
    std::error_code ignored;
    if (error == ENOENT && fs::is_symlink(fs::symlink_status(file_, ignored))) {
      refuse("is a link to a file that does not exist; put the file itself there");
    }
    if (error == ENOENT || error == ENOTDIR) refuse("does not exist; check its name and folder");
    if (error == EACCES)
      refuse("cannot be opened (" + describe(error) + "); change its permissions or those of its folder");
    refuse("cannot be opened (" + describe(error) + ")");
  }

  fs::path file_;
  int descriptor_ = -1;
};

}  // namespace

fs::path writtenFile(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);  // of what links lead to
  if (status.type() == fs::file_type::none) refuseWriting(file, error.value());
  if (fs::is_directory(status)) throw InputError(file.string(), "is a folder; name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(file.string(), "is no regular file but a pipe or a device, which would be replaced; name a file");
  }
  fs::path written = file;
  while (fs::is_symlink(fs::symlink_status(written, error))) {
    written = written.parent_path() / fs::read_symlink(written, error);
  }
  return written;
}

void writeFileAtomically(const fs::path& file, std::span<const std::byte> bytes) {
  TemporaryFile temporary(file);
  temporary.write(bytes);
  temporary.rename();
}

std::vector<std::byte> readFile(const fs::path& file, std::uintmax_t maxBytes) {
  const OpenFile open(file);
  const std::size_t size = open.size(maxBytes);
  std::vector<std::byte> bytes(size);
  open.read(bytes);
  return bytes;
}

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace cellcut
