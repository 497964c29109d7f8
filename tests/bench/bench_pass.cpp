/// \file bench_pass.cpp
/// A whole pass against Embree alone on the same rays, one by one, and against itself on two threads.
#include "renderer/scene/load_scene.h"
#include "renderer/trace/renderer.h"
#include "tests/bench/paired.h"
#include "tests/bench/recording.h"
#include "tests/support/recipe_scene.h"

#include <cstdio>

namespace cellcut {
namespace {

constexpr glm::ivec2 kSize(640, 360);
constexpr int kRounds = 15;

void traceAll(const Accel& accel, const PathRecord& record) {
  std::size_t hits = 0;
  for (const auto& [ray, shadow] : record.rays)
    hits += shadow ? accel.occluded(ray, 0) : accel.intersect(ray, 0).has_value();
  if (hits == 0) std::printf("no ray hit anything\n");
}

RenderSettings passSettings(int threads) {
  RenderSettings settings;
  settings.width = kSize.x;
  settings.height = kSize.y;
  settings.maxDepth = 1;
  settings.strategy = Strategy::kUniform;
  settings.threads = threads;
  settings.auxiliary = false;
  return settings;
}

void benchScene(const char* name, Recipe recipe, std::size_t count) {
  const Scene scene = test::recipeScene(recipe, count);
  const Accel accel(scene);
  const Lights lights(scene);
  const PathRecord record = recordPass(scene, accel, lights, *makeLightSampler(Strategy::kUniform, lights), kSize);
  Renderer one(scene, passSettings(1)), two(scene, passSettings(2));
  const std::atomic<bool> never{false};

  const PairedTimes embree = timePaired(
      kRounds, [&] { traceAll(accel, record); }, [&] { one.renderPass(never); });
  const PairedTimes threads = timePaired(
      kRounds, [&] { one.renderPass(never); }, [&] { two.renderPass(never); });
  const auto rays = static_cast<double>(record.rays.size());
  std::printf(
      "%-8s %7zu lights  %8.0f rays  pass %6.2f Mray/s  Embree alone %6.2f Mray/s  pass / Embree %4.0f %%  1 thread / "
      "2 threads %.2f x\n",
      name, count, rays, rays / embree.b * 1e-6, rays / embree.a * 1e-6, 100 * embree.ratio, threads.ratio);
}

}  // namespace
}  // namespace cellcut

int main() {
  std::printf("uniform direct-light pass, %d x %d, medians of %d paired rounds\n", cellcut::kSize.x, cellcut::kSize.y,
              cellcut::kRounds);
  cellcut::benchScene("rooms", cellcut::Recipe::kRooms, 4000);
  cellcut::benchScene("street", cellcut::Recipe::kStreet, 4000);
  cellcut::benchScene("hall", cellcut::Recipe::kHall, 4000);
  cellcut::benchScene("kinds", cellcut::Recipe::kKinds, 300);
}
