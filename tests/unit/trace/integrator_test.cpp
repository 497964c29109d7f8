#include "renderer/trace/integrator.h"

#include "renderer/scene/camera.h"
#include "tests/support/frozen_render.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

bool same(const ShadingPoint& a, const ShadingPoint& b) {
  return a.p == b.p && a.n == b.n && a.lobe.wo == b.lobe.wo && a.lobe.alpha == b.lobe.alpha &&
         a.lobe.share == b.lobe.share && a.indirect == b.indirect;
}

/// Passes every question on and holds the integrator to its promise: the probability of a light that a bounce met is
/// asked for at the very point that a light was chosen for before the bounce.
class WitnessedSampler final : public LightSampler {
 public:
  explicit WitnessedSampler(const LightSampler& inner) : inner_(inner) {}

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override {
    asked_ = point;
    return inner_.sample(point, u);
  }
  float pmf(const ShadingPoint& point, LightId light) const override {
    EXPECT_TRUE(asked_ && same(*asked_, point));
    if (point.lobe.share > 0)
      ++glossy_;
    else
      ++diffuse_;
    return inner_.pmf(point, light);
  }
  bool usesLobe() const override { return inner_.usesLobe(); }
  std::size_t bytes() const override { return inner_.bytes(); }

  void startPath() { asked_.reset(); }
  int glossy() const { return glossy_; }
  int diffuse() const { return diffuse_; }

 private:
  const LightSampler& inner_;
  mutable std::optional<ShadingPoint> asked_;
  mutable int glossy_ = 0, diffuse_ = 0;
};

TEST(Integrator, AsksForTheProbabilityAfterABounceAtThePointThatItSampledAt) {
  const Scene scene = stage(LightMix::kAll, 40, 11);
  const glm::ivec2 size(48, 48);
  for (const Strategy strategy : {Strategy::kCellCut, Strategy::kPointCut, Strategy::kLightTree}) {
    const FrozenRender render(scene, {.size = {8, 8}, .passes = 1, .strategy = strategy});
    WitnessedSampler witness(*render.sampler);
    const PathContext context{render.scene, render.accel, render.lights, witness, 4, true};
    PathCounts counts;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        PixelSampler random(PixelSampling::kSobol, 1, x, y, 0);
        const Ray ray = cameraRay(render.camera(), Vec2(x, y) + 0.5f, size);
        witness.startPath();
        tracePath(context, ray, random, counts);
      }
    }
    EXPECT_GT(witness.diffuse(), 100);
    if (render.sampler->usesLobe()) {
      EXPECT_GT(witness.glossy(), 100);
    } else {
      EXPECT_EQ(witness.glossy(), 0);
    }
  }
}

}  // namespace
}  // namespace cellcut::test
