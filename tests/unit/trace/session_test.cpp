#include "renderer/trace/session.h"

#include "renderer/base/rng.h"
#include "renderer/trace/noise_watch.h"
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/support/own_threads.h"
#include "tests/support/strategies.h"

#include <chrono>
#include <map>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Pixels that differ in a bit.
std::size_t differentPixels(const ImageRgb& a, const ImageRgb& b) {
  if (a.width() != b.width() || a.height() != b.height()) return std::max(a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    using Bits = std::array<std::uint32_t, 3>;
    if (std::bit_cast<Bits>(a[i]) != std::bit_cast<Bits>(b[i])) ++different;
  }
  return different;
}

std::shared_ptr<const Scene> stageWithTwoCameras(std::uint64_t seed) {
  auto scene = std::make_shared<Scene>(stage(LightMix::kAll, 40, seed));
  scene->cameras.push_back(perspective({1.5f, 0.5f, 2.5f}, {0, -0.5f, 0}, 0.8f));
  return scene;
}

/// What `cellcut render` makes of it.
struct Headless {
  ImageRgb picture;
  RayCounts rays;
  double relativeError;
  std::size_t touchedCells;
};
Headless renderHeadless(const SessionInput& input, std::uint64_t passes) {
  RenderSettings settings = input.settings;
  settings.threads = 0;
  Renderer renderer(*input.scene, settings);
  const std::atomic<bool> never{false};
  NoiseWatch noise;
  for (std::uint64_t i = 0; i < passes; ++i) {
    renderer.renderPass(never);
    noise.look(renderer.film());
  }
  const auto grid = renderer.samplerStatistics().grid;
  return {renderer.film().mean(), renderer.rays(), noise.noise().bound, grid ? grid->made() : 0};
}

