#include "app/command_line.h"

#include "app/console.h"
#include "renderer/base/image_io.h"
#include "renderer/sampling/sampler_settings.h"
#include "renderer/sampling/strategy.h"
#include "renderer/scene/recipes/recipe.h"
#include "tests/support/command_run.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/temporary_directory.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Bad input as a script sees it: 2, nothing on the standard output, one line that says why.
void expectRefused(const std::vector<std::string>& arguments, const std::string& reason) {
  const Outcome outcome = runCommand(arguments);
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr(reason));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

/// Verbs of this build: those of the viewer come with its packages.
std::vector<std::string> allVerbs() {
#ifdef CELLCUT_UI
  return {"view", "screenshot", "render", "measure", "compare", "generate", "info"};
#else
  return {"render", "measure", "compare", "generate", "info"};
#endif
}

#ifndef CELLCUT_UI  // else it opens the viewer
TEST(CommandLine, WithoutVerbShowsHelpAndIsBadUsage) {
  const Outcome outcome = runCommand({});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.out, IsEmpty());
  for (const char* verb : {"render", "measure", "compare", "generate", "info"})
    EXPECT_THAT(outcome.err, HasSubstr(verb));
}
#endif

TEST(CommandLine, HelpOfEveryVerbHasAnExample) {
  for (const std::string& verb : allVerbs()) {
    const Outcome outcome = runCommand({verb, "--help"});
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_THAT(outcome.out, HasSubstr("\n  cellcut " + verb + " "));
    EXPECT_THAT(outcome.err, IsEmpty());
  }
}

TEST(CommandLine, HelpFitsTheWidthOfATerminal) {
  for (const std::string& verb : allVerbs()) {
    std::istringstream help(runCommand({verb, "--help"}).out);
    for (std::string line; std::getline(help, line);) {
      EXPECT_LE(line.size(), 120u) << line;  // the column limit of our sources
    }
  }
}

TEST(CommandLine, VersionIsPrinted) {
  const Outcome outcome = runCommand({"--version"});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_THAT(outcome.out, testing::StartsWith("cellcut "));
}

TEST(CommandLine, BadUsageIsOneLine) {
  expectRefused({"rendre"}, "rendre");
  expectRefused({"info"}, "SCENE is required");
  expectRefused({"compare", "a.exr"}, "B is required");
  expectRefused({"render", "a.glb"}, "--output is required");
  expectRefused({"render", "a.glb", "-o", "a.png", "--spp", "1", "--time", "1"}, "excludes");
  expectRefused({"render", "a.glb", "-o", "a.png", "--spp", "1x"}, "--spp: '1x'");
  expectRefused({"render", "a.glb", "-o", "a.png", "--frobnicate", "2", "--quux"},
                "not expected: --frobnicate 2 --quux; see");
  expectRefused({"generate", "castle", "--lights", "1", "-o", "a.glb"}, "rooms, street, hall, kinds");
  expectRefused({"generate", "rooms", "--lights", "-1", "-o", "a.glb"}, "--lights: '-1'");
  expectRefused({"generate", "rooms", "--lights", "1", "-o", "a.gltf"}, ".glb");
}

TEST(CommandLine, FilesThatAreNotThereAreBadInput) {
  const test::TemporaryDirectory folder;
  expectRefused({"info", (folder / "no.glb").string()}, "no.glb");
  expectRefused({"compare", (folder / "no.exr").string(), (folder / "no.exr").string()}, "no.exr");
  expectRefused({"render", (folder / "no.glb").string(), "-o", (folder / "a.png").string()}, "no.glb");
}

TEST(CommandLine, NoTextCommandsTheTerminal) {
  const Outcome outcome = runCommand({"info", "no\x1b[2J\n.glb"});
  EXPECT_THAT(outcome.err, testing::StartsWith("cellcut: no?[2J .glb: does not exist"));
  std::ostringstream err;
  Console{err, err}.warn("a\x1b[2Jb\nc");
  EXPECT_EQ(err.str(), "cellcut: warning: a?[2Jb?c\n");
}

