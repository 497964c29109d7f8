#include "renderer/trace/light_mask.h"

#include "renderer/trace/renderer.h"
#include "tests/support/images.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

ImageRgb render(const Scene& scene, RenderSettings settings, std::shared_ptr<const LightMask> mask) {
  settings.shownLights = std::move(mask);
  Renderer renderer(scene, settings);
  return renderPasses(renderer, 2);
}

/// The paths do not depend on the mask: what some lights and the others contribute adds up sample by sample.
TEST(LightMask, WhatSomeLightsAndTheOthersContributeIsTheWhole) {
  const Scene scene = stage(LightMix::kAll, 40, 5);
  const std::size_t count = Lights(scene).size();
  std::vector<bool> some(count), others(count);
  for (std::size_t i = 0; i < count; ++i) {
    some[i] = i % 3 == 0;
    others[i] = !some[i];
  }
  for (const Strategy strategy : {Strategy::kCellCut, Strategy::kPower, Strategy::kLightTree}) {
    RenderSettings settings;
    settings.width = 40;
    settings.height = 30;
    settings.maxDepth = 3;
    settings.strategy = strategy;
    const ImageRgb all = render(scene, settings, nullptr);
    const ImageRgb a = render(scene, settings, std::make_shared<const LightMask>(some));
    const ImageRgb b = render(scene, settings, std::make_shared<const LightMask>(others));
    const ImageRgb none = render(scene, settings, std::make_shared<const LightMask>(std::vector<bool>(count, false)));
    settings.maxDepth = 0;
    const ImageRgb seen = render(scene, settings, nullptr);
    double sumA = 0, sumB = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        // Sums of floats in another order.
        EXPECT_NEAR(a[i][c] + b[i][c] - seen[i][c], all[i][c], 1e-4f * (all[i][c] + seen[i][c] + 1e-3f));
        EXPECT_EQ(none[i][c], seen[i][c]);
        sumA += static_cast<double>(a[i][c] - seen[i][c]);
        sumB += static_cast<double>(b[i][c] - seen[i][c]);
      }
    }
    EXPECT_GT(sumA, 0);
    EXPECT_GT(sumB, 0);
  }
}

}  // namespace
}  // namespace cellcut::test
