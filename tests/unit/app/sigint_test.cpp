/// SIGINT against the program itself, at moments that nothing in it knows of.
#include "app/command_line.h"
#include "renderer/base/image_io.h"
#include "renderer/base/rng.h"
#include "renderer/scene/recipes/recipe.h"
#include "tests/support/depth.h"
#include "tests/support/nightly.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_directory.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

/// Large enough for the writing of an EXR to be a tenth of the run.
constexpr glm::ivec2 kSize(320, 180);

fs::path writeScene(const fs::path& file, std::size_t lights) {
  writeFileAtomically(file, generateRecipe(Recipe::kKinds, lights, 1));
  return file;
}

std::vector<std::string> renderArguments(const fs::path& scene, const fs::path& picture, const fs::path& report) {
  return {"render", scene.string(), "-o", picture.string(), "--size", "320x180",  "--spp",
          "2",      "--max-depth",  "1",  "--seed",         "1",      "--report", report.string()};
}

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Decodes all of it; what is damaged or cut throws.
glm::ivec2 sizeOfWholePicture(const fs::path& file) {
  if (file.extension() != ".png") {
    const ImageRgb image = readImage(file);
    return {image.width(), image.height()};
  }
  const ImageRgba8 image = decodeImage8(readFile(file, 1 << 24), file.string());
  return {image.width(), image.height()};
}

/// 300 times at night.
class SigintAtAnyMoment : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    fs::create_directory(output_);
    writeScene(scene_, 8);
    const auto start = std::chrono::steady_clock::now();
    ProgramRun run(renderArguments(scene_, output_ / ("whole" + GetParam()), output_ / "report.json"), folder_.path());
    ASSERT_EQ(run.wait().code, kDone) << run.err();
    undisturbed_ = std::chrono::steady_clock::now() - start;
    fs::remove_all(output_);
  }

  using ProgramRun = test::ProgramRun;
  test::TemporaryDirectory folder_;
  fs::path scene_ = folder_ / "kinds.glb";
  fs::path output_ = folder_ / "output";
  Seconds undisturbed_{};
};

TEST_P(SigintAtAnyMoment, LeavesAWholePictureOrNone) {
  const std::string name = "picture" + GetParam();
  const fs::path picture = output_ / name, report = output_ / "report.json";
  Rng random(2016);
  const int runs = test::isSixteenth() ? 4 : isNightly() ? 100 : 10;
  int whole = 0, killed = 0;
  for (int i = 0; i < runs; ++i) {
    fs::create_directory(output_);
    ProgramRun run(renderArguments(scene_, picture, report), folder_.path());
    // A little past the end, for the moments after the last one that matters.
    std::this_thread::sleep_for(undisturbed_ * (1.1 * random.uniformDouble()));
    run.send(SIGINT);
    const test::ProgramEnd end = run.wait();
    const std::string what = "run " + std::to_string(i) + ": " + run.err();
    // Before the handler is there and after it is gone the signal ends the program as it would any other.
    EXPECT_TRUE(end.signal == 0 || end.signal == SIGINT) << what;
    EXPECT_TRUE(end.code == kDone || end.code == kFailed) << what;
    const std::set<std::string> names = namesIn(output_);
    // The report is written after the picture.
    EXPECT_THAT(names, testing::AnyOf(testing::IsEmpty(), testing::ElementsAre(name),
                                      testing::ElementsAre(name, "report.json")))
        << what;
    const bool exists = names.contains(name);
    whole += exists;
    killed += end.signal != 0;
    if (end.signal == 0) {
      EXPECT_EQ(exists, end.code == kDone) << what;
      EXPECT_EQ(exists, names.contains("report.json")) << what;
    }
    if (names.contains("report.json")) {
      std::ifstream file(report);
      EXPECT_TRUE(nlohmann::json::accept(file)) << what;
    }
    if (exists) {
      EXPECT_EQ(sizeOfWholePicture(picture), kSize) << what;
    }
    fs::remove_all(output_);
  }
  RecordProperty("whole", whole);
  RecordProperty("killed", killed);
}

INSTANTIATE_TEST_SUITE_P(All, SigintAtAnyMoment, testing::Values(".exr", ".pfm", ".png"),
                         [](const auto& ending) { return ending.param.substr(1); });

TEST(Sigint, SecondOneQuitsAtOnce) {
  using namespace std::chrono_literals;
  const test::TemporaryDirectory folder;
  const fs::path output = folder / "output";
  fs::create_directory(output);
  // Half a second of loading and building, so that the second signal comes before the first is obeyed.
  const fs::path scene = writeScene(folder / "kinds.glb", 20'000);
  test::ProgramRun run(renderArguments(scene, output / "picture.exr", output / "report.json"), folder.path());
  while (run.runs() && !run.handles(SIGINT)) std::this_thread::sleep_for(0.1ms);
  run.send(SIGINT);
  while (run.runs() && run.err().empty()) std::this_thread::sleep_for(0.1ms);
  run.send(SIGINT);
  const test::ProgramEnd end = run.wait();
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.code, kFailed);
  EXPECT_THAT(run.err(), testing::EndsWith("once more to quit without writing\n"));  // nothing was said afterwards
  EXPECT_TRUE(fs::is_empty(output));
}

}  // namespace
}  // namespace cellcut
