#include "ui/viewer/viewer.h"

#include "renderer/scene/camera.h"
#include "renderer/scene/recipes/recipe.h"
#include "tests/support/restrictions.h"
#include "tests/ui/viewer_fixture.h"

#include <future>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut::test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

std::vector<std::string> channelsOf(const std::filesystem::path& exr) {
  const Imf::InputFile file(exr.c_str());
  std::vector<std::string> names;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) names.emplace_back(channel.name());
  return names;
}

TEST_F(ViewerTest, StrategiesAreToggledByListAndByKey) {
  play(
      "wait idle\nexpect Strategy cell-cut\nset Strategy power\nexpect Strategy power\nkey 6\nexpect Strategy "
      "light-tree\nwait idle\n");
  EXPECT_EQ(viewer_->state().settings.strategy, Strategy::kLightTree);
  EXPECT_TRUE(viewer_->session().snapshot()->sampler.tree.has_value());
  EXPECT_FALSE(viewer_->session().snapshot()->sampler.grid.has_value());
}

TEST_F(ViewerTest, ParametersAreSetAsAPersonSetsThem) {
  play(
      "set \"Max cut\" 40\nset Grid 5\nset \"In cluster\" intensity\nset \"Max depth\" 3\nset Exposure 2.5\nset \"Tone "
      "map\" off\n"
      "expect Quality custom\nset Quality preview\nexpect \"In cluster\" intensity\nexpect Exposure 2.5\nwait idle\n");
  EXPECT_EQ(viewer_->state().settings.sampler, kQualities[0].settings);
  EXPECT_EQ(viewer_->state().settings.maxDepth, 3);
  EXPECT_FALSE(viewer_->state().display.toneMap);
}

TEST_F(ViewerTest, DragsScrollsAndKeysMoveTheCamera) {
  play("wait idle\n");
  const Camera start = viewOf(*scene_, viewer_->state().settings);
  const std::vector<std::string> moves{"drag left 300 200 340 220", "drag right 300 200 340 220",
                                       "drag middle 300 200 340 220", "scroll 300 200 2", "key W"};
  for (const std::string& move : moves) {
    play(move + "\nwait idle\n");
    ASSERT_TRUE(viewer_->state().settings.view) << move;
    EXPECT_FALSE(isSameView(*viewer_->state().settings.view, start)) << move;
    play("click Reset\nwait idle\n");
    EXPECT_FALSE(viewer_->state().settings.view) << move;
  }
  // A view that was copied comes back.
  play("drag left 300 200 340 220\nkey Ctrl+C\n");
  const Camera copied = *viewer_->state().settings.view;
  play("key R\nkey Ctrl+V\n");
  EXPECT_LT(glm::length(viewer_->state().settings.view->position - copied.position), 1e-5f);
}

TEST_F(ViewerTest, TheFocusIsOnWhatIsUnderThePointerWhateverTheSessionDoes) {
  play("wait idle\n");
  std::promise<void> release;
  const auto held = viewer_->session().inspect([&](const SessionView&) { release.get_future().wait(); });
  play("move 300 400\nkey F\nkey Ctrl+C\n");
  release.set_value();
  const auto& state = viewer_->state();
  const auto pixel = imagePixelAt(viewer_->placement(), {state.settings.width, state.settings.height}, Vec2(300, 400));
  ASSERT_TRUE(pixel);
  const auto hit = PreparedScene(*scene_).accel.intersect(
      cameraRay(viewOf(*scene_, state.settings), Vec2(*pixel) + 0.5f, {state.settings.width, state.settings.height}),
      0);
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(nlohmann::json::parse(window_->clipboard()).at("focus").get<float>(), hit->t);
}