class Session : public testing::Test {
 protected:
  Session() {
    input.scene = stageWithTwoCameras(1);
    input.settings.width = 50;  // neither is a multiple of a tile or of a preview's pixel
    input.settings.height = 37;
    input.settings.maxDepth = 3;
    input.settings.threads = 3;
    input.passLimit = 2;
  }
  /// A pass that takes minutes.
  SessionInput endless() const {
    SessionInput slow = input;
    slow.scene = std::make_shared<Scene>(stage(LightMix::kTriangle, 10'000, 3));
    slow.settings.width = slow.settings.height = 1000;
    slow.settings.strategy = Strategy::kProportional;
    slow.settings.auxiliary = false;
    slow.preview = false;
    return slow;
  }

  SessionInput input;

 private:
  OnlyOwnThreads onlyOwnThreads_;
};

class SessionStrategies : public Session, public testing::WithParamInterface<SamplerVariant> {};

TEST_P(SessionStrategies, PictureIsBitForBitThatOfTheHeadlessRenderer) {
  input.settings.strategy = GetParam().strategy;
  input.settings.sampler = GetParam().settings;
  input.passLimit = 3;
  input.preview = false;
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  const auto snapshot = session.snapshot();
  const Headless headless = renderHeadless(input, 3);
  EXPECT_EQ(differentPixels(*snapshot->radiance, headless.picture), 0u);
  EXPECT_EQ(snapshot->passes, 3u);
  EXPECT_EQ(snapshot->rays.camera, headless.rays.camera);
  EXPECT_EQ(snapshot->rays.bounce, headless.rays.bounce);
  EXPECT_EQ(snapshot->rays.shadow, headless.rays.shadow);
  EXPECT_EQ(snapshot->sampler.grid ? snapshot->sampler.grid->made() : 0, headless.touchedCells);
}

INSTANTIATE_TEST_SUITE_P(Every, SessionStrategies, testing::ValuesIn(kSamplerVariants), variantName);

/// Addresses of the parts: whether they were built anew.
struct Parts {
  const Accel* accel;
  const Lights* lights;
  const LightSampler* sampler;
  const Film* film;
  bool operator==(const Parts&) const = default;
};
Parts partsOf(RenderSession& session) {
  return session.inspect([](const SessionView& v) { return Parts{&v.accel, &v.lights, &v.sampler, &v.film}; }).get();
}

TEST_F(Session, AnEditRebuildsOnlyWhatItTouches) {
  input.settings.maxDepth = 8;
  RenderSession session;
  session.edit(input);
  const Parts first = partsOf(session);
  const auto expectSame = [&](const char* what, bool sampler, bool film) {
    session.edit(input);
    const Parts now = partsOf(session);
    EXPECT_EQ(now.accel, first.accel) << what;
    EXPECT_EQ(now.lights, first.lights) << what;
    EXPECT_EQ(now.sampler == first.sampler, sampler) << what;
    EXPECT_EQ(now.film == first.film, film) << what;
    session.waitIdle();
    EXPECT_EQ(differentPixels(*session.snapshot()->radiance, renderHeadless(input, 2).picture), 0u) << what;
  };
  input.settings.view = input.scene->cameras[1];
  expectSame("camera", true, true);
  input.settings.maxDepth = 4;
  expectSame("depth", true, true);
  input.settings.seed = 5;
  expectSame("seed", true, true);
  input.settings.sampling = PixelSampling::kIndependent;
  expectSame("points", true, true);
  input.settings.threads = 2;
  expectSame("threads", true, true);
  input.settings.width = 61;
  expectSame("size", true, false);
  input.settings.sampler.gridResolution = 5;
  expectSame("grid", false, false);
  input.scene = stageWithTwoCameras(2);
  session.edit(input);
  const Parts other = partsOf(session);
  EXPECT_NE(other.accel, first.accel);
  EXPECT_NE(other.lights, first.lights);
}

TEST_F(Session, RandomEditsEndInTheRightPicture) {
  const std::array scenes{input.scene, stageWithTwoCameras(2), stageWithTwoCameras(3)};
  std::map<std::uint64_t, SessionInput> inputs;
  Rng rng(11);
  const auto pick = [&](int n) { return static_cast<int>(rng.uniform() * static_cast<float>(n)); };
  const auto change = [&] {
    RenderSettings& s = input.settings;
    switch (pick(9)) {
      case 0:
        s.strategy = kStrategies[static_cast<std::size_t>(pick(6))].strategy;
        break;
      case 1:
        s.width = 1 + pick(80), s.height = 1 + pick(60);
        break;
      case 2:
        s.view = perspective({static_cast<float>(pick(3)) - 1.5f, 0.5f, 2.5f}, {0, -0.5f, 0}, 0.8f);
        break;
      case 3:
        s.camera = static_cast<std::size_t>(pick(2)), s.view.reset();
        break;
      case 4:
        s.maxDepth = pick(6);
        break;
      case 5:
        s.sampler.maxCut = 2 + pick(30), s.sampler.gridResolution = 1 + pick(20);
        break;
      case 6:
        input.scene = scenes[static_cast<std::size_t>(pick(3))];
        break;
      case 7:
        s.threads = 1 + pick(4), s.auxiliary = pick(2) == 0;
        break;
      case 8:
        input.paused = !input.paused, input.layers = pick(2) == 0;
        break;
    }
  };
  RenderSession session;
  const std::size_t edits = byDepth(200, 10'000);
  for (std::size_t i = 1; i <= edits; ++i) {
    change();
    ASSERT_EQ(session.edit(input), i);
    inputs[i] = input;
    if (pick(3) == 0) std::this_thread::sleep_for(std::chrono::microseconds(pick(20'000)));
    if (pick(10) == 0) session.singleStep();
    const auto seen = session.snapshot();
    if (seen->passes > 0) {
      const RenderSettings& asked = inputs.at(seen->generation).settings;
      EXPECT_EQ(seen->width, asked.width);
      EXPECT_EQ(seen->height, asked.height);
      EXPECT_EQ(seen->error, "");
    }
    if (i % 20 != 0) continue;
    input.paused = false;
    input.passLimit = 1 + static_cast<std::uint64_t>(pick(3));
    const std::uint64_t generation = session.edit(input);
    inputs[++i] = input;
    session.waitIdle();
    const auto last = session.snapshot();
    EXPECT_EQ(last->generation, generation);
    EXPECT_FALSE(last->preview);
    EXPECT_GE(last->passes, *input.passLimit);
    EXPECT_EQ(differentPixels(*last->radiance, renderHeadless(input, last->passes).picture), 0u) << "edit " << i;
  }
}

TEST_F(Session, EverySnapshotShowsThePictureOfItsGeneration) {
  std::mutex mutex;
  std::vector<std::shared_ptr<const Snapshot>> seen;
  std::vector<SessionInput> inputs;
  RenderSession* current = nullptr;
  RenderSession session([&] {
    const std::lock_guard lock(mutex);
    if (current) seen.push_back(current->snapshot());
  });
  {
    const std::lock_guard lock(mutex);
    current = &session;
  }
  input.passLimit.reset();
  for (int i = 0; i < 12; ++i) {
    input.settings.seed = static_cast<std::uint64_t>(i);
    session.edit(input);
    inputs.push_back(input);
    // Some edits come in the middle of passes, some after a few.
    if (i % 3 == 0) session.waitPasses(2);
    if (i % 3 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  session.waitPasses(1);
  input.paused = true;
  session.edit(input);
  inputs.push_back(input);
  session.waitIdle();
  const std::lock_guard lock(mutex);
  std::size_t full = 0;
  for (const auto& snapshot : seen) {
    const SessionInput& of = inputs.at(snapshot->generation - 1);
    if (snapshot->preview) continue;
    ++full;
    EXPECT_EQ(differentPixels(*snapshot->radiance, renderHeadless(of, snapshot->passes).picture), 0u);
    if (full > 40) break;
  }
  EXPECT_GT(full, 0u);
}

TEST_F(Session, StartsAndStopsAtAnyMoment) {
  Rng rng(3);
  for (std::size_t i = 0; i < byDepth(100, 1000); ++i) {
    RenderSession session;
    if (i % 10 == 0) continue;
    input.passLimit.reset();
    session.edit(i % 4 == 0 ? endless() : input);
    const auto wait = std::chrono::microseconds(static_cast<int>(rng.uniform() * 5000));
    if (i % 2 == 0) std::this_thread::sleep_for(wait);
    if (i % 5 == 0) session.edit(input);
  }
}

TEST_F(Session, ShowsACoarsePictureFirst) {
  std::mutex mutex;
  std::vector<std::shared_ptr<const Snapshot>> seen;
  RenderSession* current = nullptr;
  const auto look = [&] {
    const std::lock_guard lock(mutex);
    if (current) seen.push_back(current->snapshot());
  };
  RenderSession session(look);
  {
    const std::lock_guard lock(mutex);
    current = &session;
  }
  session.edit(input);
  session.waitIdle();
  const std::lock_guard lock(mutex);
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_TRUE(seen[0]->preview);
  EXPECT_EQ(seen[0]->radiance->width(), 13);
  EXPECT_EQ(seen[0]->radiance->height(), 10);
  EXPECT_EQ(seen[0]->width, 50);
  EXPECT_EQ(seen[0]->height, 37);
  EXPECT_EQ(seen[0]->passes, 1u);
  EXPECT_GT(seen[0]->rays.shadow, 0u);
  for (std::size_t i : {1u, 2u}) {
    EXPECT_FALSE(seen[i]->preview);
    EXPECT_EQ(seen[i]->passes, i);
    EXPECT_EQ(seen[i]->radiance->width(), 50);
  }
  // The preview is the same view: a picture of as many pixels.
  SessionInput small = input;
  small.settings.width = 13;
  small.settings.height = 10;
  EXPECT_EQ(differentPixels(*seen[0]->radiance, renderHeadless(small, 1).picture), 0u);
}

TEST_F(Session, APauseBeforeTheFirstPassIsAnswered) {
  SessionInput slow = endless();
  slow.preview = true;
  slow.settings.width = slow.settings.height = 100;
  slow.settings.maxDepth = 1;  // a pass takes seconds, the preview few even of a core that others use
  RenderSession session;
  const std::uint64_t begun = session.edit(slow);
  // Its preview is there, its first pass under way.
  while (session.snapshot()->generation < begun || session.state() != SessionState::kRendering) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(session.snapshot()->preview);
  slow.paused = true;
  const std::uint64_t paused = session.edit(slow);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->generation, paused);
}

TEST_F(Session, PausesAfterThePreviewStepsAndResumesWhereItWas) {
  input.paused = true;
  input.passLimit = 5;
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  EXPECT_TRUE(session.snapshot()->preview);
  EXPECT_EQ(session.state(), SessionState::kIdle);
  for (std::uint64_t step : {1u, 2u, 3u}) {
    session.singleStep();
    session.waitIdle();
    EXPECT_FALSE(session.snapshot()->preview);
    EXPECT_EQ(session.snapshot()->passes, step);
  }
  const Film* film = partsOf(session).film;
  input.paused = false;
  const std::uint64_t resumed = session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->generation, resumed);
  EXPECT_EQ(session.snapshot()->passes, 5u);
  EXPECT_EQ(partsOf(session).film, film);
  EXPECT_EQ(differentPixels(*session.snapshot()->radiance, renderHeadless(input, 5).picture), 0u);
  // Past the limit there is no step.
  input.paused = true;
  session.edit(input);
  session.singleStep();
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 5u);
}

TEST_F(Session, AStepThatWasAskedForBeforeAnEditIsNotTakenAfterIt) {
  input.paused = true;
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  // Holds the driver, so that both are waiting when it looks.
  std::promise<void> release;
  const auto held = session.inspect([&](const SessionView&) { release.get_future().wait(); });
  session.singleStep();
  input.settings.seed = 1;
  session.edit(input);
  release.set_value();
  session.waitIdle();
  EXPECT_TRUE(session.snapshot()->preview);
}

TEST_F(Session, ALimitThatIsRaisedGoesOnWithTheSamePicture) {
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 2u);
  input.passLimit = 4;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 4u);
  EXPECT_EQ(session.snapshot()->rays.camera, 4u * 50 * 37);
  // One that is lowered takes nothing away.
  input.passLimit = 1;
  const std::uint64_t lowered = session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 4u);
  EXPECT_EQ(session.snapshot()->generation, lowered);
}

TEST_F(Session, StopsAtLimitsOfTimeAndNoise) {
  RenderSession session;
  input.passLimit.reset();
  input.timeLimit = 1e-9;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 1u);
  EXPECT_GT(session.snapshot()->seconds, 0);

  input.timeLimit.reset();
  input.noiseLimit = 1e9;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, kMinNoisePasses);