TEST(CommandLine, PicturesOfDifferentSizesDoNotCompare) {
  const test::TemporaryDirectory folder;
  writePfm(folder / "a.pfm", ImageRgb(2, 3));
  writePfm(folder / "b.pfm", ImageRgb(3, 2));
  expectRefused({"compare", (folder / "a.pfm").string(), (folder / "b.pfm").string()}, "2x3");
}

TEST(CommandLine, CompareReportsTheDifference) {
  const test::TemporaryDirectory folder;
  writePfm(folder / "a.pfm", ImageRgb(8, 8, Vec3(3)));
  writePfm(folder / "b.pfm", ImageRgb(8, 8, Vec3(2)));
  const Outcome outcome = runCommand({"compare", (folder / "a.pfm").string(), (folder / "b.pfm").string()});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  // The same sums as in the definition, on numbers that a double holds: only the order of a few operations may differ.
  EXPECT_DOUBLE_EQ(json.at("mse"), 1);
  EXPECT_DOUBLE_EQ(json.at("epsilon"), 0.04);
  EXPECT_DOUBLE_EQ(json.at("relmse"), 1 / 4.04);
  EXPECT_DOUBLE_EQ(json.at("mean_a"), 3);
  EXPECT_DOUBLE_EQ(json.at("mean_b"), 2);
  EXPECT_DOUBLE_EQ(json.at("max_abs"), 1);
  EXPECT_DOUBLE_EQ(json.at("smape"), 1 / 5.02);
  EXPECT_GT(json.at("flip"), 0);
  EXPECT_GT(json.at("flip_ldr"), 0);
}

TEST(CommandLine, HelpHasBelowWhatItSaysIsBelow) {
  for (const std::string& verb : allVerbs()) {
    const std::string help = runCommand({verb, "--help"}).out;
    const std::vector<std::pair<std::string, std::string>> explained{{"--strateg", "\nStrategies:\n"},
                                                                     {"--quality", "\nQualities:\n"},
                                                                     {"--noise", "\nNoise: "},
                                                                     {"--punctual-scale", "\nBlender's exporter "}};
    for (const auto& [option, explanation] : explained) {
      EXPECT_EQ(help.find(option) != std::string::npos, help.find(explanation) != std::string::npos) << verb << option;
    }
  }
}

/// Every --word in a text.
std::set<std::string> optionsIn(const std::string& text) {
  std::set<std::string> options;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t dashes = word.find("--");
    if (dashes == std::string::npos) continue;
    const std::size_t end = word.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", dashes);
    options.insert(word.substr(dashes, end == std::string::npos ? end : end - dashes));
  }
  return options;
}

/// What bash offers in a folder behind `cellcut WORDS`, the last of which is begun.
std::string completionOf(const std::string& words, const std::filesystem::path& folder = "/") {
  const std::string command = "bash -c 'cd \"" + folder.string() +
                              "\"; source \"" CELLCUT_ASSETS "/completions/cellcut.bash\"; COMP_WORDS=(cellcut " +
                              words +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                              "_cellcut; echo ${COMPREPLY[*]}'";
  std::FILE* const bash = popen(command.c_str(), "r");
  std::string offered;
  for (int c; bash && (c = std::fgetc(bash)) != EOF;) offered += static_cast<char>(c);
  if (bash) pclose(bash);
  return offered;
}

TEST(CommandLine, CompletionKnowsEveryOptionAndName) {
  std::ifstream file(CELLCUT_ASSETS "/completions/cellcut.bash");
  const std::string script(std::istreambuf_iterator<char>(file), {});
  for (const StrategyName& s : kStrategies) EXPECT_THAT(script, HasSubstr(std::string(s.name)));
  for (const Quality& q : kQualities) EXPECT_THAT(script, HasSubstr(std::string(q.name)));
  EXPECT_THAT(script, HasSubstr("preview balanced accurate auto"));
  for (const RecipeName& r : kRecipes) EXPECT_THAT(script, HasSubstr(std::string(r.name)));
  for (const std::string& verb : allVerbs()) {
    EXPECT_THAT(script, HasSubstr("_cellcut_words 'view screenshot render measure compare generate info"));
    EXPECT_EQ(optionsIn(completionOf(verb + " file --")), optionsIn(runCommand({verb, "--help"}).out)) << verb;
  }
#ifdef CELLCUT_UI
  for (const std::string before : {"room.glb", "--headless", ""}) {
    std::set<std::string> offered = optionsIn(completionOf(before + " --"));
    EXPECT_EQ(offered.erase("--version"), before.empty()) << "of the program, not of a verb";
    EXPECT_EQ(offered, optionsIn(runCommand({"view", "--help"}).out)) << before;
  }
#endif
}

