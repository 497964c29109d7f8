// Proof 7: the same seed gives the same picture bit for bit, on any number of threads and every time.
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/support/images.h"
#include "tests/support/strategies.h"

#include <array>
#include <bit>

#include <oneapi/tbb/global_control.h>

namespace cellcut::test {
namespace {

/// Everything that may depend on the order of threads: enough triangles for Embree to build in parallel, surfaces at
/// the very same place, stochastic coverage, lights of every kind, paths of several vertices.
Scene hardScene() {
  Scene scene = stage(LightMix::kAll, 60, 8);
  const MaterialId red = addMaterial(scene, lambertian({0.9f, 0.1f, 0.1f}));
  const MaterialId green = addMaterial(scene, lambertian({0.1f, 0.9f, 0.1f}));
  Material veil = lambertian({0.2f, 0.2f, 0.9f});
  veil.baseColor.w = 0.5f;
  veil.alphaMode = AlphaMode::kBlend;
  const MaterialId blue = addMaterial(scene, veil);
  for (const MaterialId material : {red, green}) {
    addQuad(scene, material, {-0.1f, -0.9f, 0.9f}, {1.3f, 0.3f, 0}, {0, 0.4f, -0.9f}, 100, 100);
    addSphere(scene, material, {-0.5f, -0.6f, 0.7f}, 0.4f, 200, 100);
  }
  addQuad(scene, blue, {-1, -0.8f, 1.2f}, {2, 0, 0}, {0, 1, 0}, 10, 10);
  finish(scene);
  return scene;
}

/// Of the bits.
std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    count += std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]);
  }
  return count;
}

class Determinism : public testing::TestWithParam<SamplerVariant> {};

TEST_P(Determinism, PictureIsTheSameOnAnyNumberOfThreads) {
  // Without it TBB starts no more threads than the machine has cores.
  const tbb::global_control threadsAllowed(tbb::global_control::max_allowed_parallelism, 64);
  const Scene scene = hardScene();
  const int side = isSixteenth() ? 4 : 1;  // pixels are samples
  const auto render = [&](int threads) {
    RenderSettings settings;
    settings.width = 96 / side;
    settings.height = 64 / side;
    settings.maxDepth = 5;
    settings.strategy = GetParam().strategy;
    settings.sampler = GetParam().settings;
    settings.threads = threads;
    settings.seed = 3;
    Renderer renderer(scene, settings);
    renderPasses(renderer, 3);
    return std::pair(renderer.film().layers(), renderer.rays());
  };
  const auto [expected, expectedRays] = render(1);
  ASSERT_EQ(expected.layers.size(), 5u);  // radiance, albedo, normal, depth, error
  for (const int threads : {1, 2, 7, 16, 64}) {
    for (std::size_t run = 0; run < sampleShare(byDepth(2, 5)); ++run) {
      const auto [picture, rays] = render(threads);
      ASSERT_EQ(picture.layers.size(), expected.layers.size());
      for (std::size_t i = 0; i < expected.layers.size(); ++i) {
        EXPECT_EQ(differences(picture.layers[i].values, expected.layers[i].values), 0u)
            << "values of layer '" << expected.layers[i].name << "', on " << threads << " threads, run " << run;
      }
      EXPECT_EQ(rays.bounce, expectedRays.bounce);
      EXPECT_EQ(rays.shadow, expectedRays.shadow);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Determinism, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
