/// \file bench_pass.cpp
/// A whole pass against Embree alone on the same rays, and against itself on two threads.
#include "renderer/scene/camera.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/renderer.h"
#include "tests/bench/paired.h"
#include "tests/support/recipe_scene.h"

#include <cstdio>

namespace cellcut {
namespace {

constexpr glm::ivec2 kSize(640, 360);
constexpr int kRounds = 15;

/// The rays of one uniform direct-light pass, in the order in which they are traced.
PathRecord recordPass(const Scene& scene, const Accel& accel) {
  const Lights lights(scene);
  const auto sampler = makeLightSampler(Strategy::kUniform, lights);
  PathRecord record;
  const PathContext context{scene, accel, lights, *sampler, 1, true, false, &record};
  PathCounts counts;
  for (int y = 0; y < kSize.y; ++y) {
    for (int x = 0; x < kSize.x; ++x) {
      PixelSampler random(PixelSampling::kSobol, 0, x, y, 0);
      const Sample4 position = random.next();
      const Vec2 onFilm(static_cast<float>(x) + position[0], static_cast<float>(y) + position[1]);
      tracePath(context, cameraRay(scene.cameras[0], onFilm, kSize), random, counts);
    }
  }
  return record;
}

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

void benchScene(const char* name, Recipe recipe, std::size_t lights) {
  const Scene scene = test::recipeScene(recipe, lights);
  const Accel accel(scene);
  const PathRecord record = recordPass(scene, accel);
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
      name, lights, rays, rays / embree.b * 1e-6, rays / embree.a * 1e-6, 100 * embree.ratio, threads.ratio);
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
