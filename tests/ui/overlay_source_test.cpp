#include "ui/viewer/overlay_source.h"

#include "renderer/trace/session.h"
#include "tests/support/own_threads.h"
#include "tests/support/scenes.h"

#include <array>
#include <cstddef>
#include <future>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

class OverlaySourceTest : public testing::Test {
 protected:
  OverlaySourceTest() {
    input_.settings.width = 40;
    input_.settings.height = 30;
    input_.settings.maxDepth = 1;
    input_.settings.threads = 1;
    input_.passLimit = 2;
    show(std::make_shared<const Scene>(stage(LightMix::kAll, 40, 3)));
  }

  struct Asked {
    OverlayChoice choice;
    std::optional<glm::ivec2> pick;
  };
  void request(const Asked& asked) { source_.request(session_, asked.choice, asked.pick, nullptr); }
  std::optional<OverlayPicture> answer() {
    source_.wait();
    return source_.take();
  }

  /// Keeps the session's thread from anything else.
  struct Hold {
    std::promise<void> release;
    std::future<void> reached;
  };
  Hold hold() {
    Hold hold;
    std::promise<void> reached;
    hold.reached = reached.get_future();
    session_.inspect([reached = std::move(reached), release = hold.release.get_future()](const SessionView&) mutable {
      reached.set_value();
      release.wait();
    });
    return hold;
  }

  /// In the memory where the last one lay, which must be gone.
  std::shared_ptr<const Scene> sceneInTheSamePlace(Scene scene) {
    return {new (place_.data()) Scene(std::move(scene)), [](const Scene* s) { s->~Scene(); }};
  }
  void show(std::shared_ptr<const Scene> scene) {
    input_.scene = std::move(scene);
    session_.edit(input_);
    session_.waitIdle();
  }

  OnlyOwnThreads onlyOwnThreads_;
  alignas(Scene) std::array<std::byte, sizeof(Scene)> place_;
  SessionInput input_;
  OverlaySource source_;
  RenderSession session_;
};

TEST_F(OverlaySourceTest, AnEditStopsARequestWhichIsAnsweredWhenItIsMadeAgain) {
  const Asked hits{}, cells{.choice = {.overlay = Overlay::kCutSize}}, film{.choice = {.overlay = Overlay::kVariance}};
  const Asked plane{.choice = {.overlay = Overlay::kCutSize, .slice = {.axis = SliceAxis::kY}}};
  const Asked cut{.pick = glm::ivec2(20, 20)};
  for (const Asked& asked : {hits, cells, film, plane, cut}) {
    // The request is taken from the queue together with what holds it up, so that the edit comes when its turn has come.
    Hold first = hold();
    first.reached.wait();
    Hold second = hold();
    request(asked);
    first.release.set_value();
    second.reached.wait();
    ++input_.settings.seed;
    const std::uint64_t generation = session_.edit(input_);
    second.release.set_value();
    EXPECT_FALSE(answer());
    EXPECT_FALSE(source_.busy());

    session_.waitIdle();
    request(asked);
    const std::optional<OverlayPicture> picture = answer();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->generation, generation);
    EXPECT_EQ(picture->statistics.count > 0, asked.choice.overlay != Overlay::kNone);
    EXPECT_EQ(picture->inspection.has_value(), asked.pick.has_value());
  }
}

TEST_F(OverlaySourceTest, AnEditWaitsForTheLayersOfAFile) {
  Hold first = hold();
  first.reached.wait();
  Hold second = hold();
  std::future<LayeredImage> layers = source_.layers(session_);
  first.release.set_value();
  second.reached.wait();
  session_.edit(input_);
  second.release.set_value();
  EXPECT_EQ(layers.get().width, input_.settings.width);
}

TEST_F(OverlaySourceTest, ASceneWhereAnotherLayInMemoryHasFirstHitsOfItsOwn) {
  const Scene full = stage(LightMix::kPoint, 10, 3);
  Scene empty = full;
  empty.meshes.clear();
  finish(empty);
  const Asked touched{.choice = {.overlay = Overlay::kTouched}};
  show(sceneInTheSamePlace(full));
  request(touched);
  EXPECT_GT(answer()->statistics.count, 0u);

  const std::weak_ptr<const Scene> before = input_.scene;
  show(std::make_shared<const Scene>(full));
  ASSERT_TRUE(before.expired());
  show(sceneInTheSamePlace(empty));
  request(touched);
  EXPECT_EQ(answer()->statistics.count, 0u);
}

}  // namespace
}  // namespace cellcut::test
