#include "renderer/base/warp.h"

#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/statistics.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

constexpr std::size_t kBinsPerSide = 16;
constexpr float kLast = 0x1.fffffep-1f;

/// χ² of the warped points, where `unwarp` maps them back to what must be uniform on [0, 1)².
double uniformity(const auto& pointInUnitSquare) {
  Rng rng(42);
  std::vector<std::uint64_t> counts(kBinsPerSide * kBinsPerSide);
  for (std::size_t i = 0; i < sampleShare(200'000); ++i) {
    const float u = rng.uniform();
    const Vec2 p = pointInUnitSquare(Vec2(u, rng.uniform()));
    const auto cell = [](float x) {
      return std::min(static_cast<std::size_t>(std::max(0.0f, x) * kBinsPerSide), kBinsPerSide - 1);
    };
    ++counts[cell(p.y) * kBinsPerSide + cell(p.x)];
  }
  return chiSquareTest(counts, std::vector<double>(counts.size(), 1.0)).p;
}

float turns(float x, float y) {
  const float t = std::atan2(y, x) / (2 * kPi);
  return t < 0 ? t + 1 : t;
}

TEST(Warp, DiskIsUniformInArea) {
  EXPECT_GT(uniformity([](Vec2 u) {
              const Vec2 d = concentricDisk(u);
              return Vec2(glm::dot(d, d), turns(d.x, d.y));
            }),
            kAlpha);
}

TEST(Warp, HemisphereIsCosineDistributed) {
  // Density cos/π: sin² is uniform.
  EXPECT_GT(uniformity([](Vec2 u) {
              const Vec3 w = cosineHemisphere(u);
              EXPECT_GE(w.z, 0);
              EXPECT_NEAR(glm::length(w), 1, 1e-6);
              return Vec2(w.x * w.x + w.y * w.y, turns(w.x, w.y));
            }),
            kAlpha);
}

TEST(Warp, TriangleIsUniformInArea) {
  // 1 − b₀ is the root of the area beyond a line through it, and the position on that line is uniform.
  EXPECT_GT(uniformity([](Vec2 u) {
              const Vec2 b = uniformTriangle(u);
              EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
              const float far = b.x + b.y;
              return Vec2(far * far, far > 0 ? b.y / far : 0);
            }),
            kAlpha);
}

TEST(Warp, CornersOfTheSquareStayInside) {
  for (const float x : {0.0f, 0.5f, kLast}) {
    for (const float y : {0.0f, 0.5f, kLast}) {
      EXPECT_LE(glm::length(concentricDisk({x, y})), 1.0f + 1e-6f);
      EXPECT_NEAR(glm::length(cosineHemisphere({x, y})), 1, 1e-6);
      const Vec2 b = uniformTriangle({x, y});
      EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
    }
  }
}

std::array<glm::dvec3, 3> inDouble(const std::array<Vec3, 3>& corners) {
  return {corners[0], corners[1], corners[2]};
}

TEST(Warp, OctantHasAnEighthOfTheSphere) {
  EXPECT_NEAR(sphericalTriangleArea({Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}), kPi / 2, 1e-6);
}

TEST(Warp, SmallSphericalTriangleHasItsPlaneArea) {
  const float e = 1e-3f;
  const std::array<Vec3, 3> corners{glm::normalize(Vec3(0, 0, 1)), glm::normalize(Vec3(e, 0, 1)),
                                    glm::normalize(Vec3(0, e, 1))};
  // The curvature changes the area by e², a float's corners by 10⁻⁴ of their distance.
  EXPECT_NEAR(sphericalTriangleArea(inDouble(corners)) / (0.5f * e * e), 1, 2e-4);
}

struct Spherical {
  const char* name;
  std::array<Vec3, 3> corners;
};

class SphericalTriangles : public testing::TestWithParam<Spherical> {};

TEST_P(SphericalTriangles, AreSampledUniformly) {
  std::array<Vec3, 3> c = GetParam().corners;
  for (Vec3& v : c) v = glm::normalize(v);
  const float area = sphericalTriangleArea(inDouble(c));
  // Uniform if each sub-triangle gets its share. Split by the planes through a corner and points of the opposite edge,
  // and by distance from that corner: the first is uniform in area by definition of the bins.
  constexpr int kBins = 12;
  std::vector<double> expected;
  expected.reserve(kBins);
  std::vector<Vec3> cuts;
  cuts.reserve(kBins + 1);
  for (int i = 0; i <= kBins; ++i) {
    const float t = static_cast<float>(i) / kBins;
    cuts.push_back(glm::normalize((1 - t) * c[1] + t * c[2]));
  }
  for (int i = 0; i < kBins; ++i) {
    expected.push_back(static_cast<double>(
        sphericalTriangleArea({c[0], cuts[static_cast<std::size_t>(i)], cuts[static_cast<std::size_t>(i) + 1]})));
  }
  EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0) / static_cast<double>(area), 1, 1e-4);
  for (int rotation = 0; rotation < 3; ++rotation) {  // which corner comes first to the code must not matter
    const auto r = static_cast<std::size_t>(rotation);
    const std::array<Vec3, 3> turned{c[r], c[(r + 1) % 3], c[(r + 2) % 3]};
    std::vector<std::uint64_t> counts(expected.size());
    Rng rng(7);
    for (std::size_t i = 0; i < sampleShare(100'000); ++i) {
      const float u = rng.uniform();
      const auto w = uniformSphericalTriangle(inDouble(turned), {u, rng.uniform()});
      ASSERT_TRUE(w);
      ASSERT_NEAR(glm::length(*w), 1, 1e-5);
      // The first cut whose plane has the direction on its near side.
      std::size_t bin = 0;
      const Vec3 side = glm::cross(c[0], c[1]);
      const float orientation = glm::dot(side, c[2]) > 0 ? 1.0f : -1.0f;
      while (bin + 1 < counts.size() && orientation * glm::dot(glm::cross(c[0], cuts[bin + 1]), *w) > 0) ++bin;
      ++counts[bin];
    }
    const ChiSquare test = chiSquareTest(counts, expected);
    EXPECT_GT(test.p, sidak(kAlpha, 15)) << "corner " << rotation << " first, chi square " << test.statistic;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, SphericalTriangles,
    testing::Values(Spherical{"Octant", {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}},
                    Spherical{"Small", {Vec3(0, 0, 1), Vec3(0.15f, 0, 1), Vec3(0, 0.14f, 1)}},
                    Spherical{"Sliver", {Vec3(1, 0, 0.02f), Vec3(-1, 0.3f, 0.02f), Vec3(0, 1, 0.05f)}},
                    Spherical{"NearlyHemisphere", {Vec3(1, 0, 0.1f), Vec3(-1, 1.7f, 0.2f), Vec3(-1, -1.7f, 0.2f)}},
                    Spherical{"Clockwise", {Vec3(0, 1, 1), Vec3(1, 0, 1), Vec3(-1, -1, 1)}}),
    [](const auto& info) { return info.param.name; });

TEST(Warp, SphericalTriangleWithoutAreaHasNoSamples) {
  EXPECT_FALSE(uniformSphericalTriangle({Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, Vec2(0.5f)));
}

}  // namespace
}  // namespace cellcut::test
