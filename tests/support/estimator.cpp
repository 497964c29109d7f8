#include "tests/support/estimator.h"

#include "renderer/base/rng.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/vectors.h"

namespace cellcut::test {

std::vector<Receiver> randomReceivers(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Receiver> receivers(count);
  for (Receiver& receiver : receivers) {
    receiver = {0.3f * std::cbrt(rng.uniform()) * randomUnit(rng), randomUnit(rng)};
  }
  return receivers;
}

void addFacets(Scene& scene, const std::vector<Receiver>& receivers) {
  const MaterialId white = addMaterial(scene, lambertian(Vec3(1)));
  for (const Receiver& receiver : receivers) {
    const Frame frame(receiver.n);
    const Vec3 u = 1e-2f * frame.x, v = 1e-2f * frame.y;
    // The diagonal of a quad is no place to aim at: one triangle with the receiver inside.
    addTriangle(scene, white, receiver.p - u - v, receiver.p + u - v, receiver.p + v);
  }
}

PointEstimator::PointEstimator(const Scene& scene, Strategy strategy, const SamplerSettings& settings)
    : scene_(scene), accel_(scene), lights_(scene), sampler_(makeLightSampler(strategy, lights_, settings)) {}

Moments PointEstimator::reflected(const Receiver& receiver, std::size_t samples, std::uint64_t seed, float from) const {
  const PathContext context{scene_, accel_, lights_, *sampler_, 1, true};
  // From close by, so that no other facet comes between.
  const Ray ray{receiver.p + from * receiver.n, -receiver.n};
  PathCounts counts;
  Moments moments;
  for (std::size_t i = 0; i < samples; ++i) {
    PixelSampler random(PixelSampling::kIndependent, seed, 0, 0, i);
    moments.add(static_cast<double>(luminance(tracePath(context, ray, random, counts).radiance)));
  }
  return moments;
}

double referenceReflected(const Scene& scene, const Receiver& receiver) {
  // 64² cells of a triangle 0.2 wide as seen from here, or of a texel.
  constexpr int kCells = 64;
  const Lights lights(scene);
  const Accel accel(scene);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    sum += referenceIrradiance(lights, static_cast<LightId>(i), receiver.p, receiver.n, kCells, &accel);
  }
  return luminance(sum) / std::numbers::pi;
}

}  // namespace cellcut::test
