#include "renderer/scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> polygon) {
  std::size_t looks = 0;
  return cellcut::triangulate(polygon, looks);
}

/// Sum of the triangles' areas along `normal`, negative parts included, and of their absolute areas.
std::pair<double, double> areas(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
  double sum = 0, absolute = 0;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const double area = 0.5 * glm::dot(glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), normal);
    sum += area;
    absolute += std::abs(area);
  }
  return {sum, absolute};
}

TEST(Triangulate, CutsConcavePolygonsWithoutOverlap) {
  // An L of area 3, in all three planes and both windings.
  const std::vector<glm::dvec2> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool reversed : {false, true}) {
      std::vector<glm::dvec3> polygon(outline.size());
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 p = outline[reversed ? outline.size() - 1 - i : i];
        polygon[i][(axis + 1) % 3] = p.x;
        polygon[i][(axis + 2) % 3] = p.y;
        polygon[i][axis] = 100;
      }
      glm::dvec3 normal(0);
      normal[axis] = reversed ? -1 : 1;
      const auto [sum, absolute] = areas(polygon, normal);
      EXPECT_DOUBLE_EQ(sum, 3);
      EXPECT_DOUBLE_EQ(absolute, 3);
    }
  }
}

TEST(Triangulate, WorksAtAnyScaleAndFarFromZero) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    std::vector<glm::dvec3> star;
    double area = 0;
    for (int i = 0; i < 20; ++i) {
      const double angle = std::numbers::pi * i / 10, radius = scale * (i % 2 ? 0.4 : 1.0);
      star.emplace_back(radius * std::cos(angle) + 1e3 * scale, radius * std::sin(angle), 0);
      area += 0.5 * 0.4 * scale * scale * std::sin(std::numbers::pi / 10);
    }
    const auto [sum, absolute] = areas(star, {0, 0, 1});
    // The offset of 1e3 costs three of double's sixteen digits.
    EXPECT_NEAR(sum / area, 1, 1e-11);
    EXPECT_NEAR(absolute / area, 1, 1e-11);
  }
}

TEST(Triangulate, GivesNMinus2TrianglesEvenOfNonsense) {
  const std::vector<glm::dvec3> point(7, glm::dvec3(1));
  EXPECT_EQ(triangulate(point).size(), 5u);
  const std::vector<glm::dvec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(bow).size(), 2u);
  const std::vector<glm::dvec3> nan(5, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(triangulate(nan).size(), 3u);
}

/// A band of n corners that winds 40 times around the middle.
std::vector<glm::dvec3> spiral(std::size_t n) {
  constexpr double kTurns = 40;
  std::vector<glm::dvec3> band(n);
  for (std::size_t i = 0; i < n / 2; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n / 2);
    const double angle = 2 * std::numbers::pi * kTurns * part, radius = 1 + kTurns * part;
    const glm::dvec3 outwards(std::cos(angle), std::sin(angle), 0);
    band[i] = radius * outwards;
    band[n - 1 - i] = (radius + 0.3) * outwards;
  }
  return band;
}

TEST(Triangulate, TakesTheSquareOfTheCornersAtMost) {
  constexpr std::size_t kCorners = 4096;
  std::vector<glm::dvec3> disc, line;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCorners;
    disc.emplace_back(std::cos(angle), std::sin(angle), 0);
    line.emplace_back(i, 0, 0);
  }
  std::size_t looks = 0;
  cellcut::triangulate(disc, looks);
  EXPECT_LE(looks, kCorners);
  for (const auto& polygon : {spiral(kCorners), line}) {
    looks = 0;
    EXPECT_EQ(cellcut::triangulate(polygon, looks).size(), kCorners - 2);
    EXPECT_LT(looks, kCorners * kCorners);
  }
  const auto [sum, absolute] = areas(spiral(kCorners), {0, 0, 1});
  EXPECT_NEAR(std::abs(sum) / absolute, 1, 1e-12);
}

TEST(Triangulate, CutsPolygonsWithAHoleAlongTheirSeam) {
  // A square of 4 with a hole of 1; the seam is gone along twice. All starting corners.
  const std::vector<glm::dvec3> outline{{-1, -1, 0},   {1, -1, 0},   {1, 1, 0},   {-1, 1, 0},   {-1, -1, 0},
                                        {-.5, -.5, 0}, {-.5, .5, 0}, {.5, .5, 0}, {.5, -.5, 0}, {-.5, -.5, 0}};
  for (std::size_t first = 0; first < outline.size(); ++first) {
    std::vector<glm::dvec3> polygon = outline;
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
    const auto [sum, absolute] = areas(polygon, {0, 0, 1});
    EXPECT_DOUBLE_EQ(sum, 3) << first;
    EXPECT_DOUBLE_EQ(absolute, 3) << first;
  }
}

}  // namespace
}  // namespace cellcut