TEST_F(ViewerTest, EveryOverlayShowsItsValues) {
  play("wait idle\n");
  for (const OverlayName& overlay : kOverlays) {
    play("set Show " + std::string(overlay.name) + "\nwait idle\n");
    if (overlay.overlay == Overlay::kNone) continue;
    ASSERT_NE(viewer_->overlay(), nullptr) << overlay.name;
    EXPECT_EQ(viewer_->overlay()->overlay, overlay.overlay);
    EXPECT_GT(viewer_->overlay()->statistics.count, 0u) << overlay.name;
  }
  // All cells that are seen were touched: one value, and still a range from 0 to 1.
  play("set Show touched\nwait idle\n");
  const ColorScale scale(viewer_->overlay()->values, scaleOf(Overlay::kTouched, {}));
  EXPECT_EQ(scale.range(), (ValueRange{0, 1}));
  ASSERT_TRUE(viewer_->overlay()->touched);
  EXPECT_GT(viewer_->overlay()->touched->inside, 0u);
}

TEST_F(ViewerTest, TheOverlayOfErrorsSaysWhatItsErrorsAre) {
  play("set Show error\nwait idle\n");
  EXPECT_EQ(viewer_->overlay()->title, "standard error of the mean");
  const std::shared_ptr<const Snapshot> snapshot = viewer_->session().snapshot();
  writePfm(folder_ / "reference.pfm", ImageRgb(snapshot->width, snapshot->height, Vec3(1)));
  play("drop reference.pfm\nwait idle\n");
  EXPECT_EQ(viewer_->overlay()->title, "error");
}

TEST_F(ViewerTest, AnySeedOf64BitsIsShownAndSet) {
  ViewerOptions options;
  options.state.settings.seed = (std::uint64_t{1} << 63) + 5;
  open(std::move(options));
  play("wait idle\n");
  ASSERT_NE(viewer_->widgets().find("Seed"), nullptr);
  EXPECT_EQ(viewer_->widgets().find("Seed")->value, "9223372036854775813");
  play("set Seed 18446744073709551615\nwait idle\n");
  EXPECT_EQ(viewer_->state().settings.seed, ~std::uint64_t{0});
  play("expect Seed 18446744073709551615\n");
  EXPECT_THAT(refusalOf("expect Seed 18446744073709551614\n"), HasSubstr("'Seed' is '18446744073709551615' and not"));
  for (const std::string none : {"-1", "2.7", "1e3", "18446744073709551616", "x"}) {
    EXPECT_THAT(refusalOf("set Seed " + none + "\n"), HasSubstr("script.txt:1: '" + none + "' is no whole number"))
        << none;
  }
  EXPECT_EQ(viewer_->state().settings.seed, ~std::uint64_t{0});
}

TEST_F(ViewerTest, WhatIsTypedIsTakenInNarrowPanels) {
  ViewerOptions options = optionsOfTests();
  options.uiScale = 2;
  viewer_.reset();
  viewer_ = std::make_unique<Viewer>(*window_, scene_, nullptr, std::move(options));
  play("set Seed 42\nset \"Max depth\" 3\n");
  EXPECT_EQ(viewer_->state().settings.seed, 42u);
  EXPECT_EQ(viewer_->state().settings.maxDepth, 3);
}

TEST_F(ViewerTest, WhatLiesOverAPictureGoesWithItWhenTheOtherIsShown) {
  const auto shownPixels = [this] {
    const ImageRgba8 picture = viewer_->picture();
    const PixelRect area = viewer_->imageArea();
    std::vector<Rgba8> pixels;
    for (int y = 0; y < static_cast<int>(area.size.y); ++y) {
      for (int x = 0; x < static_cast<int>(area.size.x); ++x) {
        pixels.push_back(picture.at(x + static_cast<int>(area.origin.x), y + static_cast<int>(area.origin.y)));
      }
    }
    return pixels;
  };
  const auto other = [&] {
    window_->post(KeyChange{Key::kB, true});
    for (int i = 0; i < 2; ++i) {
      window_->pollEvents();
      viewer_->frame(1.0 / 60);
    }
    std::vector<Rgba8> pixels = shownPixels();
    window_->post(KeyChange{Key::kB, false});
    window_->pollEvents();
    viewer_->frame(1.0 / 60);
    return pixels;
  };
  play("wait idle\nmove 2 2\n");
  viewer_->storePicture();
  const std::vector<Rgba8> plain = other();
  play("set Show cut-size\nwait idle\npick 90 350\nwait idle\nmove 2 2\n");
  ASSERT_TRUE(viewer_->state().pick);
  EXPECT_TRUE(other() == plain);
  // So it does with the split at the left edge.
  play("set Split 0\nmove 2 2\n");
  EXPECT_TRUE(shownPixels() == plain);
}

