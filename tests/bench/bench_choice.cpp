/// \file bench_choice.cpp
/// Choosing a light with cell-cut against the shadow ray that follows, on the shading points of one pass.
#include "renderer/base/rng.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/pilot.h"
#include "tests/bench/paired.h"
#include "tests/bench/recording.h"
#include "tests/support/recipe_scene.h"

#include <cstdio>

namespace cellcut {
namespace {

constexpr glm::ivec2 kSize(640, 360);
constexpr int kRounds = 15;

void benchScene(const char* name, Recipe recipe, std::size_t count) {
  const Scene scene = test::recipeScene(recipe, count);
  const Accel accel(scene);
  const Lights lights(scene);
  for (const InCluster inCluster : {InCluster::kIntensity, InCluster::kDescent}) {
    const auto sampler = makeLightSampler(Strategy::kCellCut, lights, {.inCluster = inCluster},
                                          pilotVertices(scene, accel, scene.cameras[0], 1));
    // The pass makes all cells that the timed calls look up.
    const PathRecord record = recordPass(scene, accel, lights, *sampler, kSize);
    std::vector<Ray> shadowRays;
    for (const auto& [ray, shadow] : record.rays) {
      if (shadow) shadowRays.push_back(ray);
    }
    std::size_t chosen = 0, hidden = 0;
    const auto choose = [&] {
      Rng rng(1);
      for (const ShadingPoint& vertex : record.vertices)
        chosen += sampler->sample(vertex, rng.uniformDouble()).has_value();
    };
    const auto trace = [&] {
      for (const Ray& ray : shadowRays) hidden += accel.occluded(ray, 0);
    };
    const PairedTimes times = timePaired(kRounds, choose, trace);
    const double choiceNs = 1e9 * times.a / static_cast<double>(record.vertices.size());
    const double rayNs = 1e9 * times.b / static_cast<double>(shadowRays.size());
    std::printf("%-8s %7zu lights  in-cluster %-9s  choice %4.0f ns  shadow ray %4.0f ns  choice / ray %.2f\n", name,
                count, inCluster == InCluster::kIntensity ? "intensity" : "descent", choiceNs, rayNs, choiceNs / rayNs);
    if (chosen == 0 || hidden == 0) std::printf("%-8s nothing was chosen or nothing was hidden\n", name);
  }
}

}  // namespace
}  // namespace cellcut

int main() {
  std::printf(
      "cell-cut's choice of a light (lookup, weights, choice, pmf) and its shadow ray, one thread, medians of %d "
      "paired rounds\n",
      cellcut::kRounds);
  cellcut::benchScene("rooms", cellcut::Recipe::kRooms, 4000);
  cellcut::benchScene("street", cellcut::Recipe::kStreet, 4000);
  cellcut::benchScene("hall", cellcut::Recipe::kHall, 4000);
  cellcut::benchScene("kinds", cellcut::Recipe::kKinds, 300);
}