  input.noiseLimit = 0.9 * session.snapshot()->noise.bound;
  session.edit(input);
  session.waitIdle();
  EXPECT_GT(session.snapshot()->passes, kMinNoisePasses);
  EXPECT_LT(session.snapshot()->noise.bound, *input.noiseLimit);
  EXPECT_GE(renderHeadless(input, session.snapshot()->passes - 1).relativeError, *input.noiseLimit);
}

TEST_F(Session, NoiseIsThatOfTheHeadlessRendererWhereItIsAskedFor) {
  input.passLimit = 21;
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->noise.bound, std::numeric_limits<double>::infinity());
  input.noise = true;
  input.settings.seed = 1;
  session.edit(input);
  session.waitIdle();
  EXPECT_LT(session.snapshot()->noise.bound, 10);
  EXPECT_EQ(session.snapshot()->noise.bound, renderHeadless(input, 21).relativeError);
  // A picture that starts again is looked at anew.
  input.settings.seed = 2;
  input.passLimit = 3;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->noise.bound, std::numeric_limits<double>::infinity());
}

TEST_F(Session, WhatCannotBeRenderedIsRefusedAndTheOldPictureGoesOn) {
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  const auto before = session.snapshot();
  const Parts parts = partsOf(session);

  SessionInput noCamera = input, noScene = input, tooLarge = input;
  noCamera.settings.camera = 9;
  noScene.scene = nullptr;
  tooLarge.settings.width = tooLarge.settings.height = std::numeric_limits<int>::max();
  tooLarge.scene = stageWithTwoCameras(2);
  tooLarge.settings.strategy = Strategy::kPower;
  for (const SessionInput& bad : {noCamera, noScene, tooLarge}) {
    const std::uint64_t generation = session.edit(bad);
    session.waitIdle();
    EXPECT_EQ(session.snapshot()->generation, generation);
    EXPECT_NE(session.snapshot()->error, "");
    EXPECT_EQ(session.snapshot()->radiance, before->radiance);
    EXPECT_EQ(session.snapshot()->passes, 2u);
    EXPECT_EQ(partsOf(session), parts);
  }
  session.edit(noCamera);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->error, "camera 9: the scene has 2; choose one of these");

  input.passLimit = 3;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->error, "");
  EXPECT_EQ(session.snapshot()->passes, 3u);
  EXPECT_EQ(differentPixels(*session.snapshot()->radiance, renderHeadless(input, 3).picture), 0u);
}