TEST_F(ViewerTest, AClickInspectsTheCellUnderThePointer) {
  play("wait idle\npick 90 350\nwait idle\n");
  ASSERT_TRUE(viewer_->state().pick);
  EXPECT_EQ(*viewer_->state().pick, glm::ivec2(90, 350));
  ASSERT_NE(viewer_->overlay(), nullptr);
  ASSERT_TRUE(viewer_->overlay()->inspection);
  const PixelReport& report = *viewer_->overlay()->inspection;
  ASSERT_FALSE(report.clusters.empty());
  double sum = 0;
  for (const ClusterRow& row : report.clusters) sum += row.cluster.probability;
  EXPECT_NEAR(sum, 1, 1e-5);
  play("click \"Copy cut\"\n");
  EXPECT_EQ(nlohmann::json::parse(window_->clipboard()).at("cut").at("clusters").size(), report.clusters.size());
  play("key Escape\n");
  EXPECT_FALSE(viewer_->state().pick);
}

double meanOf(const ImageRgb& image) {
  glm::dvec3 sum(0.0);
  for (const Vec3& c : image) sum += glm::dvec3(c);
  return (sum.x + sum.y + sum.z) / (3 * static_cast<double>(image.size()));
}

TEST_F(ViewerTest, AClusterIsShownAloneAndLeftOut) {
  const auto mean = [this] { return meanOf(*viewer_->session().snapshot()->radiance); };
  play("wait idle\n");
  const double all = mean();
  play("pick 90 350\nwait idle\nclick \"Cluster 1\"\nexpect \"Cluster 1\" on\nclick Solo\nwait idle\n");
  const double solo = mean();
  play("key N\nkey M\nwait idle\n");
  const double mute = mean();
  // What is seen of the lights themselves is there with each of them.
  play("click Close\nclick \"All lights\"\nset \"Max depth\" 0\nwait idle\n");
  const double seen = mean();
  EXPECT_NEAR(solo + mute - seen, all, 1e-5 * all);
  EXPECT_GT(solo, seen);
  EXPECT_LT(mute, all);
  EXPECT_THAT(refusalOf("click \"All lights\"\n"), HasSubstr("nothing is labelled"));
}