#ifdef CELLCUT_UI
TEST(CommandLine, CompletionOffersScenesAndFoldersWhereNoVerbIsBegun) {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directory(folder / "renderer");
  writeFile(folder / "room.glb", "");
  writeFile(folder / "room.txt", "");
  EXPECT_EQ(completionOf("ro", folder.path()), "room.glb\n");
  EXPECT_EQ(completionOf("rend", folder.path()), "render\n") << "not the folder";
  EXPECT_EQ(completionOf("renderer", folder.path()), "renderer\n");
}
#endif

/// Verbs that work on a small scene of all five kinds of light.
class VerbsOnAScene : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome = runCommand({"generate", "kinds", "--lights", "8", "--seed", "3", "-o", path("kinds.glb")});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Outcome render(const std::string& picture, const std::vector<std::string>& more, std::ostream* err = nullptr,
                 bool terminal = false) {
    std::vector<std::string> args{"render", path("kinds.glb"), "-o", path(picture), "--size", "32x18"};
    args.insert(args.end(), more.begin(), more.end());
    return runCommand(args, err, terminal);
  }
  nlohmann::json report() const {
    std::ifstream file(path("report.json"));
    return nlohmann::json::parse(file);
  }
  std::string contents(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  test::TemporaryDirectory folder_;
};