TEST_F(Session, ARefusedEditDoesNotStopARenderingThatGoesOn) {
  input.passLimit.reset();
  RenderSession session;
  session.edit(input);
  ASSERT_TRUE(session.waitPasses(2));
  SessionInput bad = input;
  bad.settings.camera = 9;
  const std::uint64_t generation = session.edit(bad);
  const std::uint64_t passes = session.waitPasses(1)->passes;
  const auto later = session.waitPasses(passes + 3);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->generation, generation);
  EXPECT_NE(later->error, "");
  EXPECT_EQ(differentPixels(*later->radiance, renderHeadless(input, later->passes).picture), 0u);
}

TEST_F(Session, AFirstEditThatIsRefusedLeavesNoPicture) {
  RenderSession session;
  EXPECT_EQ(session.snapshot()->generation, 0u);
  session.edit({});
  auto inspected = session.inspect([](const SessionView&) { return 1; });
  session.singleStep();
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->generation, 1u);
  EXPECT_EQ(session.snapshot()->error, "scene: there is none; open one");
  EXPECT_TRUE(session.snapshot()->radiance->empty());
  EXPECT_THROW(inspected.get(), std::future_error);
}

TEST_F(Session, EditsThatArriveMeanwhileAreOne) {
  input.preview = false;  // how many there are depends on how long they take
  std::mutex mutex;
  std::vector<std::uint64_t> generations;
  RenderSession* current = nullptr;
  RenderSession session([&] {
    const std::lock_guard lock(mutex);
    if (current) generations.push_back(current->snapshot()->generation);
  });
  {
    const std::lock_guard lock(mutex);
    current = &session;
  }
  session.edit(input);
  session.waitIdle();
  std::promise<void> release;
  const auto held = session.inspect([&](const SessionView&) { release.get_future().wait(); });
  for (std::uint64_t i = 1; i <= 50; ++i) {
    input.settings.seed = i;
    session.edit(input);
  }
  release.set_value();
  session.waitIdle();
  const std::lock_guard lock(mutex);
  EXPECT_EQ(generations, (std::vector<std::uint64_t>{1, 1, 51, 51}));
  EXPECT_EQ(differentPixels(*session.snapshot()->radiance, renderHeadless(input, 2).picture), 0u);
}

