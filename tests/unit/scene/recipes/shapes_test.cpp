#include "renderer/scene/recipes/shapes.h"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

/// Volume inside a closed surface, positive if it is wound counter-clockwise seen from outside (divergence theorem).
double signedVolume(const Surface& s) {
  double volume = 0;
  for (std::size_t t = 0; t < s.indices.size(); t += 3) {
    const glm::dvec3 a(s.positions[s.indices[t]]), b(s.positions[s.indices[t + 1]]), c(s.positions[s.indices[t + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return volume;
}

// Relative; positions are floats a few metres from the origin, so a volume of some 0.01 m³ keeps about four digits.
constexpr double kTolerance = 1e-4;

void expectVolume(const Surface& s, double volume) {
  EXPECT_NEAR(signedVolume(s), volume, kTolerance * volume);
}

/// Area of a regular polygon of circumradius 1.
double polygon(int sides) {
  return 0.5 * sides * std::sin(2 * std::numbers::pi / sides);
}

TEST(Shapes, BoxHasItsVolumeWhateverItsPose) {
  Surface s;
  addBox(s, Pose::turned({1, 2, -1}, 0.7f), {-0.5f, 0, 0.25f}, {1, 0.5f, 1.25f});
  expectVolume(s, 1.5 * 0.5 * 1.0);
  EXPECT_EQ(s.triangleCount(), 12u);
}

TEST(Shapes, BoxWithoutAFaceLacksThatFaceOnly) {
  const std::array<Vec3, 6> directions{Vec3{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (unsigned face = 0; face < 6; ++face) {
    Surface s;
    addBox(s, {}, Vec3(-1.0f), Vec3(1.0f), 1u << face);
    Vec3 sum(0.0f);
    for (std::size_t t = 0; t < s.indices.size(); t += 3) {
      const Vec3 a = s.positions[s.indices[t]], b = s.positions[s.indices[t + 1]], c = s.positions[s.indices[t + 2]];
      sum += 0.5f * glm::cross(b - a, c - a);
    }
    // The faces of a closed surface sum to zero; what is missing is 4 m² along the face left out. Small integers:
    // exact.
    EXPECT_EQ(sum, -4.0f * directions[face]) << face;
  }
}

TEST(Shapes, FrustumHasItsVolume) {
  Surface s;
  addFrustum(s, {1, 0, 2}, 0.5f, 0.2f, 1.5f, 9);
  expectVolume(s, polygon(9) * 1.5 / 3 * (0.25 + 0.1 + 0.04));
}

TEST(Shapes, FrustumMayEndInAPoint) {
  Surface up, down;
  addFrustum(up, {1, 0, 2}, 0.5f, 0, 1.5f, 7);
  addFrustum(down, {1, 0, 2}, 0, 0.5f, 1.5f, 7);
  expectVolume(up, polygon(7) * 1.5 / 3 * 0.25);
  expectVolume(down, polygon(7) * 1.5 / 3 * 0.25);
}

TEST(Shapes, BulbsAreRegularSolids) {
  Surface tetrahedron, octahedron;
  addTetrahedron(tetrahedron, {1, 2, 3}, 0.5f, 0.4f);
  addOctahedron(octahedron, {1, 2, 3}, 0.5f);
  expectVolume(tetrahedron, 8.0 / (9 * std::sqrt(3.0)) * 0.125);
  expectVolume(octahedron, 4.0 / 3 * 0.125);
}

TEST(Shapes, SphereIsClosedAndItsNormalsLookAway) {
  Surface s;
  const Vec3 centre(1, 2, 3);
  addSphere(s, centre, 0.5f, 32, 64);
  // The inscribed polyhedron of 32 × 64 faces is 0.5 % smaller than the ball.
  EXPECT_NEAR(signedVolume(s), 4.0 / 3 * std::numbers::pi * 0.125, 0.006 * 0.5236);
  ASSERT_EQ(s.normals.size(), s.positions.size());
  for (std::size_t i = 0; i < s.positions.size(); ++i) {
    // The normal of a profile is the mean of its segments', at a pole that of the first: half a ring of 180°/32 off.
    EXPECT_GT(glm::dot(s.normals[i], (s.positions[i] - centre) / 0.5f), std::cos(std::numbers::pi / 64) - 1e-5) << i;
  }
}

TEST(Shapes, LatheKeepsSharpEdgesWhereAPointIsRepeated) {
  Surface s;
  const std::array<Vec2, 6> cylinder{Vec2{0, 0}, {1, 0}, {1, 0}, {1, 2}, {1, 2}, {0, 2}};
  addLathe(s, {}, cylinder, 12);
  expectVolume(s, 2 * polygon(12));
  for (const Vec3& n : s.normals) {
    // Along the axis or across it, never between. cos² + sin² in floats.
    EXPECT_TRUE(std::abs(std::abs(n.y) - 1) < 1e-6f || std::abs(n.y) < 1e-6f) << n.y;
  }
}

TEST(Shapes, PoseTurnsLikeARightHandedFrame) {
  const Pose pose = Pose::turned({}, std::numbers::pi_v<float> / 2);
  // A quarter turn counter-clockwise seen from above takes +x to −z and +z to +x; float cosine of π/2 is 4e-8.
  EXPECT_LT(glm::distance(pose.point({1, 0, 0}), Vec3(0, 0, -1)), 1e-6f);
  EXPECT_LT(glm::distance(pose.point({0, 0, 1}), Vec3(1, 0, 0)), 1e-6f);
  EXPECT_LT(glm::distance(glm::cross(pose.x, Vec3(0, 1, 0)), pose.z()), 1e-6f);
  const Pose twice = pose.at({0, 0, 0}, std::numbers::pi_v<float> / 2);
  EXPECT_LT(glm::distance(twice.point({1, 0, 0}), Vec3(-1, 0, 0)), 1e-6f);
}

}  // namespace
}  // namespace cellcut
