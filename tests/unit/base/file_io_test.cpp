#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "tests/support/temporary_directory.h"

#include <csignal>
#include <iterator>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string contentOf(const fs::path& file) {
  const std::vector<std::byte> bytes = readFile(file, 1000);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::ptrdiff_t fileCount(const test::TemporaryDirectory& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
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
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("first"));
  EXPECT_EQ(contentOf(folder / "a"), "first");
  writeFileAtomically(folder / "a", bytesOf("2"));
  EXPECT_EQ(contentOf(folder / "a"), "2");
  EXPECT_EQ(fileCount(folder), 1);
}

TEST(FileIo, WritesAndReadsEmptyFiles) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", {});
  EXPECT_EQ(contentOf(folder / "a"), "");
}

TEST(FileIo, RefusesToWriteIntoMissingDirectory) {
  const test::TemporaryDirectory folder;
  EXPECT_THROW(writeFileAtomically(folder / "missing" / "a", bytesOf("x")), InputError);
}

TEST(FileIo, RefusesToReplaceDirectory) {
  const test::TemporaryDirectory folder;
  fs::create_directory(folder / "a");
  EXPECT_THROW(writeFileAtomically(folder / "a", bytesOf("x")), InputError);
  EXPECT_EQ(fileCount(folder), 1);
}

TEST(FileIo, RefusesToWriteIntoReadOnlyDirectory) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("old"));
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(writeFileAtomically(folder / "a", bytesOf("new")), InputError);
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(contentOf(folder / "a"), "old");
}

TEST(FileIo, OldFileStaysWhenTheDiskIsFull) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("old"));
  const std::vector<std::byte> large(1 << 20);
  {
    const FileSizeLimit limit(1 << 16);
    EXPECT_THROW(writeFileAtomically(folder / "a", large), InputError);
  }
  EXPECT_EQ(contentOf(folder / "a"), "old");
  EXPECT_EQ(fileCount(folder), 1) << "the half-written file is still there";
}

TEST(FileIo, RefusesToReadWhatIsNoRegularFile) {
  const test::TemporaryDirectory folder;
  EXPECT_THROW(readFile(folder / "missing", 1000), InputError);
  EXPECT_THROW(readFile(folder.path(), 1000), InputError);
  EXPECT_THROW(readFile("/dev/zero", 1000), InputError);
}

TEST(FileIo, RefusesToReadLargerFileThanAllowed) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("12345"));
  EXPECT_EQ(readFile(folder / "a", 5).size(), 5u);
  EXPECT_THROW(readFile(folder / "a", 4), InputError);
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
