#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "tests/support/temporary_directory.h"

#include <csignal>
#include <cstring>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;
using test::TemporaryDirectory;

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string contentOf(const fs::path& file) {
  const std::vector<std::byte> bytes = readFile(file, 1000);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Files may not grow past a limit while it lives, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    previousHandler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limit{bytes, previous_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previousHandler_);
  }

 private:
  rlimit previous_{};
  void (*previousHandler_)(int) = SIG_DFL;
};

TEST(FileIo, WritesWhatItReads) {
  const TemporaryDirectory directory;
  writeFileAtomically(directory / "a", bytesOf("first"));
  EXPECT_EQ(contentOf(directory / "a"), "first");
  writeFileAtomically(directory / "a", bytesOf("2"));
  EXPECT_EQ(contentOf(directory / "a"), "2");
  EXPECT_EQ(directory.fileCount(), 1u);
}

TEST(FileIo, WritesAndReadsEmptyFiles) {
  const TemporaryDirectory directory;
  writeFileAtomically(directory / "a", {});
  EXPECT_EQ(contentOf(directory / "a"), "");
}

TEST(FileIo, RefusesToWriteIntoMissingDirectory) {
  const TemporaryDirectory directory;
  EXPECT_THROW(writeFileAtomically(directory / "missing" / "a", bytesOf("x")), InputError);
}

TEST(FileIo, RefusesToReplaceDirectory) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "a");
  EXPECT_THROW(writeFileAtomically(directory / "a", bytesOf("x")), InputError);
  EXPECT_EQ(directory.fileCount(), 1u);
}

TEST(FileIo, RefusesToWriteIntoReadOnlyDirectory) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryDirectory directory;
  writeFileAtomically(directory / "a", bytesOf("old"));
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(writeFileAtomically(directory / "a", bytesOf("new")), InputError);
  EXPECT_EQ(contentOf(directory / "a"), "old");
}

TEST(FileIo, OldFileStaysWhenTheDiskIsFull) {
  const TemporaryDirectory directory;
  writeFileAtomically(directory / "a", bytesOf("old"));
  const std::vector<std::byte> large(1 << 20);
  {
    const FileSizeLimit limit(1 << 16);
    EXPECT_THROW(writeFileAtomically(directory / "a", large), InputError);
  }
  EXPECT_EQ(contentOf(directory / "a"), "old");
  EXPECT_EQ(directory.fileCount(), 1u) << "the half-written file is still there";
}

TEST(FileIo, RefusesToReadWhatIsNoRegularFile) {
  const TemporaryDirectory directory;
  EXPECT_THROW(readFile(directory / "missing", 1000), InputError);
  EXPECT_THROW(readFile(directory.path(), 1000), InputError);
  EXPECT_THROW(readFile("/dev/zero", 1000), InputError);
}

TEST(FileIo, RefusesToReadLargerFileThanAllowed) {
  const TemporaryDirectory directory;
  writeFileAtomically(directory / "a", bytesOf("12345"));
  EXPECT_EQ(readFile(directory / "a", 5).size(), 5u);
  EXPECT_THROW(readFile(directory / "a", 4), InputError);
}

TEST(FileIo, ErrorsNameTheFile) {
  try {
    readFile("/missing/lamp.exr", 1000);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("/missing/lamp.exr: "));
  }
}

}  // namespace
}  // namespace cellcut
