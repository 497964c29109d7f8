/// What a viewer shows after any edits at any moment.
#include "renderer/base/rng.h"
#include "renderer/base/srgb.h"
#include "renderer/base/tone_map.h"
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/ui/viewer_fixture.h"

#include <array>
#include <chrono>
#include <cmath>
#include <mutex>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

class RandomEdits : public ViewerTest {
 protected:
  RandomEdits() {
    viewer_.reset();
    loaded_ = scene_ = sceneWith(40, 3);
    ViewerOptions options = optionsOfTests();
    options.file = "a.glb";
    viewer_ = std::make_unique<Viewer>(
        *window_, scene_, [this](const std::filesystem::path& file) { return load(file); }, options);
  }
  ~RandomEdits() override { viewer_.reset(); }  // its loader uses what is below

  void editAtRandom();
  /// Nothing but the picture is shown, and it is rendered to its end.
  void comeToRest();
  /// That the window shows the picture of the newest edit, as it is made without a viewer.
  void expectPictureOfNewestEdit() const;

 private:
  static std::shared_ptr<const Scene> sceneWith(int lights, std::uint64_t seed) {
    auto scene = std::make_shared<Scene>(stage(LightMix::kAll, lights, seed));
    scene->cameras.push_back(perspective({1.5f, 0.5f, 2.5f}, {0, -0.5f, 0}, 0.8f));
    return scene;
  }
  /// Another object each time, as a file is.
  std::shared_ptr<const Scene> load(const std::filesystem::path& file) {
    if (file == "bad.glb") throw InputError(file.string(), "is no scene");
    std::shared_ptr<const Scene> scene = file == "a.glb" ? sceneWith(40, 3) : sceneWith(15, 4);
    const std::lock_guard lock(mutex_);
    loaded_ = scene;
    return scene;
  }
  std::shared_ptr<const Scene> loaded() const {
    const std::lock_guard lock(mutex_);
    return loaded_;
  }
  int below(int n) { return static_cast<int>(rng_.below(static_cast<std::uint32_t>(n))); }
  void press(Key key) {
    window_->post(KeyChange{key, true});
    window_->post(KeyChange{key, false});
  }
  void editSampler();
  void editView();
  void editWindow();
  void editWhatIsMeasured();

  Rng rng_{7};
  mutable std::mutex mutex_;
  std::shared_ptr<const Scene> loaded_;  ///< the newest that could be used; guarded by mutex_
};

void RandomEdits::editSampler() {
  ViewerState& state = viewer_->state();
  RenderSettings& s = state.settings;
  switch (below(8)) {
    case 0:
    case 1:
      s.strategy = kStrategies[rng_.below(kStrategies.size())].strategy;
      break;
    case 2:
      s.sampler.maxCut = 2 + below(60);
      break;
    case 3:
      s.sampler.gridResolution = 1 + below(40);
      break;
    case 4:
      s.sampler.threshold = rng_.uniform(0, 0.1f);
      break;
    case 5:
      s.sampler.inCluster = below(2) == 0 ? InCluster::kIntensity : InCluster::kDescent;
      break;
    case 6:
      s.maxDepth = below(4);
      break;
    case 7:
      s.seed = static_cast<std::uint64_t>(below(100));
      break;
  }
}

void RandomEdits::editView() {
  ViewerState& state = viewer_->state();
  switch (below(7)) {
    case 0:
      state.settings.view = dollied(poseOf(scene_->cameras[0], scene_->bounds), rng_.uniform(-1, 1)).camera;
      break;
    case 1:
      state.settings.view =
          orbited(poseOf(scene_->cameras[1], scene_->bounds), {rng_.uniform(-1, 1), rng_.uniform(-0.2f, 0.2f)}).camera;
      break;
    case 2:
      state.settings.camera = static_cast<std::size_t>(below(2));
      state.settings.view.reset();
      break;
    case 3:
      press(Key::kR);
      break;
    case 4:
      state.display.exposure = rng_.uniform(-4, 4);
      break;
    case 5:
      state.display.toneMap = below(2) == 0;
      break;
    case 6:
      window_->post(MouseMove{{250, 100}});
      window_->post(Scroll{{0, rng_.uniform(-1, 1)}});
      break;
  }
}

void RandomEdits::editWindow() {
  switch (below(5)) {
    case 0:
      window_->resize({260 + below(80), 160 + below(80)});
      break;
    case 1:
      window_->postDrop(std::array{"a.glb", "b.glb", "bad.glb"}[rng_.below(3)]);
      break;
    case 2:
      press(Key::kF5);
      break;
    case 3:
      press(std::array{Key::kF1, Key::kF2, Key::kT, Key::kPeriod}[rng_.below(4)]);
      break;
    case 4:
      window_->post(MouseMove{Vec2(below(260), below(160))});
      press(Key::kF);
      break;
  }
}

