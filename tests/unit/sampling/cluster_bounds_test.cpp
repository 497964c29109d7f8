#include "renderer/base/rng.h"
#include "renderer/sampling/cell_cut.h"
#include "renderer/sampling/cut.h"
#include "renderer/sampling/descent.h"
#include "renderer/sampling/facing.h"
#include "tests/support/near_weights_scalar.h"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

// A cluster's weight is 0 only where none of its lights contributes: lights and points placed where float bounds are
// worst.
namespace cellcut::test {
namespace {

glm::dvec3 randomDirection(Rng& rng) {
  const double z = 2 * rng.uniformDouble() - 1, phi = 2 * std::numbers::pi * rng.uniformDouble();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// A unit vector across w, away from `other`.
glm::dvec3 acrossAwayFrom(const glm::dvec3& w, const glm::dvec3& other) {
  return glm::normalize((w - other) - w * glm::dot(w - other, w));
}

/// Two lights of a case, and a point that light 0 grazes and light 1 does not reach.
struct GrazingCase {
  std::array<Vec3, 2> lights;
  ShadingPoint point;
  bool reached;  ///< light 0 is above the horizon, in double
};

GrazingCase grazing(const std::array<Vec3, 2>& lights, const Vec3& x, double elevation) {
  const glm::dvec3 w = glm::normalize(glm::dvec3(lights[0]) - glm::dvec3(x));
  const glm::dvec3 middle = 0.5 * (glm::dvec3(lights[0]) + glm::dvec3(lights[1]));
  const Vec3 n(glm::normalize(acrossAwayFrom(w, glm::normalize(middle - glm::dvec3(x))) + w * elevation));
  return {lights, {x, n}, glm::dot(glm::dvec3(n), w) > 0};
}

/// Cases of which the importance of both lights as one cluster is 0, and of those of both ways to weigh a cut of it.
struct Lost {
  int cases = 0, importance = 0, simd = 0, scalar = 0;

  void add(const GrazingCase& c) {
    if (!c.reached || !isFinite(c.point.n)) return;
    ++cases;
    Scene scene;
    for (const Vec3& position : c.lights) {
      scene.pointLights.push_back({position, Vec3(1)});
      scene.bounds.add(position);
    }
    const Lights lights(scene);
    const LightTrees trees(lights);
    importance += !(importanceOf(trees.local, false, trees.local.root(), {c.point.p, c.point.n}) > 0);
    std::vector<Cluster> clusters;
    findCut(trees, {c.point.p, 0}, {1, 2}, clusters);
    if (clusters.size() != 1) clusters = {*localCluster(trees.local, trees.local.root(), Region{c.point.p, 0})};
    const Cut cut(trees, {c.point.p, 0}, clusters);
    alignas(64) std::array<float, kClusterBlock> weights;
    float sum;
    simd += !(nearWeights(cut.near(), c.point.p, c.point.n, weights.data(), &sum) > 0);
    scalar += !(test::nearWeightsScalar(cut.near(), c.point.p, c.point.n, weights.data(), &sum) > 0);
  }
  void expectNone() const {
    EXPECT_GT(cases, 10'000);
    EXPECT_EQ(importance, 0);
    EXPECT_EQ(simd, 0);
    EXPECT_EQ(scalar, 0);
  }
};

double decades(Rng& rng, double from, double to) {
  return std::pow(10.0, from + (to - from) * rng.uniformDouble());
}

// A cone of 2·10⁻⁴ rad has the cosine 1.
TEST(ClusterBounds, ConesOfTinyAnglesKeepTheirLights) {
  Rng rng(1);
  for (const std::size_t count : {2u, 8u}) {
    int lost = 0, cases = 0;
    for (int i = 0; i < 10'000; ++i) {
      const glm::dvec3 middle = randomDirection(rng);
      std::vector<LightBounds> bounds(count);
      for (LightBounds& b : bounds) {
        b.axes = {Vec3(glm::normalize(middle + 2e-4 * randomDirection(rng))), 1, 0};
        b.cosThetaE = 1;
        b.intensity = 1;
      }
      const LightTree tree(bounds, LightId{0}, true);
      const glm::dvec3 w = -glm::dvec3(bounds[0].axes.axis);
      const Vec3 n(glm::normalize(acrossAwayFrom(w, -middle) + w * decades(rng, -8, -3)));
      if (!(glm::dot(glm::dvec3(n), w) > 0)) continue;
      ++cases;
      lost += !(importanceOf(tree, true, tree.root(), {Vec3(0), n}) > 0);
    }
    EXPECT_GT(cases, 4000);
    EXPECT_EQ(lost, 0) << count << " lights";
  }
}

TEST(ClusterBounds, UnionHoldsTheWiderOfTwoTinyCones) {
  const auto cone = [](float theta) { return Cone{{0, 0, 1}, std::cos(theta), std::sin(theta)}; };
  for (const auto& both : {coneUnion(cone(1e-5f), cone(2e-4f)), coneUnion(cone(2e-4f), cone(1e-5f))}) {
    EXPECT_EQ(both.sinTheta, std::sin(2e-4f));
  }
}

// The centre of two lights that are closer than their coordinates' rounding allows for is off by as much as they are
// apart.
TEST(ClusterBounds, ClustersFarFromTheOriginKeepTheirLights) {
  Rng rng(2);
  Lost lost;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 base = randomDirection(rng);
    const double size = 1e-4 * decades(rng, -3, 0);
    const std::array lights{Vec3(base + size * randomDirection(rng)), Vec3(base + size * randomDirection(rng))};
    const GrazingCase c = grazing(lights, Vec3(base + 1e-4 * randomDirection(rng)), decades(rng, -5.5, -0.5));
    lost.add(c);
  }
  lost.expectNone();
}

// All directions to the sphere around two lights fill almost half of space from a point on a light's tangent plane.
TEST(ClusterBounds, TangentPointsKeepTheirLights) {
  Rng rng(3);
  Lost lost;
  for (int i = 0; i < 40'000; ++i) {
    const glm::dvec3 d = randomDirection(rng);
    const Vec3 light(d);
    const double h = decades(rng, -5, -1);
    const glm::dvec3 tangent = glm::normalize(glm::cross(d, randomDirection(rng)));
    const Vec3 x(glm::dvec3(light) + tangent * h + d * (h * h * (rng.uniformDouble() - 0.5)));
    lost.add(grazing({light, -light}, x, decades(rng, -6, -1)));
  }
  lost.expectNone();
}

TEST(ClusterBounds, WeightsBesideALightAreFinite) {
  Scene scene;
  for (const Vec3& p : {Vec3(0), Vec3(0, 0, 5), Vec3(0, 3, 5)}) {
    scene.pointLights.push_back({p, Vec3(1)});
    scene.bounds.add(p);
  }
  const Lights lights(scene);
  const std::array pilot{Vec3(-1), Vec3(1), Vec3(0)};
  for (const Strategy strategy : {Strategy::kCellCut, Strategy::kPointCut, Strategy::kLightTree}) {
    const auto sampler = makeLightSampler(strategy, lights, {}, pilot);
    for (const float d : {1e-15f, 1e-19f, 3e-20f, 1e-21f}) {
      const ShadingPoint point{{0, 0, -d}, {0, 0, 1}};
      double sum = 0;
      for (std::uint32_t i = 0; i < 3; ++i) sum += static_cast<double>(sampler->pmf(point, static_cast<LightId>(i)));
      EXPECT_NEAR(sum, 1, 1e-5) << nameOf(strategy) << " at " << d;
      EXPECT_GT(sampler->pmf(point, LightId{0}), 0);
      EXPECT_TRUE(sampler->sample(point, 0.5));
    }
  }
}

/// Variance of one sample of a sampler's choice over the squared mean, lights taken whole and unoccluded.
double relativeVariance(const LightSampler& sampler, const Lights& lights, const ShadingPoint& point) {
  double squares = 0, sum = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const auto light = static_cast<LightId>(i);
    const double e = lights.irradiance(light, point.p, point.n);
    if (!(e > 0)) continue;
    sum += e;
    squares += e * e / static_cast<double>(sampler.pmf(point, light));
  }
  return squares / (sum * sum) - 1;
}

// Two hundred lamps at three metres, and two thousand fainter ones all around at fifty: one large box that the cell is
// inside of.
TEST(CellCut, LampsBesideTheCellAndAllAroundItAreDrawnForEveryFacing) {
  Scene scene;
  Rng rng(3);
  const auto half = [&] { return rng.uniform(-0.5f, 0.5f); };
  for (int i = 0; i < 200; ++i) scene.pointLights.push_back({Vec3(half(), half(), 3 + half()), Vec3(10)});
  for (int i = 0; i < 2000; ++i) scene.pointLights.push_back({Vec3(50.0 * randomDirection(rng)), Vec3(0.5f)});
  for (const PointLight& light : scene.pointLights) scene.bounds.add(light.position);
  const Lights lights(scene);
  std::vector<Vec3> pilot(1000);
  for (Vec3& p : pilot) p = 8.0f * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  const CellCutSampler sampler(lights, {}, pilot);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      Vec3 n(0);
      n[axis] = sign;
      // light-tree has 0.3 to 6 here; before far clusters had a mean direction, −z had 18,180.
      EXPECT_LT(relativeVariance(sampler, lights, {{0.1f, 0.2f, 0}, n}), 1) << axis << ' ' << sign;
    }
  }
}

