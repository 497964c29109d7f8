/// The program itself on a machine without memory, room on its disk or many cores.
#include "app/command_line.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/recipes/recipe.h"
#include "tests/support/depth.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_directory.h"

#include <map>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using testing::HasSubstr;

/// Shell commands with which no file grows past so many times 512 bytes, the standard error stream's neither.
std::string fullDisk(int blocks) {
  return "trap '' XFSZ; ulimit -f " + std::to_string(blocks);
}

/// All files below a folder with what is in them.
std::map<fs::path, std::vector<std::byte>> contentsOf(const fs::path& folder) {
  std::map<fs::path, std::vector<std::byte>> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) contents[entry.path()] = readFile(entry.path(), 1 << 24);
  }
  return contents;
}

std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(text.find_last_of('\n', end) + 1);
}

class FullDisk : public testing::Test {
 protected:
  FullDisk() {
    fs::create_directory(output);
    writeFileAtomically(scene, generateRecipe(Recipe::kKinds, 8, 1));
  }
  /// Runs it on a full disk and expects that it fails, names `file` and changes nothing in the output's folder but
  /// `changed`.
  void expectRefusal(const std::vector<std::string>& arguments, const std::string& before, const fs::path& file,
                     const fs::path& changed = {}) const {
    auto old = contentsOf(output);
    ProgramRun run(arguments, folder.path(), before);
    const test::ProgramEnd end = run.wait();
    EXPECT_EQ(end.signal, 0);
    EXPECT_EQ(end.code, kFailed);
    EXPECT_THAT(run.err(), HasSubstr("cellcut: " + file.string() +
                                     ": cannot be written (File too large); choose another place\n"));
    auto now = contentsOf(output);
    if (!changed.empty()) {
      EXPECT_NE(old[changed], now[changed]);
    }
    old.erase(changed);
    now.erase(changed);
    EXPECT_EQ(old, now);
  }
  test::TemporaryDirectory folder;
  fs::path output = folder / "output";
  fs::path scene = folder / "kinds.glb";
};

TEST_F(FullDisk, RenderNamesThePictureAndKeepsTheOldOne) {
  for (const char* kind : {".exr", ".pfm", ".png"}) {
    const fs::path picture = test::writeFile(output / ("old" + std::string(kind)), "old");
    expectRefusal({"render", scene.string(), "-o", picture.string(), "--size", "96x54", "--spp", "1"}, fullDisk(4),
                  picture);
  }
}

TEST_F(FullDisk, RenderNamesTheReportAndKeepsTheOldOne) {
  const fs::path picture = test::writeFile(output / "small.png", "old"),
                 report = test::writeFile(output / "report.json", "old");
  expectRefusal(
      {"render", scene.string(), "-o", picture.string(), "--size", "8x8", "--spp", "1", "--report", report.string()},
      fullDisk(2), report, picture);
  EXPECT_EQ(decodeImage8(readFile(picture, 1000), "small.png").width(), 8);
}

TEST_F(FullDisk, MeasureKeepsTheResultsThatItHas) {
  const std::string cache = "export XDG_CACHE_HOME=" + (folder / "cache").string();
  const auto arguments = [&](const char* runs) {
    return std::vector<std::string>{
        "measure",  scene.string(), "-o", output.string(), "--size",           "24x16",           "--spp",
        "5",        "--max-depth",  "1",  "--strategies",  "cell-cut,uniform", "--reference-spp", "256",
        "--resume", "--runs",       runs};
  };
  ProgramRun first(arguments("1"), folder.path(), cache);
  ASSERT_EQ(first.wait().code, kDone) << first.err();
  expectRefusal(arguments("2"), cache + "; " + fullDisk(8), output / "results.json");
}

TEST_F(FullDisk, GenerateNamesTheSceneAndKeepsTheOldOne) {
  const fs::path old = test::writeFile(output / "old.glb", "old");
  expectRefusal({"generate", "rooms", "--lights", "20", "-o", old.string()}, fullDisk(4), old);
}

TEST_F(FullDisk, AResultThatCannotBePrintedFails) {
  const fs::path picture = output / "a.pfm";
  writePfm(picture, ImageRgb(1, 1, Vec3(1)));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", scene}, {"compare", picture, picture}, {"render", "--help"}}) {
    ProgramRun run(arguments, folder.path(), "exec >/dev/full");
    EXPECT_EQ(run.wait().code, kFailed);
    EXPECT_EQ(run.err(), "cellcut: standard output: cannot be written to its end; make room or send it elsewhere\n");
  }
}