TEST_F(ViewerTest, ABoxUnderThePointerSelectsItsRow) {
  Scene lamps;
  addQuad(lamps, addMaterial(lamps, lambertian(Vec3(0.5f))), {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  for (int i = 0; i < 3; ++i) lamps.pointLights.push_back({{static_cast<float>(i - 1), 1, 0}, Vec3(1)});
  lamps.cameras.push_back(perspective({0, 2, 6}, {0, 0.5f, 0}, 1));
  finish(lamps);
  scene_ = std::make_shared<const Scene>(std::move(lamps));
  open({});
  play("wait idle\npick 100 450\nwait idle\n");
  ASSERT_TRUE(viewer_->overlay()->inspection);
  const std::vector<ClusterRow> rows = viewer_->overlay()->inspection->clusters;
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto film = projectToFilm(scene_->cameras[0], rows[i].cluster.box.centre(),
                                    {viewer_->state().settings.width, viewer_->state().settings.height});
    ASSERT_TRUE(film);
    const Vec2 at = viewer_->placement().toFramebuffer(*film);
    if (!viewer_->imageArea().contains(at)) continue;
    play("move " + std::to_string(at.x) + " " + std::to_string(at.y) + "\nkey X\n");
    EXPECT_EQ(viewer_->state().hoveredCluster, i);
    EXPECT_EQ(viewer_->state().selectedCluster, i);
  }
  EXPECT_TRUE(viewer_->state().selectedCluster);
}

TEST_F(ViewerTest, ASliceShowsCellsInMidAir) {
  play("set Show cut-size\nwait idle\n");
  const std::size_t onSurfaces = viewer_->overlay()->statistics.count;
  play("set Slice \"across z\"\nset \"Slice at\" 0.4\nwait idle\n");
  ASSERT_TRUE(viewer_->overlay()->slice);
  const float before = *viewer_->overlay()->slice;
  EXPECT_GT(viewer_->overlay()->statistics.count, 0u);
  EXPECT_NE(viewer_->overlay()->statistics.count, onSurfaces);
  play("key RightBracket\nkey RightBracket\nkey RightBracket\nwait idle\n");
  EXPECT_GT(*viewer_->overlay()->slice, before);
  play("key K\nwait idle\n");
  EXPECT_FALSE(viewer_->overlay()->slice);
  EXPECT_EQ(viewer_->overlay()->statistics.count, onSurfaces);
}

TEST_F(ViewerTest, IsNotAtRestBeforeItShowsTheLastPass) {
  play("set Pause on\nset \"Stop at spp\" 5\nwait idle\n");
  EXPECT_TRUE(viewer_->atRest());
  viewer_->session().singleStep();
  viewer_->session().waitIdle();
  EXPECT_FALSE(viewer_->atRest());
  play("wait idle\n");
  EXPECT_TRUE(viewer_->atRest());
}

TEST_F(ViewerTest, PanelsAndSheetAreToggled) {
  play("expect Strategy cell-cut\nkey F2\n");
  EXPECT_THAT(refusalOf("expect Strategy cell-cut\n"), HasSubstr("nothing is labelled"));
  EXPECT_EQ(viewer_->imageArea().origin.x, 0);
  play("key F2\nkey F1\n");
  EXPECT_TRUE(viewer_->state().showHelp);
  play("key F1\n");
  EXPECT_FALSE(viewer_->state().showHelp);
}

TEST_F(ViewerTest, AStoredPictureIsSplitAndForgotten) {
  play("wait idle\nclick Store\nset Split 0.25\nexpect Split 0.25\nkey 1\nwait idle\nclick Forget\n");
  EXPECT_THAT(refusalOf("expect Split 0.25\n"), HasSubstr("nothing is labelled 'Split'"));
}

TEST_F(ViewerTest, ABadSceneIsRefusedAndTheOldOneGoesOn) {
  std::ofstream(folder_ / "bad.glb") << "no scene";
  play("wait idle\ndrop bad.glb\nwait idle\n");
  EXPECT_THAT(viewer_->problem(), HasSubstr("bad.glb"));
  play("key 2\nwait idle\nclick Dismiss\n");
  EXPECT_EQ(viewer_->problem(), "");
  EXPECT_EQ(viewer_->session().snapshot()->passes, 2u);
}

TEST_F(ViewerTest, WarningsOfASceneAreShownUntilTheyAreDismissed) {
  std::ofstream(folder_ / "odd.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 x\nf 1 2 3\n";
  play("wait idle\ndrop odd.obj\nwait idle\n");
  EXPECT_THAT(viewer_->notice(), HasSubstr("vn 0 0 x: is not read as it stands"));
  play("click Dismiss\n");
  EXPECT_EQ(viewer_->notice(), "");
}

TEST_F(ViewerTest, APictureOfAnyCaseIsAReference) {
  writeExr(folder_ / "REFERENCE.EXR", {2, 1, {{"", {"R", "G", "B"}, {1, 2, 3, 4, 5, 6}}}, {}});
  play("drop REFERENCE.EXR\nwait idle\n");
  ASSERT_TRUE(viewer_->reference().picture);
  EXPECT_EQ(viewer_->reference().picture->at(1, 0), Vec3(4, 5, 6));
}

TEST_F(ViewerTest, ASceneThatIsGoneWhenItIsReadAgainGoesOn) {
  writeFileAtomically(folder_ / "gone.glb", generateRecipe(Recipe::kRooms, 8, 0));
  play("drop gone.glb\nwait idle\n");
  ASSERT_EQ(viewer_->problem(), "");
  std::filesystem::remove(folder_ / "gone.glb");
  play("key F5\nwait idle\n");
  EXPECT_THAT(viewer_->problem(), HasSubstr("gone.glb: does not exist"));
  play("key 2\nwait idle\n");
  EXPECT_EQ(viewer_->session().snapshot()->passes, 2u);
}

TEST_F(ViewerTest, SavesTheWindowAndTheRendering) {
  play("wait idle\nkey F12\nwait idle\n");
  EXPECT_THAT(viewer_->notice(), HasSubstr("saved"));
  EXPECT_EQ(viewer_->problem(), "");
  std::size_t exr = 0, png = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    if (entry.path().extension() == ".exr") {
      ++exr;
      EXPECT_THAT(channelsOf(entry.path()),
                  IsSupersetOf({"R", "albedo.R", "normal.X", "depth.Z", "variance.R", "cell.id", "cut.size"}));
    }
    png += entry.path().extension() == ".png";
  }
  EXPECT_EQ(exr, 1u);
  EXPECT_EQ(png, 1u);
  play("click Dismiss\n");
  EXPECT_EQ(viewer_->notice(), "");
}

TEST_F(ViewerTest, ScriptsNameTheLineThatFails) {
  EXPECT_THAT(refusalOf("wait idle\nexpect Strategy power\n"), HasSubstr("script.txt:2"));
  EXPECT_THAT(refusalOf("jump\n"), HasSubstr("no action 'jump'"));
  EXPECT_THAT(refusalOf("click \"Max\n"), HasSubstr("a quote has no end"));
  EXPECT_THAT(refusalOf("size 10 x\n"), HasSubstr("is no number"));
  EXPECT_THAT(refusalOf("wait for it\n"), HasSubstr("'wait' is followed by"));
  EXPECT_THAT(refusalOf("wait idle\nkey Ctrl+Foo\n"), HasSubstr("script.txt:2: no key is called 'Ctrl+Foo'"));
  EXPECT_THAT(refusalOf("set \"Max depth\" deep\n"), HasSubstr("script.txt:1: 'deep' is no whole number"));
  EXPECT_THAT(refusalOf("set Exposure deep\n"), HasSubstr("script.txt:1: 'deep' is no number"));
  EXPECT_THAT(refusalOf("pick 4000 2\n"), HasSubstr("script.txt:1: the picture has "));
  EXPECT_THAT(refusalOf("screenshot a.exr\n"), HasSubstr("script.txt:1: 'a.exr' does not end in .png"));
  EXPECT_THAT(refusalOf("drag rihgt 1 1 5 5\n"), HasSubstr("'rihgt' is none of left, right, middle"));
  EXPECT_THAT(refusalOf("view 1 1 1 0 0 1 0 1 0 1 1 wide\n"), HasSubstr("'wide' is neither"));
}

TEST_F(ViewerTest, WaitingForSamplesThatCannotComeFails) {
  EXPECT_THAT(refusalOf("key G\nwait spp 100\n"),
              HasSubstr("script.txt:2: the rendering has ended at its limit, with 2 samples per pixel; wait for"));
  play("set \"Stop at spp\" 3\nwait spp 3\nset Pause on\nset \"Stop at spp\" 5\nset Pause off\nwait spp 5\n");
  EXPECT_EQ(viewer_->session().snapshot()->passes, 5u);
}

TEST_F(ViewerTest, ACameraBeyondAllDistancesSeesNothing) {
  const std::string shown = "wait idle\npick 20 20\nwait idle\nset Show cut-size\nwait idle\nset Show none\n";
  for (const char* far :
       {"view 0 0 1e19 0 0 1 0 1 0 0.5 1 perspective", "view 1e30 -1e38 1e19 0 0 1 0 1 0 0.5 1e38 perspective",
        "scroll 250 60 -400", "scroll 250 60 -400\nscroll 250 60 -400", "view 0 0 5 0 0 1 0 1 0 1e20 1 orthographic",
        "scroll 250 60 -400", "drag middle 300 200 340 220", "key R\nscroll 250 60 1000\nscroll 250 60 1000"}) {
    play(far + std::string("\n") + shown);
    EXPECT_EQ(viewer_->session().snapshot()->error, "") << far;
    EXPECT_EQ(viewer_->session().snapshot()->passes, 2u) << far;
    EXPECT_TRUE(isFinite(viewOf(*scene_, viewer_->state().settings).position)) << far;
    for (const Vec3& pixel : *viewer_->session().snapshot()->radiance) ASSERT_TRUE(isFinite(pixel)) << far;
  }
  play("key R\nscroll 250 60 -1\nwait idle\n");
  EXPECT_LT(glm::length(viewOf(*scene_, viewer_->state().settings).position), 1e4f);
}

TEST_F(ViewerTest, AClipboardThatNestsWithoutEndHoldsNoView) {
  window_->setClipboard("{\"position\": " + std::string(100'000, '[') + std::string(100'000, ']') + "}");
  play("key Ctrl+V\n");
  EXPECT_THAT(viewer_->problem(),
              HasSubstr("camera from the clipboard: JSON nested more than 128 deep; copy one with Ctrl+C"));
}

TEST_F(ViewerTest, ARecordedScriptReplayedGivesTheSameState) {
  const std::filesystem::path record = folder_ / "recorded.txt";
  ViewerOptions recording;
  recording.record = record;
  open(recording);
  play(
      "wait idle\nset Strategy cell-cut\nset \"Max cut\" 40\nset Exposure 1.37\nset \"Tone map\" off\nset Channel "
      "luminance\ndrag left 300 200 340 220\nscroll 300 200 2\nkey W\ndrag middle 300 200 280 240\nset Show "
      "cut-size\nkey G\nsize 420 700\nwait idle\npick 90 300\nmove 300 210\nkey F\ndrag left 300 200 310 "
      "190\nclick Statistics\nset \"Stop at spp\" 3\nkey P\n");
  const ViewerState first = viewer_->state();
  open({});
  EXPECT_FALSE(first.settings.view && viewer_->state().settings.view);
  playScript(readScript(record), folder_.path(), *viewer_, *window_);
  const ViewerState& second = viewer_->state();
  EXPECT_EQ(first.settings.strategy, second.settings.strategy);
  EXPECT_EQ(first.settings.sampler, second.settings.sampler);
  EXPECT_EQ(first.settings.width, second.settings.width);
  EXPECT_EQ(first.display.exposure, second.display.exposure);
  EXPECT_EQ(first.display.toneMap, second.display.toneMap);
  EXPECT_EQ(first.display.channel, second.display.channel);
  EXPECT_EQ(first.overlay, second.overlay);
  EXPECT_EQ(first.pick, second.pick);
  EXPECT_EQ(first.passLimit, second.passLimit);
  EXPECT_EQ(first.paused, second.paused);
  ASSERT_TRUE(first.settings.view && second.settings.view);
  // Sums of drags are rounded in another order.
  EXPECT_LT(glm::length(first.settings.view->position - second.settings.view->position), 1e-4f);
  EXPECT_LT(glm::length(first.settings.view->back - second.settings.view->back), 1e-4f);
  std::ifstream recorded(record);
  EXPECT_EQ(viewer_->widgets().find("Samples"), nullptr) << "the section was closed by:\n"
                                                         << std::string(std::istreambuf_iterator<char>(recorded), {});
}

TEST_F(ViewerTest, ARecordingThatFailsIsSaidWhileAndAfterItGoesOn) {
  ViewerOptions recording;
  recording.record = folder_ / "recorded.txt";
  open(recording);
  play("key 2\nwait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
  {
    const FileSizeLimit limit(100);  // the first line and part of the second
    play("key 3\nkey 4\nkey 5\nkey 2\nwait idle\n");
  }
  EXPECT_THAT(viewer_->problem(), HasSubstr("recorded.txt: not all that was done could be recorded; make room"));
  play("click Dismiss\nkey 2\n");
  EXPECT_EQ(viewer_->problem(), "") << "it is said once";
  EXPECT_THROW(viewer_->endRecording(), std::runtime_error);
  EXPECT_NO_THROW(viewer_->endRecording()) << "nothing is recorded any more";
}

TEST_F(ViewerTest, ViewsAreKeptAndGoneBackTo) {
  play("drag left 300 200 340 220\nkey Ctrl+3\n");
  const Camera kept = *viewer_->state().settings.view;
  play("drag right 300 200 340 220\nclick \"Keep view\"\nkey R\nkey Shift+3\n");
  EXPECT_TRUE(isSameView(*viewer_->state().settings.view, kept));
  EXPECT_EQ(viewer_->state().settings.strategy, Strategy::kCellCut) << "Shift+3 is no strategy";
  play("set Bookmarks \"view 1\"\n");
  EXPECT_FALSE(isSameView(*viewer_->state().settings.view, kept));
  play("set Bookmarks \"view 3\"\n");
  EXPECT_TRUE(isSameView(*viewer_->state().settings.view, kept));
}

TEST_F(ViewerTest, RecentFilesOutliveTheWindow) {
  for (const char* name : {"one.glb", "two.glb"}) {
    writeFileAtomically(folder_ / name, generateRecipe(Recipe::kRooms, 8, 0));
  }
  ViewerOptions options;
  options.recentFiles = folder_ / "state" / "cellcut" / "recent";
  open(options);
  play("drop one.glb\nwait idle\ndrop two.glb\nwait idle\n");
  ASSERT_EQ(viewer_->recentFiles().list().size(), 2u);
  open(options);
  ASSERT_EQ(viewer_->recentFiles().list().size(), 2u);
  EXPECT_EQ(viewer_->recentFiles().list()[0].filename(), "two.glb");
  play("set Recent \"" + RecentFiles::nameOf(folder_ / "one.glb") + "\"\nwait idle\n");
  EXPECT_EQ(viewer_->recentFiles().list()[0].filename(), "one.glb");
  play("key Ctrl+O\nwait idle\n");
  EXPECT_EQ(viewer_->recentFiles().list()[0].filename(), "two.glb");
  EXPECT_EQ(viewer_->problem(), "");
}

TEST_F(ViewerTest, AReferenceIsMadeBesideThePicture) {
  play("wait idle\nclick Reference\nset \"Reference spp\" 16\nclick \"Make reference\"\nwait idle\n");
  ASSERT_TRUE(viewer_->reference().picture);
  EXPECT_EQ(viewer_->reference().passes, 16u);
  play("set \"Stop at spp\" 4\nwait idle\n");
  const ConvergenceRun run = viewer_->convergence().run();
  ASSERT_GT(run.points.size(), 1u);
  EXPECT_EQ(run.points.back().passes, 4u);
  EXPECT_LT(run.points.back().relmse, run.points.front().relmse);
  EXPECT_GE(run.points.back().flip, 0);
  EXPECT_EQ(run.name, "cell-cut");
  // Another strategy is another curve; another view has no reference.
  play("click \"Keep run\"\nset Strategy uniform\nset Error MSE\nset Over samples\nwait idle\nkey Ctrl+E\n");
  EXPECT_EQ(viewer_->keptRuns().size(), 1u);
  EXPECT_EQ(viewer_->convergence().run().name, "uniform");
  std::size_t tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    tables += entry.path().extension() == ".csv";
  EXPECT_EQ(tables, 1u);
  play("drag left 300 200 340 220\nwait idle\n");
  EXPECT_EQ(viewer_->widgets().find("relMSE"), nullptr);
  play("key J\nwait idle\n");
  EXPECT_NE(viewer_->widgets().find("relMSE"), nullptr);
}

TEST_F(ViewerTest, ADuelEndsWhenItsTimeIsUpAndShowsTheRatio) {
  play(
      "wait idle\nclick Reference\nset \"Reference spp\" 16\nkey J\nwait idle\nclick Duel\nset Opponent uniform\n"
      "set \"Stop at s\" 1\nset \"Duel in equal time\" on\nwait idle\n");
  const WidgetItem* ratio = viewer_->widgets().find("Ratio");
  ASSERT_NE(ratio, nullptr);
  EXPECT_GT(std::stod(ratio->value), 0);
  const std::shared_ptr<const Snapshot> left = viewer_->session().snapshot();
  EXPECT_GE(left->seconds, 1);
  EXPECT_NE(viewer_->widgets().find("Split"), nullptr);
  play("key U\nwait idle\n");
  EXPECT_EQ(viewer_->widgets().find("Split"), nullptr);
}

TEST_F(ViewerTest, LimitsPauseAndStep) {
  play("wait idle\nexpect ETA done\nset Pause on\nset \"Stop at spp\" 5\nwait idle\n");
  EXPECT_EQ(viewer_->session().snapshot()->passes, 2u);
  play("click Step\nwait idle\nkey Period\nwait idle\n");
  EXPECT_EQ(viewer_->session().snapshot()->passes, 4u);
  play("key P\nwait idle\nexpect ETA done\nset \"Stop at spp\" 0\nset \"Stop at REL\" 0.5\nwait idle\n");
  EXPECT_GE(viewer_->session().snapshot()->passes, kMinNoisePasses);
  EXPECT_LT(viewer_->session().snapshot()->noise.bound, 0.5);
  play("set \"Stop at REL\" 0\nset \"Stop at s\" 1\nwait idle\nexpect ETA done\n");
  EXPECT_GE(viewer_->session().snapshot()->seconds, 1);
}

TEST_F(ViewerTest, LessThanOnePassIsNoLimit) {
  play("set \"Stop at spp\" 0.5\n");
  ASSERT_FALSE(viewer_->state().passLimit);  // none would ever be rendered
  play("set \"Stop at s\" 0.1\nwait idle\n");
  EXPECT_GE(viewer_->session().snapshot()->passes, 1u);
}

TEST_F(ViewerTest, TheRelativeErrorIsShownWithoutALimitOnIt) {
  play("wait idle\n");
  EXPECT_EQ(viewer_->widgets().find("Relative error"), nullptr);
  play("set \"Stop at spp\" 16\nwait idle\n");
  EXPECT_NE(viewer_->widgets().find("Relative error"), nullptr);
}

TEST_F(ViewerTest, TrialsTellWhatOtherSettingsCostAndTheBestIsUsed) {
  play("wait idle\nset \"Max cut\" 64\nclick Trade\nclick \"Find best\"\nwait idle\n");
  ASSERT_TRUE(viewer_->trade().has_value());
  const std::vector<QualityTrial>& trials = viewer_->trade()->trials;
  EXPECT_EQ(trials[0].quality.settings.maxCut, 64);
  EXPECT_GE(trials.size(), 10u);  // how many of them had a pass in their seconds is the machine's to say
  EXPECT_EQ(viewer_->state().settings.sampler.maxCut, trials[viewer_->trade()->best].quality.settings.maxCut);
  // A row is a setting that can be used.
  play("click \"Trial accurate\"\nwait idle\nexpect Quality accurate\n");
  EXPECT_EQ(viewer_->state().settings.sampler.maxCut, 2048);
  // What was told of these lights says nothing of other strategies and of other depths.
  play("set \"Max depth\" 2\nwait idle\n");
  EXPECT_EQ(viewer_->widgets().find("Trial accurate"), nullptr);
  play("set Strategy uniform\nkey I\nwait idle\n");
  EXPECT_EQ(viewer_->trade()->input.settings.strategy, Strategy::kCellCut);
}

TEST_F(ViewerTest, TrialsThatAreStoppedChangeNothing) {
  play("wait idle\nset \"Max cut\" 64\nkey I\nkey I\nwait idle\n");
  EXPECT_FALSE(viewer_->trade().has_value());
  EXPECT_EQ(viewer_->state().settings.sampler.maxCut, 64);
}

}  // namespace
}  // namespace cellcut::test
