#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "tests/support/bytes.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"
#include "tests/support/temporary_directory.h"

#include <atomic>
#include <string_view>
#include <sys/stat.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// What readFile says against a file.
std::string readingRefusal(const fs::path& file, std::uintmax_t maxBytes = 1000) {
  return refusalOf([&] { readFile(file, maxBytes); });
}

TEST(FileIo, WritesWhatItReads) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("first"));
  EXPECT_EQ(contentOf(folder / "a"), "first");
  writeFileAtomically(folder / "a", bytesOf("2"));
  EXPECT_EQ(contentOf(folder / "a"), "2");
  EXPECT_EQ(folder.fileCount(), 1u);
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
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(FileIo, RefusesToWriteIntoReadOnlyDirectory) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("old"));
  fs::permissions(folder.path(), fs::perms(0555));
  {
    const test::OrdinaryUser user;
    EXPECT_THROW(writeFileAtomically(folder / "a", bytesOf("new")), InputError);
  }
  EXPECT_EQ(contentOf(folder / "a"), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(FileIo, OldFileStaysWhenTheDiskIsFull) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("old"));
  const std::vector<std::byte> large(1 << 20);
  {
    const test::FileSizeLimit limit(1 << 16);
    EXPECT_THROW(writeFileAtomically(folder / "a", large), InputError);
  }
  EXPECT_EQ(contentOf(folder / "a"), "old");
  EXPECT_EQ(folder.fileCount(), 1u) << "the half-written file is still there";
}

TEST(FileIo, AsLongANameAsThereIsIsWritten) {
  const test::TemporaryDirectory folder;
  const std::string longest(255, 'a');
  writeFileAtomically(folder / longest, bytesOf("x"));
  EXPECT_EQ(contentOf(folder / longest), "x");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(FileIo, WhatIsWrittenIsWhereLinksLead) {
  const test::TemporaryDirectory folder;
  fs::create_symlink("below/../file", folder / "link");
  EXPECT_EQ(writtenFile(folder / "link"), folder / "below/../file");
  EXPECT_EQ(writtenFile(folder / "file"), folder / "file");
  EXPECT_THROW(writtenFile("/dev/null"), InputError);
  EXPECT_THROW(writtenFile(folder.path()), InputError);
}

TEST(FileIo, AMissingFileIsRefused) {
  const test::TemporaryDirectory folder;
  EXPECT_THAT(readingRefusal(folder / "missing"), HasSubstr("missing: does not exist; check"));
  writeFileAtomically(folder / "a", {});
  EXPECT_THAT(readingRefusal(folder / "a" / "below"), HasSubstr("does not exist"));
}

TEST(FileIo, ALinkThatLeadsNowhereIsRefused) {
  const test::TemporaryDirectory folder;
  fs::create_symlink(folder / "gone", folder / "link");
  EXPECT_THAT(readingRefusal(folder / "link"), HasSubstr("link: is a link to a file that does not exist; put"));
  fs::create_symlink(folder / "self", folder / "self");
  EXPECT_THAT(readingRefusal(folder / "self"), HasSubstr("self: cannot be opened ("));
}

TEST(FileIo, AFolderIsRefused) {
  const test::TemporaryDirectory folder;
  EXPECT_THAT(readingRefusal(folder.path()), HasSubstr("is a folder; name"));
}

TEST(FileIo, AFifoIsRefused) {
  const test::TemporaryDirectory folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const test::HostileBudget budget("pipe");  // nobody ever writes into it
  EXPECT_THAT(readingRefusal(folder / "pipe"), HasSubstr("pipe: is no regular file but a pipe or a device; copy"));
}

TEST(FileIo, ADeviceIsRefused) {
  for (const char* device : {"/dev/zero", "/dev/null"})
    EXPECT_THAT(readingRefusal(device), HasSubstr("a device; copy"));
}

TEST(FileIo, AFileThatMayNotBeReadIsRefused) {
  const test::TemporaryDirectory folder;
  fs::permissions(folder.path(), fs::perms::all);
  writeFileAtomically(folder / "a", bytesOf("secret"));
  fs::permissions(folder / "a", fs::perms::none);
  const test::OrdinaryUser user;
  EXPECT_THAT(readingRefusal(folder / "a"), HasSubstr("a: cannot be opened (Permission denied); change"));
}

TEST(FileIo, AFileInAFolderThatMayNotBeReadIsNotCalledMissing) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("secret"));
  fs::permissions(folder.path(), fs::perms::none);
  {
    const test::OrdinaryUser user;
    EXPECT_THAT(readingRefusal(folder / "a"), HasSubstr("a: cannot be opened (Permission denied); change"));
  }
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(FileIo, AGiantIsRefusedByItsSize) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", {});
  fs::resize_file(folder / "a", std::uintmax_t{10} << 30);
  const test::HostileBudget budget("10 GB");
  EXPECT_THAT(readingRefusal(folder / "a", std::uintmax_t{1} << 32),
              HasSubstr("a: has 10737418240 bytes, more than the limit of 4294967296; make"));
}

TEST(FileIo, AFileThatComesAndGoesIsReadWholeOrRefused) {
  const test::TemporaryDirectory folder;
  const std::vector<std::byte> content(1 << 16, std::byte{7});
  std::atomic<bool> done = false;
  std::thread other([&] {
    while (!done) {
      writeFileAtomically(folder / "a", content);
      fs::remove(folder / "a");
    }
  });
  int whole = 0, refused = 0;
  while (whole < 20 || refused < 20) {
    try {
      EXPECT_TRUE(readFile(folder / "a", content.size()) == content);
      ++whole;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("a: does not exist"));
      ++refused;
    }
  }
  done = true;
  other.join();
}

TEST(FileIo, RefusesToReadLargerFileThanAllowed) {
  const test::TemporaryDirectory folder;
  writeFileAtomically(folder / "a", bytesOf("12345"));
  EXPECT_EQ(readFile(folder / "a", 5).size(), 5u);
  EXPECT_THAT(readingRefusal(folder / "a", 4), HasSubstr("a: has 5 bytes, more than the limit of 4; make"));
}

}  // namespace
}  // namespace cellcut::test
