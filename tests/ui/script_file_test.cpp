/// Scripts that are no files, and records that cannot be written.
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"
#include "tests/support/temporary_directory.h"
#include "ui/viewer/script.h"
#include "ui/viewer/script_recorder.h"

#include <fstream>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string scriptRefusal(const fs::path& file) {
  const test::HostileBudget budget(file.filename());
  return test::refusalOf([&] { readScript(file); });
}

TEST(ScriptFile, AFifoIsRefused) {
  const test::TemporaryDirectory folder;
  ASSERT_EQ(mkfifo((folder / "script.txt").c_str(), 0600), 0);
  EXPECT_THAT(scriptRefusal(folder / "script.txt"), HasSubstr("script.txt: is no regular file but a pipe"));
}

TEST(ScriptFile, ADeviceWithoutEndIsRefused) {
  EXPECT_THAT(scriptRefusal("/dev/zero"), HasSubstr("/dev/zero: is no regular file but a pipe or a device"));
}

TEST(ScriptFile, AFolderIsRefused) {
  const test::TemporaryDirectory folder;
  EXPECT_THAT(scriptRefusal(folder.path()), HasSubstr("is a folder; name"));
}

TEST(ScriptFile, MoreThanAMegabyteIsRefused) {
  const test::TemporaryDirectory folder;
  const std::string comment = "# nothing happens here\n";
  std::ofstream(folder / "script.txt") << comment;
  EXPECT_TRUE(readScript(folder / "script.txt").empty());
  fs::resize_file(folder / "script.txt", (std::uintmax_t{1} << 20) + 1);
  EXPECT_THAT(scriptRefusal(folder / "script.txt"), HasSubstr("script.txt: has 1048577 bytes, more than the limit"));
}

TEST(ScriptFile, WhatIsNoScriptIsRefusedInOneLineOfText) {
  const test::TemporaryDirectory folder;
  std::ofstream(folder / "script.txt") << std::string(3, '\0') + "\x1b[2J" + std::string(1000, 'x');
  EXPECT_THAT(scriptRefusal(folder / "script.txt"),
              testing::EndsWith("script.txt:1: no action '????[2J" + std::string(73, 'x') +
                                "…'; cellcut view --help lists them"));
}

TEST(ScriptRecorder, AFifoIsRefusedAndNotWaitedFor) {
  const test::TemporaryDirectory folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const test::HostileBudget budget("pipe");  // nobody ever reads it
  EXPECT_THAT(test::refusalOf([&] { ScriptRecorder(folder / "pipe"); }), HasSubstr("pipe: is no regular file"));
}

TEST(ScriptRecorder, WhatStandsInTheFileIsReadBack) {
  const test::TemporaryDirectory folder;
  ScriptRecorder recorder(folder / "record.txt");
  recorder.write({"set", "Max cut", "40"});
  recorder.write({"set", "Max cut", "41"});
  recorder.write({"key", "G"});
  recorder.finish();
  const std::vector<ScriptAction> actions = readScript(folder / "record.txt");
  ASSERT_EQ(actions.size(), 2u);
  EXPECT_THAT(actions[0].words, testing::ElementsAre("set", "Max cut", "41"));
  EXPECT_EQ(recorder.takeProblem(), "");
}

TEST(ScriptRecorder, AFullDiskIsSaidOnceAndAtItsEnd) {
  const test::TemporaryDirectory folder;
  ScriptRecorder recorder(folder / "record.txt");
  {
    const test::FileSizeLimit limit(fs::file_size(folder / "record.txt") + 3);
    recorder.write({"key", "G"});
    EXPECT_EQ(recorder.takeProblem(), "") << "the last line waits for the next";
    recorder.write({"key", "H"});
  }
  EXPECT_THAT(recorder.takeProblem(), HasSubstr("record.txt: not all that was done could be recorded; make room"));
  recorder.write({"key", "I"});
  recorder.write({"key", "J"});
  EXPECT_EQ(recorder.takeProblem(), "");
  EXPECT_THROW(recorder.finish(), std::runtime_error) << "a script with a hole is no script";
}

TEST(ScriptRecorder, ADiskThatIsFullAtItsBeginningIsRefused) {
  const test::TemporaryDirectory folder;
  const test::FileSizeLimit limit(10);
  try {
    const ScriptRecorder recorder(folder / "record.txt");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("record.txt: cannot be written; make room"));
  }
}

}  // namespace
}  // namespace cellcut
