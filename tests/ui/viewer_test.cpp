#include "ui/viewer/viewer.h"

#include "renderer/scene/camera.h"
#include "renderer/scene/recipes/recipe.h"
#include "tests/support/restrictions.h"
#include "tests/ui/viewer_fixture.h"
#include "ui/gl_error.h"
#include "ui/memory_window.h"

#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>

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
    EXPECT_FALSE(sameView(*viewer_->state().settings.view, start)) << move;
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
  EXPECT_THAT(viewer_->problem(), HasSubstr("saved"));
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
}

TEST_F(ViewerTest, ScriptsNameTheLineThatFails) {
  EXPECT_THAT(refusalOf("wait idle\nexpect Strategy power\n"), HasSubstr("script.txt:2"));
  EXPECT_THAT(refusalOf("jump\n"), HasSubstr("no action 'jump'"));
  EXPECT_THAT(refusalOf("click \"Max\n"), HasSubstr("a quote has no end"));
  EXPECT_THAT(refusalOf("size 10 x\n"), HasSubstr("is no number"));
  EXPECT_THAT(refusalOf("wait for it\n"), HasSubstr("'wait' is followed by"));
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
  ScriptPlayer(record, readScript(record), folder_.path()).play(*viewer_, *window_);
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
  EXPECT_TRUE(sameView(*viewer_->state().settings.view, kept));
  EXPECT_EQ(viewer_->state().settings.strategy, Strategy::kCellCut) << "Shift+3 is no strategy";
  play("set Bookmarks \"view 1\"\n");
  EXPECT_FALSE(sameView(*viewer_->state().settings.view, kept));
  play("set Bookmarks \"view 3\"\n");
  EXPECT_TRUE(sameView(*viewer_->state().settings.view, kept));
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

TEST_F(ViewerTest, AWindowWithoutAreaIsNoReasonToStop) {
  play("wait idle\n");
  window_->post(KeyChange{Key::kW, true});
  viewer_->frame(1.0 / 60);
  for (const PixelSize size : {PixelSize{0, 0}, PixelSize{300, 0}, PixelSize{0, 300}}) {
    window_->resize(size);
    viewer_->frame(1.0 / 60);
    EXPECT_GT(viewer_->sleepSeconds(), 0) << "nothing is drawn: it sleeps";
  }
  window_->post(KeyChange{Key::kW, false});
  viewer_->frame(1.0 / 60);
  window_->resize({400, 720});
  play("wait idle\n");
  const Camera there = *viewer_->state().settings.view;
  play("wait idle\n");
  EXPECT_TRUE(sameView(*viewer_->state().settings.view, there)) << "the key that was released flies no farther";
  window_->resize({1, 1});
  play("wait idle\nsize 400 720\nwait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
}

/// A window whose context is lost for some frames.
class FlakyWindow final : public MemoryWindow {
 public:
  explicit FlakyWindow(PixelSize size) : MemoryWindow(size), inner_(openWindow(WindowKind::kEgl, {.size = size})) {}
  WindowKind kind() const override { return inner_->kind(); }
  void makeCurrent() override {
    if (lost) throw GlError("the context is lost");
    inner_->makeCurrent();
  }
  bool lost = false;

 private:
  std::unique_ptr<Window> inner_;
};

TEST_F(ViewerTest, AContextThatFailsIsWaitedForAndThenGivenUp) {
  viewer_.reset();
  auto flaky = std::make_unique<FlakyWindow>(PixelSize{400, 720});
  FlakyWindow& window = *flaky;
  window_ = std::move(flaky);
  open({});
  play("wait idle\n");
  window.lost = true;
  for (int i = 0; i < 5; ++i) viewer_->frame(1.0 / 60);
  EXPECT_THAT(viewer_->problem(), HasSubstr("lost"));
  window.lost = false;
  play("click Dismiss\nwait idle\nset Strategy power\nwait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
  // A framebuffer that no driver has.
  window.resize({100'000, 100'000});
  viewer_->frame(1.0 / 60);
  EXPECT_NE(viewer_->problem(), "");
  window.resize({400, 720});
  play("click Dismiss\nwait idle\n");
  window.lost = true;
  const auto forEver = [this] {
    for (int i = 0; i < 1000; ++i) viewer_->frame(1.0 / 60);
  };
  EXPECT_THROW(forEver(), GlError);
  window.lost = false;  // for what the viewer gives back
  window.makeCurrent();
}

/// A window that holds every thread that wakes it: nothing beside the UI gets on, as if a scene were being built.
class HoldingWindow final : public MemoryWindow {
 public:
  explicit HoldingWindow(PixelSize size) : MemoryWindow(size), inner_(openWindow(WindowKind::kEgl, {.size = size})) {}
  WindowKind kind() const override { return inner_->kind(); }
  void makeCurrent() override {
    inner_->makeCurrent();
    const std::lock_guard lock(mutex_);
    lastFrame_ = Clock::now();
  }
  void wake() noexcept override {
    std::unique_lock lock(mutex_);
    ++held_;
    // A UI that draws no frame waits for us: it is let go on, and found out.
    while (!free_ && !stuck_) {
      released_.wait_until(lock, lastFrame_ + kPatience);
      stuck_ = !free_ && Clock::now() >= lastFrame_ + kPatience;
    }
    --held_;
    lock.unlock();
    MemoryWindow::wake();
  }
  void release() {
    const std::lock_guard lock(mutex_);
    free_ = true;
    released_.notify_all();
  }
  int held() const {
    const std::lock_guard lock(mutex_);
    return held_;
  }
  /// Whether the UI has drawn nothing for two minutes while threads were held.
  bool stuck() const {
    const std::lock_guard lock(mutex_);
    return stuck_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kPatience{2};  ///< of any frame, on a busy machine
  std::unique_ptr<Window> inner_;
  mutable std::mutex mutex_;
  std::condition_variable released_;
  Clock::time_point lastFrame_ = Clock::now();
  int held_ = 0;
  bool free_ = false, stuck_ = false;
};

TEST_F(ViewerTest, SessionsThatEndAreNotWaitedFor) {
  viewer_.reset();
  auto holding = std::make_unique<HoldingWindow>(PixelSize{400, 720});
  HoldingWindow& window = *holding;
  window_ = std::move(holding);
  open({});
  const auto untilHeld = [&](int sessions) {
    while (window.held() < sessions && !window.stuck()) {
      viewer_->frame(1.0 / 60);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  };
  untilHeld(1);
  viewer_->state().duel = true;
  untilHeld(2);
  window.post(KeyChange{Key::kJ, true});
  window.post(KeyChange{Key::kJ, false});
  untilHeld(3);
  // The picture, the duel and the reference stand still. All of them are edited and ended, again and again.
  for (int i = 0; i < 3; ++i) {
    viewer_->state().duel = false;
    viewer_->state().settings.strategy = Strategy::kPower;
    viewer_->frame(1.0 / 60);
    viewer_->state().duel = true;
    viewer_->state().opponent = Strategy::kUniform;
    window.post(KeyChange{Key::kJ, true});
    window.post(KeyChange{Key::kJ, false});
    for (int frame = 0; frame < 5; ++frame) viewer_->frame(1.0 / 60);
  }
  viewer_->state().duel = false;
  viewer_->frame(1.0 / 60);
  EXPECT_FALSE(window.stuck());
  window.release();
  play("wait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
  EXPECT_TRUE(viewer_->session().snapshot()->sampler.grid == std::nullopt);
}

}  // namespace
}  // namespace cellcut::test