TEST(ClusterBounds, ASkyOfOneTexelReachesEveryFacing) {
  Scene scene;
  scene.environment.emplace();
  scene.environment->radiance = ImageRgb(1, 1);
  scene.environment->radiance[0] = Vec3(1);
  const Lights lights(scene);
  const LightTrees trees(lights);
  for (std::size_t i = 0; i < kFacings; ++i) {
    EXPECT_GT(importanceOf(trees.distant, true, trees.distant.root(), {Vec3(0), facing(i).axis}), 0);
  }
}

// A cluster around the cell has no direction: what it weighs must not depend on the facing.
TEST(Cut, FarClustersAroundTheCellWeighTheSameForAllFacings) {
  Scene scene;
  scene.environment.emplace();
  scene.environment->radiance = ImageRgb(8, 4);
  for (Vec3& texel : scene.environment->radiance) texel = Vec3(1);
  const Lights lights(scene);
  const LightTrees trees(lights);
  const Region region{Vec3(0), 1};
  const Cut cut(trees, region, {distantCluster(trees.distant, trees.distant.root())});
  ASSERT_EQ(cut.farCount(), 1u);
  const double up = cut.makeFarChoice(facingOf(Vec3(0, 0, 1))).distant().sum;
  for (std::size_t i = 0; i < kFacings; ++i) EXPECT_NEAR(cut.makeFarChoice(i).distant().sum / up, 1, 1e-4);
}

}  // namespace
}  // namespace cellcut::test
