#include "app/options.h"

#include "renderer/base/error.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using ::testing::HasSubstr;

/// Parses the options behind `cellcut render scene.glb -o FOLDER/out.exr`.
class RenderOptionsTest : public testing::Test {
 protected:
  RenderOptions parse(const std::vector<std::string>& more) {
    std::vector<std::string> args{"scene.glb", "-o", (folder_ / "out.exr").string()};
    args.insert(args.end(), more.begin(), more.end());
    return parseAll(args);
  }
  RenderOptions parseAll(std::vector<std::string> args) {
    CLI::App verb;
    RenderOptions options;
    addRenderOptions(verb, options);
    std::reverse(args.begin(), args.end());  // the parser takes them from the back
    verb.parse(args);
    return options;
  }
  std::string refusalOf(const std::vector<std::string>& more) {
    return test::refusalOf([&] { parse(more); });
  }
  test::TemporaryDirectory folder_;
};

TEST_F(RenderOptionsTest, DefaultsAreTheRenderersOwn) {
  const RenderOptions options = parse({});
  EXPECT_EQ(options.scene, "scene.glb");
  EXPECT_FALSE(options.stop.has_value());
  EXPECT_EQ(StopRule{}.kind, StopRule::Kind::kPasses);
  EXPECT_EQ(StopRule{}.passes, 64u);
  EXPECT_EQ(options.settings.width, RenderSettings{}.width);
  EXPECT_EQ(options.settings.strategy, RenderSettings{}.strategy);
  EXPECT_EQ(options.settings.maxDepth, 8);
  EXPECT_EQ(options.load.punctualScale, 1.0);
  EXPECT_EQ(options.load.limits.maxTriangles, LoadLimits{}.maxTriangles);
  EXPECT_EQ(options.load.limits.maxTextureBytes, LoadLimits{}.maxTextureBytes);
  EXPECT_FALSE(options.environment.file.has_value());
  EXPECT_FALSE(options.report.has_value());
}

TEST_F(RenderOptionsTest, EveryOptionReachesItsSetting) {
  const RenderOptions options = parse({"--strategy",
                                       "power",
                                       "--spp",
                                       "7",
                                       "--size",
                                       "320x180",
                                       "--max-depth",
                                       "0",
                                       "--seed",
                                       "18446744073709551615",
                                       "--threads",
                                       "3",
                                       "--camera",
                                       "door",
                                       "--sampler",
                                       "independent",
                                       "--environment",
                                       "sky.hdr",
                                       "--environment-scale",
                                       "2.5",
                                       "--environment-rotation",
                                       "-90",
                                       "--punctual-scale",
                                       "0.5",
                                       "--max-triangles",
                                       "12",
                                       "--max-texture-bytes",
                                       "18446744073709551615",
                                       "--report",
                                       (folder_ / "r.json").string()});
  EXPECT_EQ(options.settings.strategy, Strategy::kPower);
  EXPECT_EQ(options.stop.value().passes, 7u);
  EXPECT_EQ(options.settings.width, 320);
  EXPECT_EQ(options.settings.height, 180);
  EXPECT_EQ(options.settings.maxDepth, 0);
  EXPECT_EQ(options.settings.seed, 18446744073709551615u);
  EXPECT_EQ(options.settings.threads, 3);
  EXPECT_EQ(options.camera, "door");
  EXPECT_EQ(options.settings.sampling, PixelSampling::kIndependent);
  EXPECT_EQ(options.environment.file, "sky.hdr");
  EXPECT_EQ(options.environment.scale, 2.5);
  EXPECT_EQ(options.environment.rotation, -90);
  EXPECT_EQ(options.load.punctualScale, 0.5);
  EXPECT_EQ(options.load.limits.maxTriangles, 12u);
  EXPECT_EQ(options.load.limits.maxTextureBytes, 18446744073709551615u);
  EXPECT_EQ(options.report, folder_ / "r.json");
}

TEST_F(RenderOptionsTest, TimeAndNoiseReplaceTheNumberOfSamples) {
  const StopRule time = parse({"--time", "1.5"}).stop.value(), noise = parse({"--noise", "0.05"}).stop.value();
  EXPECT_EQ(time.kind, StopRule::Kind::kSeconds);
  EXPECT_EQ(time.seconds, 1.5);
  EXPECT_EQ(noise.kind, StopRule::Kind::kNoise);
  EXPECT_EQ(noise.noise, 0.05);
}