TEST_F(VerbsOnAScene, InfoCountsWhatTheRecipeWasAskedFor) {
  const Outcome outcome = runCommand({"info", path("kinds.glb")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  const auto& lights = json.at("lights");
  const std::size_t count = lights.at("point").get<std::size_t>() + lights.at("spot").get<std::size_t>() +
                            lights.at("triangle").get<std::size_t>() + lights.at("directional").get<std::size_t>();
  EXPECT_EQ(count, 8u);  // tiles of the environment are not counted by the recipe
  for (const char* key : {"meshes", "triangles", "materials", "textures", "cameras", "bounds", "memory", "warnings"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_GT(json.at("triangles"), 0);
  EXPECT_FALSE(json.at("cameras").empty());
  EXPECT_GE(json.at("intensity_ratio"), 1);
  EXPECT_TRUE(json.at("warnings").empty());
}

TEST(CommandLine, InfoWarnsOfLightsThatAreMoreThanTwelveDecadesApart) {
  const test::TemporaryDirectory folder;
  for (const double strongest : {1e11, 1e13}) {
    test::GltfBuilder file;
    for (const double intensity : {1.0, strongest}) {
      file.addRoot({{"extensions", file.addLight({{"type", "point"}, {"intensity", intensity}})}});
    }
    const std::string path = (folder / "two.glb").string();
    file.writeGlb(path);
    const Outcome outcome = runCommand({"info", path});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_NEAR(json.at("intensity_ratio").get<double>() / strongest, 1, 1e-6);
    EXPECT_EQ(json.at("warnings").dump().find("faintest") != std::string::npos, strongest > 1e12);
  }
}

TEST_F(VerbsOnAScene, ReportHasEveryKeyOfTheContract) {
  const Outcome outcome = render(
      "a.exr", {"--spp", "3", "--seed", "5", "--threads", "2", "--strategy", "power", "--report", path("report.json")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const auto json = report();
  EXPECT_EQ(json.at("passes"), 3);
  EXPECT_EQ(json.at("spp"), 3);
  EXPECT_EQ(json.at("width"), 32);
  EXPECT_EQ(json.at("height"), 18);
  EXPECT_EQ(json.at("seed"), 5);
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_EQ(json.at("strategy"), "power");
  EXPECT_EQ(json.at("rays").at("camera"), 3 * 32 * 18);
  EXPECT_GT(json.at("rays").at("bounce"), 0);
  EXPECT_GT(json.at("rays").at("shadow"), 0);
  EXPECT_EQ(json.at("mean").size(), 3u);
  EXPECT_GT(json.at("mean").at(0), 0);
  for (const char* key : {"seconds_load", "seconds_build", "seconds_render"}) EXPECT_GT(json.at(key), 0) << key;
  for (const char* key : {"point", "spot", "triangle", "directional", "environment"}) {
    EXPECT_GE(json.at("lights").at(key), 0) << key;
  }
  for (const char* key : {"peak_rss", "scene", "accel", "lights", "film"})
    EXPECT_GT(json.at("memory").at(key), 0) << key;
  for (const char* key : {"nan", "inf", "dropped"}) EXPECT_EQ(json.at("samples").at(key), 0) << key;
}

TEST_F(VerbsOnAScene, NamesMayBeAnyBytes) {
  std::filesystem::copy(path("kinds.glb"), path("caf\xe9.glb"));
  const Outcome outcome = runCommand({"render", path("caf\xe9.glb"), "-o", path("a.pfm"), "--size", "8x8", "--spp", "1",
                                      "--report", path("report.json")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(report().at("scene"), path("caf\ufffd.glb"));
  writeFile(path("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl caf\xe9\nf 1 2 3\n");
  const Outcome info = runCommand({"info", path("a.obj")});
  ASSERT_EQ(info.code, kDone) << info.err;
  EXPECT_THAT(nlohmann::json::parse(info.out).at("warnings").dump(), HasSubstr("caf\ufffd"));
}

TEST_F(VerbsOnAScene, ASceneWithoutLightIsRenderedWithAWarning) {
  writeFile(path("dark.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  writePfm(path("sky.pfm"), ImageRgb(4, 2, Vec3(1)));
  std::vector<std::string> render{"render", path("dark.obj"), "-o", path("dark.pfm"), "--size", "2x2", "--spp", "1"};
  const Outcome dark = runCommand(render);
  EXPECT_EQ(dark.code, kDone);
  EXPECT_THAT(dark.err, HasSubstr("nothing in the scene gives light"));
  render.insert(render.end(), {"--environment", path("sky.pfm")});
  EXPECT_THAT(runCommand(render).err, Not(HasSubstr("nothing in the scene gives light")));
}

TEST_F(VerbsOnAScene, NoOutputReplacesAnInputOrAnotherOutput) {
  const std::string scene = path("kinds.glb"), before = contents("kinds.glb");
  expectRefused({"render", scene, "-o", path("a.png"), "--report", scene}, "is the file of SCENE too");
  expectRefused({"render", scene, "-o", path("a.png"), "--report", "-"}, "-: is not standard output here");
  expectRefused({"render", scene, "-o", path("a.png"), "--report", path("a.png")}, "is the file of --output too");
  writePfm(path("sky.pfm"), ImageRgb(4, 2, Vec3(1)));
  expectRefused({"render", scene, "-o", path("sky.pfm"), "--environment", path("sky.pfm")}, "of --environment too");
#ifdef CELLCUT_UI
  writeFile(path("script.txt"), "quit\n");
  expectRefused({"view", "--headless", "--script", path("script.txt"), "--record", path("script.txt"), scene},
                "is the file of --script too");
  EXPECT_EQ(contents("script.txt"), "quit\n");
  expectRefused({"view", "--headless", "--script", path("script.txt"), "--record", "/dev/null", scene},
                "/dev/null: is no regular file");
  std::filesystem::create_directory(path("b.json"));
  expectRefused({"screenshot", scene, "-o", path("b.png")}, "b.json: is a folder");
  expectRefused({"screenshot", scene, "-o", path("a.png"), "--reference", path("a.png")}, "of --reference too");
#endif
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
  EXPECT_TRUE(contents("kinds.glb") == before);
}

#ifdef CELLCUT_UI
TEST_F(VerbsOnAScene, AScreenshotOfWhatDoesNotFitIsRefusedBeforeItIsRendered) {
  writePfm(path("other.pfm"), ImageRgb(4, 2, Vec3(1)));
  const test::HostileBudget budget("screenshots", 10);
  const std::vector<std::string> shot{"screenshot", path("kinds.glb"), "-o",    path("a.png"), "--no-ui",
                                      "--size",     "64x32",           "--spp", "100000000"};
  const auto with = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> args = shot;
    args.insert(args.end(), {option, value});
    return args;
  };
  expectRefused(with("--reference", path("other.pfm")),
                "--reference: has other pixels than the rendering, which has 64 x 32");
  expectRefused(with("--pick", "64,0"), "--pick: the picture has 64 x 32 pixels");
  expectRefused(with("--pick", "0,32"), "--pick: the picture has 64 x 32 pixels");
}
#endif

TEST_F(VerbsOnAScene, PictureIsTheSameOnAnyNumberOfThreads) {
  ASSERT_EQ(render("one.pfm", {"--spp", "4", "--threads", "1"}).code, kDone);
  ASSERT_EQ(render("two.pfm", {"--spp", "4", "--threads", "2"}).code, kDone);
  ASSERT_EQ(render("other.pfm", {"--spp", "4", "--seed", "1"}).code, kDone);
  EXPECT_TRUE(contents("one.pfm") == contents("two.pfm"));
  EXPECT_FALSE(contents("one.pfm") == contents("other.pfm"));
}

TEST_F(VerbsOnAScene, ExrTellsHowItWasMade) {
  ASSERT_EQ(render("a b.exr", {"--spp", "2", "--seed", "77", "--max-depth", "1", "--strategy", "proportional"}).code,
            kDone);
  const std::string header = contents("a b.exr").substr(0, 4096);
  for (const char* expected : {"commandLine", "--max-depth 1", "kinds.glb", "a b.exr'", "proportional", "77",
                               "maxDepth", "secondsRender", "albedo", "normal", "depth", "error"}) {
    EXPECT_THAT(header, HasSubstr(expected));
  }
}

TEST_F(VerbsOnAScene, AllKindsOfPicturesAreWritten) {
  for (const std::string name : {"a.exr", "a.pfm", "a.png"}) {
    const Outcome outcome = render(name, {"--spp", "1"});
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_THAT(outcome.err, HasSubstr("wrote " + path(name)));
    EXPECT_FALSE(contents(name).empty());
  }
  const ImageRgb exr = readImage(path("a.exr"));
  const ImageRgb pfm = readImage(path("a.pfm"));
  EXPECT_TRUE(std::equal(exr.begin(), exr.end(), pfm.begin(), pfm.end()));
}

TEST_F(VerbsOnAScene, TimeStopsAtTheEndOfAPass) {
  ASSERT_EQ(render("a.pfm", {"--time", "0.05", "--report", path("report.json")}).code, kDone);
  EXPECT_GE(report().at("seconds_render"), 0.05);
  EXPECT_GE(report().at("passes"), 1);
}

TEST_F(VerbsOnAScene, NoiseStopsWhenTheEstimateIsBelow) {
  ASSERT_EQ(render("a.pfm", {"--noise", "0.5", "--report", path("report.json")}).code, kDone);
  EXPECT_LT(report().at("relative_error"), 0.5);
  EXPECT_GE(report().at("passes"), 16);
}

TEST_F(VerbsOnAScene, QualityAutoReportsWhatItChoseAndTheOptionsThatPinIt) {
  const Outcome outcome =
      render("auto.pfm", {"--spp", "500", "--quality", "auto", "--seed", "9", "--report", path("report.json")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const auto json = report();
  const std::string options = json.at("quality").at("options");
  EXPECT_THAT(outcome.err, HasSubstr("quality " + json.at("quality").at("chosen").get<std::string>()));
  EXPECT_THAT(outcome.err, HasSubstr(options));
  EXPECT_EQ(json.at("passes"), 500);  // none of them a trial's
  EXPECT_GE(json.at("seconds_quality"), 0);
  ASSERT_EQ(json.at("quality").at("trials").size(), 4u);
  for (const auto& trial : json.at("quality").at("trials")) {
    for (const char* key : {"name", "options", "passes", "seconds", "seconds_pass", "seconds_build",
                            "relative_variance", "inefficiency", "inefficiency_low", "inefficiency_high"}) {
      EXPECT_TRUE(trial.contains(key)) << key;
    }
  }
  std::vector<std::string> pinned{"--spp", "500", "--seed", "9", "--report", path("report.json")};
  std::istringstream words(options);
  for (std::string word; words >> word;) pinned.push_back(word);
  ASSERT_EQ(render("pinned.pfm", pinned).code, kDone);
  EXPECT_TRUE(contents("auto.pfm") == contents("pinned.pfm"));
  EXPECT_FALSE(report().contains("quality"));
}

TEST_F(VerbsOnAScene, UnknownCameraListsTheCameras) {
  const Outcome outcome = render("a.pfm", {"--camera", "nowhere"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("the scene has no 'nowhere'; it has 0 '"));
  EXPECT_FALSE(std::filesystem::exists(path("a.pfm")));
}

TEST_F(VerbsOnAScene, EnvironmentLightsTheScene) {
  writePfm(path("sky.pfm"), ImageRgb(4, 2, Vec3(1)));
  ASSERT_EQ(render("plain.pfm", {"--spp", "4", "--report", path("report.json")}).code, kDone);
  const double plain = report().at("mean").at(2);
  ASSERT_EQ(render("sky-lit.pfm", {"--spp", "4", "--report", path("report.json"), "--environment", path("sky.pfm"),
                                   "--environment-scale", "100"})
                .code,
            kDone);
  EXPECT_GT(report().at("mean").at(2), plain);
  EXPECT_GT(report().at("lights").at("environment"), 0);
}

TEST_F(VerbsOnAScene, LimitsReachTheLoader) {
  const std::vector<std::string> sky{"--spp", "1", "--environment", path("sky.pfm"), "--max-texture-bytes"};
  writePfm(path("sky.pfm"), ImageRgb(256, 128, Vec3(1)));
  const auto refusalOf = [this](std::vector<std::string> args, const std::string& limit) {
    args.push_back(limit);
    const Outcome outcome = render("a.pfm", args);
    return outcome.code == kBadInput ? outcome.err : "exit code " + std::to_string(outcome.code);
  };
  EXPECT_EQ(refusalOf(sky, "393216"), "exit code 0");
  EXPECT_THAT(refusalOf(sky, "393215"), HasSubstr("sky.pfm: 256 x 128 pixels have 393216 bytes decoded, more than "
                                                  "393215, the limit (--max-texture-bytes)\n"));
  EXPECT_THAT(refusalOf({"--spp", "1", "--max-texture-bytes"}, "100"),
              testing::AllOf(HasSubstr("kinds.glb: images[0]: "), HasSubstr("(--max-texture-bytes)\n")));
  EXPECT_THAT(refusalOf({"--spp", "1", "--max-triangles"}, "10"),
              testing::AllOf(HasSubstr("kinds.glb: "), HasSubstr("(--max-triangles)\n")));
}

TEST_F(VerbsOnAScene, InterruptionWritesWhatHasBeenAccumulated) {
  InterruptingBuffer buffer("", 1);  // the first progress
  std::ostream err(&buffer);
  const Outcome outcome = render("a.pfm", {"--spp", "1000000000", "--report", path("report.json")}, &err, true);
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_THAT(buffer.str(), HasSubstr("interrupted"));
  EXPECT_EQ(report().at("interrupted"), true);
  const int passes = report().at("passes");
  ASSERT_GE(passes, 1);
  ASSERT_EQ(render("b.pfm", {"--spp", std::to_string(passes)}).code, kDone);
  EXPECT_TRUE(contents("a.pfm") == contents("b.pfm"));  // nothing of the pass in flight
}

}  // namespace
}  // namespace cellcut::test
