// Proof 3 of every strategy at single points: the estimator's mean is the sum over all lights, found by quadrature in
// double. Proof 5: it stays the same when the same light is described in another way.
#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/estimator.h"
#include "tests/support/strategies.h"

namespace cellcut::test {
namespace {

/// Fewer hits than this, and a mean over its own standard error is no normal variable.
constexpr std::uint64_t kMinHits = 1000;

/// Tests of one name: any change of the sampler draws anew in each.
constexpr std::size_t kTestsOfAName = kSamplerVariants.size() * kLightMixes.size();

/// z-tests of one family of points: each alone, and the sum of their squares, at limits of all tests of one name.
class PointTests {
 public:
  explicit PointTests(std::size_t points) : limit_(criticalZ(points * kTestsOfAName)) {}

  void add(const Moments& estimate, double reference) {
    if (reference == 0) {
      EXPECT_EQ(estimate.mean(), 0);
      return;
    }
    if (estimate.nonZero() < kMinHits) return;
    const double error = kReferenceError * reference;
    const double z = zScore(estimate.mean(), estimate.meanVariance(), reference, error * error);
    EXPECT_LT(std::abs(z), limit_) << estimate.mean() << " against " << reference;
    sum_ += z * z;
    ++count_;
  }
  void finish(std::size_t atLeast) const {
    // A sixteenth of the paths need not hit often enough.
    if (!isSixteenth()) {
      EXPECT_GE(count_, atLeast) << "points with enough hits";
    }
    if (count_ == 0) return;
    EXPECT_GT(chiSquareTail(sum_, static_cast<double>(count_)), sidak(kAlpha, kTestsOfAName))
        << "sum of squares " << sum_ << " of " << count_;
  }

 private:
  double limit_;
  double sum_ = 0;
  std::size_t count_ = 0;
};

class UnbiasedAtPoints : public StrategyAndLights {
 protected:
  std::vector<Receiver> receivers() const { return randomReceivers(byDepth(4, 64), seed()); }
  static std::size_t samples() { return sampleShare(byDepth(100'000, 65'536)); }