TEST_F(RenderOptionsTest, OnlyOneStopRuleIsAccepted) {
  EXPECT_THROW(parse({"--spp", "4", "--time", "1"}), CLI::ExcludesError);
  EXPECT_THROW(parse({"--spp", "4", "--noise", "1"}), CLI::ExcludesError);
  EXPECT_THROW(parse({"--time", "4", "--noise", "1"}), CLI::ExcludesError);
}

TEST_F(RenderOptionsTest, OptionsGivenTwiceAreRefused) {
  EXPECT_THROW(parse({"--spp", "4", "--spp", "8"}), CLI::ParseError);
}

TEST_F(RenderOptionsTest, ValuesOutsideTheirRangesAreRefused) {
  const std::vector<std::vector<std::string>> refused{{"--spp", "0"},
                                                      {"--spp", "4x"},
                                                      {"--time", "0"},
                                                      {"--time", "nan"},
                                                      {"--noise", "-1"},
                                                      {"--noise", "inf"},
                                                      {"--size", "0x10"},
                                                      {"--size", "10x16385"},
                                                      {"--size", "10"},
                                                      {"--size", "10x10x10"},
                                                      {"--size", "10 x 10"},
                                                      {"--max-depth", "-1"},
                                                      {"--threads", "1025"},
                                                      {"--max-triangles", "-1"},
                                                      {"--max-triangles", "1e6"},
                                                      {"--max-triangles", "1073741825"},
                                                      {"--max-texture-bytes", "-1"},
                                                      {"--max-texture-bytes", "8GB"},
                                                      {"--max-texture-bytes", "18446744073709551616"},
                                                      {"--punctual-scale", "-1"},
                                                      {"--punctual-scale", "Blender "},
                                                      {"--environment-scale", "-1"},
                                                      {"--environment-rotation", "nan"}};
  for (const auto& args : refused) {
    EXPECT_THAT(refusalOf(args), HasSubstr(args[0] + ": '")) << args[1];
  }
  EXPECT_THAT(refusalOf({"--punctual-scale", "Blender"}), HasSubstr("is not a number of at least 0, nor 'blender'"));
  EXPECT_THAT(refusalOf({"--camera", ""}), HasSubstr("--camera: names none"));
}

TEST_F(RenderOptionsTest, LargestPictureIsAccepted) {
  EXPECT_EQ(parse({"--size", "16384x1"}).settings.width, 16384);
  EXPECT_EQ(parse({"--size", "1x16384"}).settings.height, 16384);
}

TEST_F(RenderOptionsTest, WordBlenderUndoesLumenPerWatt) {
  EXPECT_DOUBLE_EQ(parse({"--punctual-scale", "blender"}).load.punctualScale * 683, 1);
}

TEST_F(RenderOptionsTest, UnknownStrategyAndSamplerListTheKnownOnes) {
  for (const StrategyName& s : kStrategies) {
    EXPECT_EQ(parse({"--strategy", std::string(s.name)}).settings.strategy, s.strategy);
    EXPECT_THAT(refusalOf({"--strategy", "best"}), HasSubstr(std::string(s.name)));
  }
  EXPECT_THAT(refusalOf({"--sampler", "halton"}), HasSubstr("sobol, independent"));
}

TEST_F(RenderOptionsTest, QualityIsAPresetAndAnExplicitOptionWins) {
  for (const Quality& q : kQualities) {
    const SamplerSettings s = parse({"--quality", std::string(q.name)}).settings.sampler;
    EXPECT_EQ(s.maxCut, q.settings.maxCut);
    EXPECT_EQ(s.gridResolution, q.settings.gridResolution);
    EXPECT_EQ(s.threshold, q.settings.threshold);
    EXPECT_EQ(s.inCluster, q.settings.inCluster);
  }
  for (const bool first : {true, false}) {
    std::vector<std::string> args{"--quality", "accurate"};
    args.insert(first ? args.begin() : args.end(), {"--max-cut", "77"});
    const SamplerSettings s = parse(args).settings.sampler;
    EXPECT_EQ(s.maxCut, 77);
    EXPECT_EQ(s.gridResolution, kQualities.back().settings.gridResolution);
  }
  EXPECT_THAT(refusalOf({"--quality", "best"}), HasSubstr("preview, balanced, accurate"));
}

TEST_F(RenderOptionsTest, QualityAutoTriesSettingsInWhichExplicitOptionsHold) {
  EXPECT_TRUE(parse({}).candidates.empty());
  EXPECT_TRUE(parse({"--quality", "preview"}).candidates.empty());
  const RenderOptions options = parse({"--max-cut", "77", "--quality", "auto", "--cell-memory", "1"});
  ASSERT_GE(options.candidates.size(), 3u);
  EXPECT_EQ(options.candidates[0].settings, options.settings.sampler);
  for (const Quality& candidate : options.candidates) {
    EXPECT_EQ(candidate.settings.maxCut, 77);
    EXPECT_EQ(candidate.settings.cellMemory, std::size_t{1} << 20);
  }
  EXPECT_NE(options.candidates[1].settings.inCluster, options.settings.sampler.inCluster);
  EXPECT_THAT(refusalOf({"--quality", "best"}), HasSubstr("auto"));
}