void RandomEdits::editWhatIsMeasured() {
  ViewerState& state = viewer_->state();
  switch (below(10)) {
    case 0:
    case 1:
      state.overlay.overlay = static_cast<Overlay>(rng_.below(kOverlays.size()));
      break;
    case 2:
      state.overlay.grid = !state.overlay.grid;
      state.overlay.slice.axis = static_cast<SliceAxis>(rng_.below(4));
      break;
    case 3:
      state.pick = glm::ivec2(below(300), below(300));
      state.selectedCluster = rng_.below(3);
      break;
    case 4:
      press(std::array{Key::kL, Key::kM, Key::kN}[rng_.below(3)]);
      break;
    case 5:
      state.paused = !state.paused;
      break;
    case 6:
      state.passLimit = 1 + rng_.below(3);
      break;
    case 7:
      state.duel = below(2) == 0;
      state.opponent = kStrategies[rng_.below(kStrategies.size())].strategy;
      break;
    case 8:
      press(Key::kJ);
      break;
    case 9:
      press(Key::kI);
      break;
  }
}

void RandomEdits::editAtRandom() {
  switch (below(4)) {
    case 0:
      return editSampler();
    case 1:
      return editView();
    case 2:
      return editWindow();
    case 3:
      return editWhatIsMeasured();
  }
}

void RandomEdits::comeToRest() {
  ViewerState& state = viewer_->state();
  // A duel gives its left picture more samples than the limit: another noise begins anew.
  if (state.duel) state.settings.seed += 100;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  for (int quiet = 0; quiet < 5; ++quiet) {
    // Anew in each frame: keys that were pressed are still being read. What the pointer rests on may explain itself over
    // the picture.
    window_->post(MouseLeave{});
    state.duel = state.paused = state.showHelp = false;
    state.overlay = {};
    state.pick.reset();
    state.display.split = 1;
    viewer_->frame(1.0 / 60);
    if (viewer_->settled() && viewer_->session().atRest()) continue;
    quiet = -1;
    ASSERT_LT(std::chrono::steady_clock::now(), end) << "it does not come to rest";
    window_->waitEvents(0.02);
  }
}

ImageRgb renderHeadless(const Scene& scene, const RenderSettings& settings, std::uint64_t passes) {
  Renderer renderer(scene, settings);
  const std::atomic<bool> never{false};
  for (std::uint64_t i = 0; i < passes; ++i) renderer.renderPass(never);
  return renderer.film().mean();
}

void RandomEdits::expectPictureOfNewestEdit() const {
  const ViewerState& state = viewer_->state();
  const RenderSettings& settings = state.settings;
  const std::shared_ptr<const Snapshot> made = viewer_->session().snapshot();
  EXPECT_EQ(made->error, "");
  EXPECT_GE(made->passes, state.passLimit);
  ASSERT_EQ(made->width, settings.width);
  ASSERT_EQ(made->height, settings.height);
  const ImageRgb expected = renderHeadless(*loaded(), settings, made->passes);
  ASSERT_EQ(expected.size(), made->radiance->size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) different += expected[i] != (*made->radiance)[i];
  EXPECT_EQ(different, 0u) << "of the rendering";

  const ImageRgba8 window = viewer_->picture();
  const glm::ivec2 corner(viewer_->placement().origin);
  ASSERT_EQ(viewer_->placement().scale, 1);
  different = 0;
  for (int y = 0; y < expected.height(); ++y)
    for (int x = 0; x < expected.width(); ++x) {
      const Vec3 c = std::exp2(state.display.exposure) * expected.at(x, y);
      const auto seen = window.at(corner.x + x, corner.y + y);
      for (int k = 0; k < 3; ++k) {
        const float display = state.display.toneMap ? toneMap(c)[k] : linearToSrgb(std::min(c[k], 1.0f));
        // OpenGL's pow() rounds in its own way.
        if (std::abs(static_cast<float>(seen[k]) - 255 * display) > 1.5f) ++different;
      }
    }
  EXPECT_EQ(different, 0u) << "of the window";
}

TEST_F(RandomEdits, EndWithThePictureOfTheNewestEdit) {
  const std::size_t edits = byDepth(240, 10'000), editsPerLook = byDepth(40, 100);
  for (std::size_t i = 1; i <= edits && !HasFailure(); ++i) {
    editAtRandom();
    viewer_->frame(1.0 / 60);
    if (i % editsPerLook != 0) continue;
    comeToRest();
    if (HasFailure()) return;
    expectPictureOfNewestEdit();
    EXPECT_FALSE(HasFailure()) << "after edit " << i;
  }
}

}  // namespace
}  // namespace cellcut::test