#ifdef CELLCUT_UI
TEST_F(FullDisk, AViewerWhoseRecordLacksLinesFails) {
  std::string script;
  for (int i = 0; i < 100; ++i) script += i % 2 == 0 ? "key 2\n" : "key 3\n";
  const std::string played = test::writeFile(folder / "script.txt", script), record = output / "record.txt";
  ProgramRun run({"view", "--headless", "--script", played, "--record", record, "--size", "200x150", scene.string()},
                 folder.path(), fullDisk(1));
  EXPECT_EQ(run.wait().code, kFailed);
  EXPECT_EQ(lastLine(run.err()),
            "cellcut: " + record + ": not all that was done could be recorded; make room or choose another place\n");
}
#endif

TEST(FewCores, MoreThreadsAreUsedWithoutAWord) {
  const test::TemporaryDirectory folder;
  const fs::path scene = folder / "rooms.glb";
  writeFileAtomically(scene, generateRecipe(Recipe::kRooms, 200, 0));
  const std::string threads = std::to_string(std::thread::hardware_concurrency() + 6);
  const std::string picture = folder / "a.pfm";
  ProgramRun run({"render", scene, "-o", picture, "--size", "64x36", "--spp", "2", "--threads", threads},
                 folder.path());
  EXPECT_EQ(run.wait().code, kDone);
  EXPECT_THAT(run.err(), testing::Not(HasSubstr("TBB")));
}

constexpr int kNotStarted = 127;  // its libraries do not fit

TEST(NoMemory, IsSaidAsSoonAsTheLibrariesAreLoaded) {
  if (test::isSanitized()) GTEST_SKIP() << "a sanitizer's shadow memory takes terabytes";
  const test::TemporaryDirectory folder;
  const auto endWith = [&](int kilobytes, std::string& said) {
    ProgramRun run({"--version"}, folder.path(), "ulimit -v " + std::to_string(kilobytes));
    const test::ProgramEnd end = run.wait();
    said = run.err();
    return end;
  };
  std::string said;
  int tooLittle = 8'000, enough = 1'000'000;
  while (enough - tooLittle > 4) {
    const int middle = (tooLittle + enough) / 2;
    (endWith(middle, said).code == kNotStarted ? tooLittle : enough) = middle;
  }
  // The linker of glibc 2.41 itself ends by a signal where there is no page left for it (4 kB).
  for (int more = 32; more < 16'384; more += more < 512 ? 16 : 256) {
    const test::ProgramEnd end = endWith(enough + more, said);
    EXPECT_EQ(end.signal, 0) << more << " kB: " << said;
    // The linker may do with less and not with more, by where things come to lie.
    if (end.code == kDone || end.code == kNotStarted) continue;
    EXPECT_EQ(end.code, kFailed);
    EXPECT_THAT(said, testing::StartsWith("cellcut: not enough memory")) << more << " kB";
  }
}

TEST(NoMemory, IsSaidHoweverLittleThereIs) {
  if (test::isSanitized()) GTEST_SKIP() << "a sanitizer's shadow memory takes terabytes";
  const test::TemporaryDirectory folder;
  const fs::path scene = folder / "rooms.glb";
  writeFileAtomically(scene, generateRecipe(Recipe::kRooms, 20'000, 0));
  const std::vector<std::string> arguments{
      "render", scene.string(), "-o", (folder / "a.pfm").string(), "--size", "64x36", "--spp", "1", "--max-depth", "1"};
  std::set<std::string> refusals;
  int code = kFailed;
  for (double kilobytes = 32'000; code != kDone && kilobytes < 1e8; kilobytes *= 1.1) {
    ProgramRun run(arguments, folder.path(), "ulimit -v " + std::to_string(std::llround(kilobytes)));
    const test::ProgramEnd end = run.wait();
    EXPECT_EQ(end.signal, 0) << kilobytes << " kB: " << run.err();
    code = end.code;
    if (code == kDone || code == kNotStarted) continue;
    EXPECT_EQ(fs::exists(folder / "a.pfm"), false);
    refusals.insert(std::to_string(code) + " " + lastLine(run.err()));
  }
  EXPECT_EQ(code, kDone);
  EXPECT_THAT(refusals,
              testing::ElementsAre(
                  "1 cellcut: not enough memory; a smaller --size or a scene with fewer triangles needs less\n",
                  "2 cellcut: " + scene.string() +
                      ": does not fit into memory; fewer triangles or smaller textures need less\n"));
}

}  // namespace
}  // namespace cellcut