  /// Direct light at all receivers.
  std::vector<double> referencesOf(const Scene& scene) const {
    std::vector<double> references;
    for (const Receiver& receiver : receivers()) references.push_back(referenceReflected(scene, receiver));
    return references;
  }
  /// Direct light at all receivers of a scene against that of another description of it.
  /// \param scenes  how many are compared in the test, this one included
  void expectReferences(const Scene& scene, const std::vector<double>& references, std::size_t samples,
                        std::size_t scenes = 1) const {
    const PointEstimator estimator(scene, variant().strategy, variant().settings);
    PointTests tests(scenes * references.size());
    for (std::size_t i = 0; i < references.size(); ++i) {
      tests.add(estimator.reflected(receivers()[i], samples, hashOf(seed(), i)), references[i]);
    }
    // Some receivers turn their back on the few lights of a set.
    tests.finish(references.size() / 2);
  }
};

TEST_P(UnbiasedAtPoints, MeanIsTheSumOverAllLights) {
  Scene scene;
  addFacets(scene, receivers());
  addLights(scene, mix(), 33, seed());
  finish(scene);
  expectReferences(scene, referencesOf(scene), samples());
}

/// Random, each order as likely.
void shuffle(auto& elements, Rng& rng) {
  for (std::size_t i = elements.size(); i > 1; --i) {
    std::swap(elements[i - 1], elements[rng.below(static_cast<std::uint32_t>(i))]);
  }
}

TEST_P(UnbiasedAtPoints, OrderOfLightsDoesNotMatter) {
  if (mix() == LightMix::kEnvironment) GTEST_SKIP() << "the texels of a picture have one order";
  Scene scene;
  addFacets(scene, receivers());
  addLights(scene, mix(), 33, seed());
  finish(scene);
  Scene shuffled = scene;
  Rng rng(seed());
  shuffle(shuffled.pointLights, rng);
  shuffle(shuffled.spotLights, rng);
  shuffle(shuffled.directionalLights, rng);
  shuffle(shuffled.meshes, rng);
  for (Mesh& mesh : shuffled.meshes) shuffle(mesh.triangles, rng);
  expectReferences(shuffled, referencesOf(scene), samples());
}

/// Each light of no extent as `copies` at the same place with a part of its power.
Scene withCoincidentLights(const Scene& scene, int copies) {
  Scene result = scene;
  const auto repeat = [&](auto& lights, auto part) {
    auto all = lights;
    all.clear();
    for (const auto& light : lights) {
      for (int i = 0; i < copies; ++i) part(all.emplace_back(light));
    }
    lights = all;
  };
  const float share = 1.0f / static_cast<float>(copies);
  repeat(result.pointLights, [&](PointLight& light) { light.intensity *= share; });
  repeat(result.spotLights, [&](SpotLight& light) { light.intensity *= share; });
  repeat(result.directionalLights, [&](DirectionalLight& light) { light.irradiance *= share; });
  return result;
}

TEST_P(UnbiasedAtPoints, CoincidentLightsAddUp) {
  if (mix() == LightMix::kTriangle) GTEST_SKIP() << "which of coincident triangles hides the others is not defined";
  if (mix() == LightMix::kEnvironment) GTEST_SKIP() << "a scene has one environment";
  Scene scene;
  addFacets(scene, receivers());
  addLights(scene, mix(), 10, seed());
  finish(scene);
  const std::vector<double> references = referencesOf(scene);
  constexpr std::array copies{2, 5, 7};
  for (const int count : copies) {
    SCOPED_TRACE(count);
    expectReferences(withCoincidentLights(scene, count), references, byDepth(samples() / copies.size(), samples()),
                     copies.size());
  }
}

CELLCUT_FOR_ALL_STRATEGIES_AND_LIGHTS(UnbiasedAtPoints);

class QuadLight : public testing::TestWithParam<SamplerVariant> {};

TEST_P(QuadLight, GivesTheSameLightHoweverItIsSplit) {
  const std::vector<Receiver> receivers = randomReceivers(byDepth(4, 64), 5);
  const auto quad = [&](int columns, int rows) {
    Scene scene;
    addFacets(scene, receivers);
    // Ends 0.7 above the origin, so that receivers see it from all sides, some as almost a hemisphere.
    addQuad(scene, addMaterial(scene, emitter({3, 2, 1}, true)), {-1, 0.7f, -1}, {2.5f, 0, 0}, {0, 0, 2.2f}, columns,
            rows);
    finish(scene);
    return scene;
  };
  const Scene fine = quad(16, 16);
  std::vector<double> references;
  references.reserve(receivers.size());
  for (const Receiver& receiver : receivers) references.push_back(referenceReflected(fine, receiver));
  // 2, 32 and 10,000 triangles; a strategy of O(N) cannot have the last on every change. Nor can it, or one that finds a cut
  // at every point, have as many samples of them at night: 65,536 at each point take more than an hour.
  const Strategy strategy = GetParam().strategy;
  const bool isSlow = strategy == Strategy::kProportional || strategy == Strategy::kPointCut;
  const std::size_t ofFineAtNight = isSlow ? 4'096 : 65'536;
  for (const auto& [columns, rows] :
       {std::pair(1, 1), std::pair(4, 4), std::pair(static_cast<int>(byDepth(8, 100)), 50)}) {
    SCOPED_TRACE(std::to_string(2 * columns * rows) + " triangles");
    const Scene scene = quad(columns, rows);
    const PointEstimator estimator(scene, strategy, GetParam().settings);
    PointTests tests(3 * receivers.size());
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const bool isFine = columns * rows > 100;
      const std::size_t samples = sampleShare(byDepth(isFine ? 10'000 : 100'000, isFine ? ofFineAtNight : 65'536));
      tests.add(estimator.reflected(receivers[i], samples, hashOf(6, columns, i)), references[i]);
    }
    tests.finish(receivers.size() / 2);
  }
}

TEST_P(QuadLight, CoversTheHemisphereOfAPointCloseToIt) {
  // Too close for sampling the light: MIS leaves it to the BSDF. White facet under a sky of radiance 1: all but the
  // edges of a quad 10⁴ times as wide as it is far, (10⁻⁴)².
  Scene scene;
  addFacets(scene, {{Vec3(0), {0, 1, 0}}});
  addQuad(scene, addMaterial(scene, emitter(Vec3(1), false)), {-5, 1e-3f, -5}, {10, 0, 0}, {0, 0, 10});
  finish(scene);
  const PointEstimator estimator(scene, GetParam().strategy, GetParam().settings);
  PointTests tests(1);
  // The camera ray starts beyond the quad otherwise.
  tests.add(estimator.reflected({Vec3(0), {0, 1, 0}}, sampleShare(100'000), 1, 1e-4f), 1);
  tests.finish(1);
}

INSTANTIATE_TEST_SUITE_P(Every, QuadLight, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