TEST_F(Session, AnEditStopsAPassThatWouldTakeMinutes) {
  RenderSession session;
  session.edit(endless());
  while (session.state() != SessionState::kRendering) std::this_thread::yield();
  const std::uint64_t generation = session.edit(input);
  const auto snapshot = session.waitPasses(2);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->generation, generation);
}

TEST_F(Session, IsInspectedWhileAPassGoesOn) {
  RenderSession session;
  session.edit(endless());
  while (session.state() != SessionState::kRendering) std::this_thread::yield();
  const auto look = [](const SessionView& v) { return std::tuple(v.generation, v.film.passes(), v.lights.size()); };
  const auto [generation, passes, lights] = session.inspect(look).get();
  EXPECT_EQ(generation, 1u);
  EXPECT_EQ(passes, 0u);
  EXPECT_EQ(lights, 10'000u);
  EXPECT_EQ(session.state(), SessionState::kRendering);
}

TEST_F(Session, InspectionSeesTheEditBeforeItAndItsExceptionsComeOut) {
  RenderSession session;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    input.settings.seed = seed;
    session.edit(input);
    EXPECT_EQ(session.inspect([](const SessionView& v) { return v.settings.seed; }).get(), seed);
  }
  auto thrown = session.inspect([](const SessionView&) -> int { throw std::runtime_error("no"); });
  EXPECT_THROW(thrown.get(), std::runtime_error);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->error, "");
  EXPECT_EQ(session.snapshot()->passes, 2u);
}

