/// Names that nothing can be written under, and those of links.
#include "app/output.h"

#include "renderer/base/image_io.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

#include <string>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string refusal(const fs::path& file) {
  return refusalOf([&] { requireWritable(file); });
}

class OutputTest : public testing::Test {
 protected:
  const TemporaryDirectory folder_;
};

TEST_F(OutputTest, WhatIsNoFileIsRefused) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder_ / "link");
  for (const fs::path& file : {folder_ / "pipe", folder_ / "link", fs::path("/dev/null")}) {
    EXPECT_THAT(refusal(file), HasSubstr(file.string() + ": is no regular file but a pipe or a device"));
    EXPECT_THROW(writeText(file, "text"), std::runtime_error);
  }
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
}

TEST_F(OutputTest, ALinkStaysAndItsFileIsWritten) {
  fs::create_directory(folder_ / "below");
  writeFile(folder_ / "below" / "file", "old");
  fs::create_symlink("below/file", folder_ / "first");
  fs::create_symlink(folder_ / "first", folder_ / "second");
  fs::create_symlink("new", folder_ / "dangling");
  for (const char* name : {"second", "dangling"}) {
    requireWritable(folder_ / name);
    writeText(folder_ / name, name);
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
  EXPECT_EQ(contentOf(folder_ / "below" / "file"), "second");
  EXPECT_EQ(contentOf(folder_ / "new"), "dangling");
  writePicture({folder_ / "second", PictureKind::kPfm}, ImageRgb(1, 1));
  EXPECT_TRUE(fs::is_symlink(folder_ / "second"));
  EXPECT_EQ(readImage(writeFile(folder_ / "copy.pfm", contentOf(folder_ / "first"))).size(), 1u);
}

TEST_F(OutputTest, ALinkThatLeadsNowhereIsRefused) {
  fs::create_symlink("self", folder_ / "self");
  EXPECT_THAT(refusal(folder_ / "self"), HasSubstr("self: cannot be written ("));
  fs::create_symlink("gone/file", folder_ / "link");
  EXPECT_THAT(refusal(folder_ / "link"), HasSubstr("gone/file: its folder does not exist"));
}

TEST_F(OutputTest, ANameIsAsLongAsTheSystemTakesIt) {
  const fs::path longest = folder_ / std::string(255, 'a');
  requireWritable(longest);
  writeText(longest, "text");
  EXPECT_EQ(contentOf(longest), "text");
  EXPECT_THAT(refusal(longest.string() + "a"), HasSubstr("a: cannot be written (File name too long); choose"));
}

TEST_F(OutputTest, TheSameFileTwiceIsRefused) {
  const fs::path scene = writeFile(folder_ / "scene.gltf", "scene"), picture = folder_ / "a.png";
  fs::create_symlink("scene.gltf", folder_ / "link");
  fs::create_symlink("a.png", folder_ / "dangling");
  const auto refused = [&](const fs::path& report) {
    return refusalOf([&] {
      requireDistinct({{"--output", picture}, {"--report", report}}, {{"SCENE", scene}, {"--environment", ""}});
    });
  };
  for (const fs::path& report : {scene, folder_ / "." / "scene.gltf", folder_ / "link"}) {
    EXPECT_EQ(refused(report),
              "--report: '" + report.string() + "' is the file of SCENE too and would replace it; name another");
  }
  for (const fs::path& report : {picture, folder_ / "no" / ".." / "a.png", folder_ / "dangling"}) {
    EXPECT_THAT(refused(report), HasSubstr("is the file of --output too"));
  }
  for (const fs::path& report : {folder_ / "r.json", fs::path("a.png"), fs::path()}) {
    EXPECT_EQ(refused(report), "was not refused");
  }
  EXPECT_THAT(refusalOf([] {
                requireDistinct({{"-o", "not-there"}, {"--report", "./not-there"}}, {});
              }),
              HasSubstr("is the file of -o too"));
}

}  // namespace
}  // namespace cellcut::test
