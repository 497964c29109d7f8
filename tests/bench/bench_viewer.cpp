/// \file bench_viewer.cpp
/// How soon the viewer shows what a person does, and what it costs the rendering, on OpenGL in memory.
#include "renderer/trace/renderer.h"
#include "tests/bench/paired.h"
#include "tests/support/recipe_scene.h"
#include "ui/viewer/frame_loop.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

namespace cellcut {
namespace {

using Clock = std::chrono::steady_clock;
constexpr PixelSize kSize{1280, 720};
constexpr int kInputs = 60;  // so that 95 % are more than all but one

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Milliseconds that half of the values and 95 % of them are not above.
void print(const char* what, const std::vector<double>& seconds) {
  std::printf("  %-44s p50 %6.1f ms  p95 %6.1f ms\n", what, 1e3 * median(seconds), 1e3 * quantile(seconds, 0.95));
}

class Bench {
 public:
  Bench(std::shared_ptr<const Scene> scene, Strategy strategy)
      : scene_(std::move(scene)),
        window_(openWindow(WindowKind::kEgl, {.size = kSize})),
        viewer_(*window_, scene_, {}, optionsOf(strategy)),
        loop_(viewer_, *window_) {
    runUntil([&] { return viewer_.settled(); });
    runFor(2);
  }

  void frames() {
    std::vector<double> seconds;
    const auto start = Clock::now();
    while (secondsSince(start) < 5) {
      loop_.step();
      seconds.push_back(loop_.frameSeconds() + secondsOf([&] { viewer_.picture(); }));
    }
    print("a frame while nobody touches it", seconds);
  }

  /// From the input to the end of the first frame that shows it.
  void inputs() {
    std::vector<double> exposures, moves;
    for (int i = 0; i < kInputs; ++i) {
      const Key key = i % 2 == 0 ? Key::kEqual : Key::kMinus;
      exposures.push_back(timed(KeyChange{key, true}));
      window_->post(KeyChange{key, false});
      window_->post(MouseMove{Vec2(kSize.width - 200, kSize.height / 2)});
      moves.push_back(timed(Scroll{Vec2(0, i % 2 == 0 ? 1 : -1)}));
    }
    print("from a key (exposure) to the frame that shows it", exposures);
    print("from a move of the camera to its preview", moves);
  }

  void share() {
    Renderer renderer(*scene_, viewer_.state().settings);
    const std::atomic<bool> never{false};
    renderer.renderPass(never);
    std::vector<double> shares;
    for (int round = 0; round < 3; ++round) {
      viewer_.state().paused = true;
      runFor(0.5);
      const double headless = secondsOf([&] { renderer.renderPass(never); });
      viewer_.state().paused = false;
      runFor(0.5);
      const std::uint64_t before = viewer_.session().snapshot()->passes;
      const auto start = Clock::now();
      runUntil([&] { return viewer_.session().snapshot()->passes >= before + 4; });
      const double passes = static_cast<double>(viewer_.session().snapshot()->passes - before);
      shares.push_back(headless / (secondsSince(start) / passes));
    }
    std::printf("  samples per second while nobody touches it: %.0f %% of headless rendering\n", 100 * median(shares));
  }

 private:
  static ViewerOptions optionsOf(Strategy strategy) {
    ViewerOptions options;
    options.state.settings.strategy = strategy;
    return options;
  }
  template <class Done>
  void runUntil(const Done& done) {
    while (!done()) loop_.step();
  }
  void runFor(double seconds) {
    const auto start = Clock::now();
    runUntil([&] { return secondsSince(start) >= seconds; });
  }
  /// Meets a pass that has begun.
  double timed(const InputEvent& input) {
    runFor(0.3);
    const auto start = Clock::now();
    window_->post(input);
    loop_.step();
    runUntil([&] { return viewer_.settled(); });
    viewer_.picture();  // OpenGL in memory draws when somebody looks
    return secondsSince(start);
  }

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Window> window_;
  Viewer viewer_;
  FrameLoop loop_;
};

}  // namespace
}  // namespace cellcut

int main() {
  using namespace cellcut;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const auto scene = std::make_shared<const Scene>(test::recipeScene(Recipe::kRooms, 4000));
  std::printf("viewer, rooms, 4000 lights, %d x %d, OpenGL in memory\n", kSize.width, kSize.height);
  for (const Strategy strategy : {Strategy::kCellCut, Strategy::kProportional}) {
    std::printf("%s\n", std::string(nameOf(strategy)).c_str());
    Bench bench(scene, strategy);
    bench.frames();
    bench.inputs();
    if (strategy == Strategy::kCellCut) bench.share();
  }
}
