/// \file plain_pass.cpp
/// Passes over a scene that has nothing but surfaces and lights with a place, in a program that can or cannot have
/// more: what bench_capabilities starts and compares.
///
/// plain_pass SURFACES LIGHTS STRATEGY PASSES, with surfaces `lambertian` or `glossy`, strategy `cell-cut` or
/// `uniform`. Prints the processor seconds of the fastest pass, the bytes that the renderer keeps, and the sum of the
/// picture, which what cannot be had must not change.
#include "renderer/trace/renderer.h"
#include "tests/support/scenes.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string_view>

namespace cellcut {
namespace {

/// Floor, walls and box, glossy ones with a metal ball. Half of the lights are points, the others triangles; one light
/// is a point.
Scene plainScene(bool glossy, int lights) {
  Scene scene;
  Material grey = test::lambertian({0.7f, 0.6f, 0.5f});
  if (glossy) grey.specular = 1, grey.roughness = 0.5f;
  const MaterialId floor = test::addMaterial(scene, grey);
  const MaterialId red = test::addMaterial(scene, test::lambertian({0.8f, 0.2f, 0.2f}));
  test::addQuad(scene, floor, {-1.5f, -1, 1.5f}, {3, 0, 0}, {0, 0, -3});
  test::addQuad(scene, red, {-1.5f, -1, -1.5f}, {3, 0, 0}, {0, 2.5f, 0});
  test::addQuad(scene, red, {-1.5f, -1, 1.5f}, {0, 0, -3}, {0, 2.5f, 0});
  test::addBox(scene, red, {-0.9f, -1, -0.9f}, {-0.2f, 0.2f, -0.2f});
  if (glossy)
    test::addSphere(scene, test::addMaterial(scene, test::metal({0.9f, 0.7f, 0.3f}, 0.6f)), {0.6f, -0.5f, 0.3f}, 0.5f);
  test::addLights(scene, test::LightMix::kPoint, (lights + 1) / 2, 1);
  if (lights > 1) test::addLights(scene, test::LightMix::kTriangle, lights / 2, 2);
  scene.cameras.push_back(test::perspective({1.9f, 1.1f, 2.1f}, {-0.1f, -0.4f, -0.1f}, 0.85f));
  test::finish(scene);
  return scene;
}

void run(const Scene& scene, Strategy strategy, int passes) {
  RenderSettings settings;
  settings.width = 160;
  settings.height = 90;
  settings.maxDepth = 4;
  settings.strategy = strategy;
  settings.threads = 1;
  settings.auxiliary = false;
  Renderer renderer(scene, settings);
  const std::atomic<bool> never{false};
  double fastest = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < passes; ++pass) {
    const std::clock_t start = std::clock();
    renderer.renderPass(never);
    fastest = std::min(fastest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  const MemoryUse memory = renderer.memory();
  Vec3 sum(0);
  for (const Vec3& pixel : renderer.film().mean()) sum += pixel;
  std::printf("%.9g %zu %.9g\n", fastest, memory.scene + memory.accel + memory.lights + memory.film,
              static_cast<double>(sum.x + sum.y + sum.z));
}

}  // namespace
}  // namespace cellcut

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const bool glossy = std::string_view(argv[1]) == "glossy", uniform = std::string_view(argv[3]) == "uniform";
  cellcut::run(cellcut::plainScene(glossy, std::atoi(argv[2])),
               uniform ? cellcut::Strategy::kUniform : cellcut::Strategy::kCellCut, std::atoi(argv[4]));
}
