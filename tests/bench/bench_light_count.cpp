/// \file bench_light_count.cpp
/// A pass of cell-cut against one of uniform on the same scene, by the number of lights; and what cells cost.
#include "renderer/scene/load_scene.h"
#include "renderer/trace/renderer.h"
#include "tests/bench/paired.h"
#include "tests/support/recipe_scene.h"
#include "tests/support/scenes.h"

#include <cstdio>

namespace cellcut {
namespace {

constexpr glm::ivec2 kSize(640, 360);
constexpr int kRounds = 9;
/// A short rendering, which the making of cells is held against.
constexpr int kShortPasses = 16;

RenderSettings passSettings(Strategy strategy) {
  RenderSettings settings;
  settings.width = kSize.x;
  settings.height = kSize.y;
  settings.maxDepth = 1;
  settings.strategy = strategy;
  settings.auxiliary = false;
  return settings;
}

double shadowRaysPerPixel(const Renderer& renderer) {
  return static_cast<double>(renderer.rays().shadow) / static_cast<double>(renderer.rays().camera);
}

void benchScene(const char* name, std::size_t count, const Scene& scene) {
  Renderer uniform(scene, passSettings(Strategy::kUniform)), cut(scene, passSettings(Strategy::kCellCut));
  const std::atomic<bool> never{false};
  const PairedTimes times = timePaired(
      kRounds, [&] { cut.renderPass(never); }, [&] { uniform.renderPass(never); });
  const double makeSeconds = cut.samplerStatistics().cut->seconds / cut.threads();
  std::printf(
      "%-8s %8zu lights  cell-cut %6.1f ms  uniform %6.1f ms  ratio %.2f  shadow rays per pixel %.2f and %.2f  cells "
      "%.1f "
      "%% of %d passes\n",
      name, count, 1e3 * times.a, 1e3 * times.b, times.ratio, shadowRaysPerPixel(cut), shadowRaysPerPixel(uniform),
      100 * makeSeconds / (makeSeconds + kShortPasses * times.a), kShortPasses);
}

}  // namespace
}  // namespace cellcut

int main() {
  using namespace cellcut;
  std::printf("direct-light pass, %d x %d, all threads, medians of %d paired rounds without the first\n", kSize.x,
              kSize.y, kRounds);
  for (const std::size_t count : {100, 4000, 1'000'000})
    benchScene("rooms", count, test::recipeScene(Recipe::kRooms, count));
  benchScene("street", 4000, test::recipeScene(Recipe::kStreet, 4000));
  benchScene("hall", 4000, test::recipeScene(Recipe::kHall, 4000));
  benchScene("kinds", 4000, test::recipeScene(Recipe::kKinds, 4000));
  // Points in geometry that does not grow with them.
  for (const int count : {100, 4000, 1'000'000}) {
    benchScene("points", static_cast<std::size_t>(count), test::stage(test::LightMix::kPoint, count, 1));
  }
}
