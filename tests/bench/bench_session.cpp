/// \file bench_session.cpp
/// A session against headless rendering while nobody touches it, and how soon an edit is seen.
#include "renderer/trace/renderer.h"
#include "renderer/trace/session.h"
#include "tests/bench/paired.h"
#include "tests/support/recipe_scene.h"

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

namespace cellcut {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPasses = 3;
constexpr int kMoves = 20;

/// Wakes whoever waits for a snapshot, as a UI's event loop would be.
class Bell {
 public:
  void ring() {
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }
  void waitFor(const std::function<bool()>& seen) {
    std::unique_lock lock(mutex_);
    while (!seen()) changed_.wait_for(lock, std::chrono::seconds(1));
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

SessionInput inputOf(const std::shared_ptr<const Scene>& scene, Strategy strategy) {
  SessionInput input;
  input.scene = scene;
  input.settings.strategy = strategy;
  input.settings.view = scene->cameras[0];
  return input;
}

void benchIdle(const std::shared_ptr<const Scene>& scene) {
  SessionInput input = inputOf(scene, Strategy::kCellCut);
  Renderer renderer(*scene, input.settings);
  RenderSession session;
  const std::atomic<bool> never{false};
  input.passLimit = 0;
  const auto headless = [&] {
    for (int i = 0; i < kPasses; ++i) renderer.renderPass(never);
  };
  const auto interactive = [&] {
    *input.passLimit += kPasses;
    session.edit(input);
    session.waitIdle();
  };
  const PairedTimes times = timePaired(5, headless, interactive);
  const double samples = kPasses * 1280.0 * 720.0;
  std::printf("while nobody touches it: %.2f Msamples/s headless, %.2f in a session: %.0f %%\n",
              samples / times.a * 1e-6, samples / times.b * 1e-6, 100 * times.ratio);
}

void benchMoves(const std::shared_ptr<const Scene>& scene, Strategy strategy) {
  SessionInput input = inputOf(scene, strategy);
  Bell bell;
  RenderSession session([&] { bell.ring(); });
  std::vector<double> edits, previews;
  for (int i = 0; i < kMoves; ++i) {
    input.settings.view->position.x += 0.01f;
    const auto start = Clock::now();
    const std::uint64_t generation = session.edit(input);
    edits.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    bell.waitFor([&] { return session.snapshot()->generation == generation; });
    previews.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // the next one meets a full pass
  }
  std::printf("%-12s a move is handed in within %.3f ms (p95), seen after %.0f ms (p50), %.0f ms (p95)\n",
              std::string(nameOf(strategy)).c_str(), 1e3 * quantile(edits, 0.95), 1e3 * quantile(previews, 0.5),
              1e3 * quantile(previews, 0.95));
}

/// A camera that moves all the time: pictures that are seen.
void benchDrag(const std::shared_ptr<const Scene>& scene, Strategy strategy) {
  SessionInput input = inputOf(scene, strategy);
  std::atomic<int> seen{0};
  RenderSession session([&] { ++seen; });
  session.edit(input);
  const auto start = Clock::now();
  while (Clock::now() - start < std::chrono::seconds(3)) {
    input.settings.view->position.x += 0.001f;
    session.edit(input);
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  std::printf("%-12s a camera that moves all the time is seen %.1f times a second\n",
              std::string(nameOf(strategy)).c_str(), seen / 3.0);
}

}  // namespace
}  // namespace cellcut

int main() {
  const auto scene = std::make_shared<const cellcut::Scene>(cellcut::test::recipeScene(cellcut::Recipe::kRooms, 4000));
  std::printf("rooms, 4000 lights, 1280 x 720, depth 8\n");
  cellcut::benchIdle(scene);
  for (const auto strategy : {cellcut::Strategy::kCellCut, cellcut::Strategy::kProportional}) {
    cellcut::benchMoves(scene, strategy);
    cellcut::benchDrag(scene, strategy);
  }
}