TEST_F(RenderOptionsTest, OnlyRenderTriesQualities) {
  CLI::App verb;
  RenderOptions options;
  addPictureOptions(verb, options);
  std::vector<std::string> args{"auto", "--quality"};
  EXPECT_THROW(verb.parse(args), InputError);
}

TEST_F(RenderOptionsTest, PinningOptionsMakeTheSameSettings) {
  for (const float threshold : {0.002f, 0.1f, 1.0f / 3, 1e-30f, 0.0f}) {
    const SamplerSettings s{
        .threshold = threshold, .maxCut = 99, .gridResolution = 7, .inCluster = InCluster::kIntensity};
    std::istringstream words(pinningOptions(s));
    const std::vector<std::string> args(std::istream_iterator<std::string>(words), {});
    EXPECT_EQ(parse(args).settings.sampler, s) << pinningOptions(s);
  }
  EXPECT_EQ(pinningOptions({}), "--threshold 5e-04 --max-cut 1024 --grid-resolution 16 --in-cluster descent");
}

TEST_F(RenderOptionsTest, EnvironmentSettingsNeedAnEnvironment) {
  EXPECT_THROW(parse({"--environment-scale", "2"}), CLI::RequiresError);
  EXPECT_THROW(parse({"--environment-rotation", "2"}), CLI::RequiresError);
}

TEST_F(RenderOptionsTest, SceneAndOutputAreRequired) {
  EXPECT_THROW(parseAll({"scene.glb"}), CLI::RequiredError);
  EXPECT_THROW(parseAll({"-o", (folder_ / "out.exr").string()}), CLI::RequiredError);
}

TEST_F(RenderOptionsTest, ExtensionOfTheOutputNamesItsKind) {
  const auto kindOf = [this](const char* name) {
    return parseAll({"s.glb", "-o", (folder_ / name).string()}).output.kind;
  };
  EXPECT_EQ(kindOf("a.exr"), PictureKind::kExr);
  EXPECT_EQ(kindOf("a.EXR"), PictureKind::kExr);
  EXPECT_EQ(kindOf("a.pfm"), PictureKind::kPfm);
  EXPECT_EQ(kindOf("a.png"), PictureKind::kPng);
  for (const char* name : {"a.jpg", "a", "a.png.", "png", ".exr"}) EXPECT_THROW(kindOf(name), InputError) << name;
}

TEST_F(RenderOptionsTest, OutputInAFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(parseAll({"s.glb", "-o", (folder_ / "no" / "a.exr").string()}), InputError);
  EXPECT_THAT(refusalOf({"--report", (folder_ / "no" / "r.json").string()}), HasSubstr("folder does not exist"));
}

TEST_F(RenderOptionsTest, OutputThatIsAFolderIsRefused) {
  std::filesystem::create_directory(folder_ / "a.exr");
  EXPECT_THROW(parseAll({"s.glb", "-o", (folder_ / "a.exr").string()}), InputError);
}

TEST_F(RenderOptionsTest, CheckingTheOutputLeavesNoFile) {
  parse({"--report", (folder_ / "r.json").string()});
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

Scene sceneWithCameras(const std::vector<std::string>& names) {
  Scene scene;
  for (const std::string& name : names) {
    scene.cameras.emplace_back();
    scene.cameras.back().name = name;
  }
  return scene;
}

TEST(FindCamera, FindsByNameThenByIndex) {
  const Scene scene = sceneWithCameras({"front", "2", "back"});
  EXPECT_EQ(findCamera(scene, ""), 0u);
  EXPECT_EQ(findCamera(scene, "back"), 2u);
  EXPECT_EQ(findCamera(scene, "0"), 0u);
  EXPECT_EQ(findCamera(scene, "2"), 1u);  // a name, though it looks like a number
}

TEST(FindCamera, RefusalListsTheCameras) {
  const Scene scene = sceneWithCameras({"front", "back"});
  for (const char* text : {"2", "-1", "1x", "Front", "99999999999999999999"}) {
    try {
      findCamera(scene, text);
      FAIL() << "accepted " << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("0 'front', 1 'back'"));
    }
  }
}

}  // namespace
}  // namespace cellcut::test