/// A function that waits to be told to stop, for a minute: whether it was. Returns when it has begun.
std::future<bool> waitForCancel(RenderSession& session) {
  std::promise<void> begun;
  std::future<void> hasBegun = begun.get_future();
  auto cancelled = session.inspect([begun = std::move(begun)](const SessionView& view) mutable {
    begun.set_value();
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!view.cancel && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return view.cancel.load();
  });
  hasBegun.wait();
  return cancelled;
}

TEST_F(Session, AnEditStopsAnInspectionAtRestAndBesideAPreviewAndAPass) {
  SessionInput slowPreview = endless();
  slowPreview.preview = true;
  const std::array<std::pair<SessionInput, SessionState>, 3> cases{
      {{input, SessionState::kIdle}, {slowPreview, SessionState::kPreview}, {endless(), SessionState::kRendering}}};
  for (const auto& [first, state] : cases) {
    RenderSession session;
    session.edit(first);
    if (state == SessionState::kIdle) session.waitIdle();
    while (session.state() != state) std::this_thread::yield();
    std::future<bool> cancelled = waitForCancel(session);
    const std::uint64_t generation = session.edit(input);
    EXPECT_TRUE(cancelled.get());
    // The next one may take its time.
    const auto look = [](const SessionView& v) { return std::pair(v.generation, v.cancel.load()); };
    EXPECT_EQ(session.inspect(look).get(), std::pair(generation, false));
  }
}

TEST_F(Session, ItsEndStopsAnInspection) {
  std::future<bool> cancelled;
  {
    RenderSession session;
    session.edit(input);
    cancelled = waitForCancel(session);
  }
  EXPECT_TRUE(cancelled.get());
}

TEST_F(Session, AnInspectionThatNobodyComesToIsBroken) {
  std::future<int> never;
  {
    RenderSession session;
    never = session.inspect([](const SessionView&) { return 1; });
  }
  EXPECT_THROW(never.get(), std::future_error);
}

TEST_F(Session, LayersComeWhenTheyAreAskedFor) {
  RenderSession session;
  session.edit(input);
  session.waitIdle();
  EXPECT_FALSE(session.snapshot()->layers);
  input.layers = true;
  session.edit(input);
  session.waitIdle();
  EXPECT_EQ(session.snapshot()->passes, 2u);
  ASSERT_TRUE(session.snapshot()->layers);
  EXPECT_EQ(session.snapshot()->layers->layers.size(), 5u);
}

}  // namespace
}  // namespace cellcut::test
