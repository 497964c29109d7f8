#include "ui/overlays/wireframe.h"

#include "renderer/base/rng.h"
#include "renderer/scene/camera.h"
#include "tests/support/frozen_render.h"
#include "tests/support/scenes.h"

#include <array>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

constexpr glm::ivec2 kSize(40, 30);
const Rgba8 kWhite(255);
const Rgba8 kBlack(0, 0, 0, 255);

using Point = std::array<float, 3>;
/// A line without a direction.
std::pair<Point, Point> lineOf(const Vec3& a, const Vec3& b) {
  const Point p{a.x, a.y, a.z}, q{b.x, b.y, b.z};
  return std::minmax(p, q);
}

std::size_t edgesOf(const Vec3& lower, const Vec3& upper) {
  std::vector<Segment> segments;
  appendBox(segments, {lower, upper}, kWhite);
  std::set<std::pair<Point, Point>> lines;
  for (const Segment& s : segments) lines.insert(lineOf(s.from, s.to));
  EXPECT_EQ(lines.size(), segments.size());
  return lines.size();
}

TEST(Box, HasEachEdgeOnce) {
  EXPECT_EQ(edgesOf(Vec3(0), Vec3(1, 2, 3)), 12u);
  EXPECT_EQ(edgesOf(Vec3(0), Vec3(1, 0, 3)), 4u);
  EXPECT_EQ(edgesOf(Vec3(0), Vec3(0, 2, 0)), 1u);
  EXPECT_EQ(edgesOf(Vec3(1), Vec3(1)), 0u);
  EXPECT_EQ(edgesOf(Vec3(1), Vec3(-1)), 0u);
}

TEST(TouchedCells, AreDrawnWithSharedEdgesOnce) {
  const Scene scene = stage(LightMix::kPoint, 50, 3);
  const FrozenRender run(scene, {});
  const GridGeometry grid(centralBox(run.pilot), run.settings.sampler.gridResolution);
  // Counted again from the vertices of the paths.
  std::set<std::pair<Point, Point>> expected;
  for (const ShadingPoint& vertex : run.vertices) {
    const CellCoordinates cell = *grid.cellOf(vertex.p, vertex.indirect);
    if (cell.coarse && !grid.isRemote(cell)) continue;
    const Bounds b = grid.box(cell);
    std::vector<Segment> box;
    appendBox(box, b, kWhite);
    for (const Segment& s : box) expected.insert(lineOf(s.from, s.to));
  }
  std::set<std::pair<Point, Point>> lines;
  const auto segments = touchedCellSegments(*CutInspector::of(*run.sampler), kWhite);
  for (const Segment& s : segments) EXPECT_TRUE(lines.insert(lineOf(s.from, s.to)).second);
  EXPECT_EQ(lines, expected);
  EXPECT_GT(lines.size(), 100u);
}

/// The white pixels of a picture of segments.
std::set<std::pair<int, int>> drawn(const Camera& camera, std::span<const Segment> segments, float depth = kInfinity) {
  ImageRgba8 image(kSize.x, kSize.y, kBlack);
  drawSegments(image, Image<float>(kSize.x, kSize.y, depth), camera, segments);
  std::set<std::pair<int, int>> pixels;
  for (int y = 0; y < kSize.y; ++y) {
    for (int x = 0; x < kSize.x; ++x) {
      if (image.at(x, y) == kWhite) pixels.emplace(x, y);
    }
  }
  return pixels;
}

class Cameras : public testing::TestWithParam<bool> {
 protected:
  const Camera camera =
      GetParam() ? orthographic({3, 2, 5}, {0, 0.5f, 0}, 2) : perspective({3, 2, 5}, {0, 0.5f, 0}, 0.8f);
};

TEST_P(Cameras, APointIsDrawnWhereItsCameraRayLeaves) {
  for (int y = 0; y < kSize.y; y += 3) {
    for (int x = 0; x < kSize.x; x += 3) {
      const float t = 1 + 0.2f * static_cast<float>(x);
      const Ray ray = cameraRay(camera, Vec2(x, y) + Vec2(0.5f), kSize);
      const Vec3 p = ray.origin + t * ray.direction;
      const std::array dot{Segment{p - 1e-4f * camera.right, p + 1e-4f * camera.right, kWhite}};
      const std::set<std::pair<int, int>> there{{x, y}};
      EXPECT_EQ(drawn(camera, dot), there);
      // Just seen in front of a surface or on it, hidden behind it.
      EXPECT_EQ(drawn(camera, dot, t * 1.001f), there);
      EXPECT_EQ(drawn(camera, dot, t), there);
      EXPECT_TRUE(drawn(camera, dot, t * 0.99f).empty());
    }
  }
}

/// Points of the line for t in [0, 1] by how far their film position lies from a pixel's middle, the nearest.
struct Nearest {
  double pixels;
  float distance;
};
Nearest nearestOnLine(const Camera& camera, const Segment& line, glm::ivec2 pixel) {
  const Ray ray = cameraRay(camera, Vec2(pixel) + Vec2(0.5f), kSize);
  const Ray right = cameraRay(camera, Vec2(pixel) + Vec2(1.5f, 0.5f), kSize);
  Nearest nearest{1e9, 0};
  for (int i = 0; i <= 4000; ++i) {
    const Vec3 p = glm::mix(line.from, line.to, static_cast<float>(i) / 4000);
    const float along = glm::dot(p - ray.origin, ray.direction);
    const Vec3 onRay = ray.origin + along * ray.direction, onRight = right.origin + along * right.direction;
    const double pixels = static_cast<double>(glm::length(p - onRay) / glm::length(onRight - onRay));
    if (along > 0 && pixels < nearest.pixels) nearest = {pixels, along};
  }
  return nearest;
}

TEST_P(Cameras, LinesAreDrawnWhereTheyAreAndHiddenBehindSurfaces) {
  Rng rng(6);
  const auto random = [&] { return Vec3(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)); };
  for (int i = 0; i < 12; ++i) {
    const std::array line{Segment{random(), random(), kWhite}};
    const auto all = drawn(camera, line);
    const float wall = 5.5f;  // a sphere around a perspective camera, a plane before an orthographic one
    const auto before = drawn(camera, line, wall);
    for (const auto& [x, y] : all) {
      const Nearest nearest = nearestOnLine(camera, line[0], {x, y});
      // Half a pixel across the steep direction; a pixel away from the axis is a little narrower than the next one.
      EXPECT_LE(nearest.pixels, 0.75) << x << ' ' << y;
      // The margin of the depth test, and what half a pixel more along the line is.
      if (std::abs(nearest.distance / wall - 1) < 0.03f) continue;
      EXPECT_EQ(before.contains({x, y}), nearest.distance < wall);
    }
    for (const auto& pixel : before) EXPECT_TRUE(all.contains(pixel));
  }
}

TEST_P(Cameras, WhatIsBehindIsNotDrawnAndLinesThroughTheCameraAreCut) {
  const Vec3 behind = camera.position + 2.0f * camera.back, ahead = camera.position - 4.0f * camera.back;
  EXPECT_TRUE(drawn(camera, std::array{Segment{behind, behind + camera.right, kWhite}}).empty());
  const auto through =
      drawn(camera, std::array{Segment{behind + 0.3f * camera.right, ahead + 0.3f * camera.right, kWhite}});
  EXPECT_FALSE(through.empty());
  for (const auto& [x, y] : through) EXPECT_GE(x, kSize.x / 2);
  EXPECT_TRUE(drawn(camera, std::array{Segment{camera.position, camera.position, kWhite}}).size() <= 1);
}

INSTANTIATE_TEST_SUITE_P(Every, Cameras, testing::Bool(),
                         [](const auto& info) { return info.param ? "orthographic" : "perspective"; });

TEST(Wireframe, LaterSegmentsLieAboveAndAlphaMixes) {
  const Camera camera = orthographic({0, 0, 5}, {0, 0, 0}, 1);
  const Vec3 a(-0.9f, 0.01f, 0), b(0.9f, 0.01f, 0);
  ImageRgba8 image(kSize.x, kSize.y, kBlack);
  const Image<float> depth(kSize.x, kSize.y, kInfinity);
  drawSegments(image, depth, camera, std::array{Segment{a, b, {255, 0, 0, 255}}, Segment{a, b, {0, 255, 0, 51}}});
  EXPECT_EQ(image.at(20, 14), Rgba8(204, 51, 0, 255));
  ImageRgba8 clear(kSize.x, kSize.y);
  drawSegments(clear, depth, camera, std::array{Segment{a, b, {10, 20, 30, 51}}});
  EXPECT_EQ(clear.at(20, 14), Rgba8(10, 20, 30, 51));
}

TEST(ClusterBoxes, AreColouredByProbabilityTheLikeliestLast) {
  std::vector<ClusterInspection> clusters(4);
  clusters[0].box = {Vec3(0), Vec3(1)};
  clusters[0].probability = 0.5;
  clusters[1].box = {Vec3(2), Vec3(2)};  // one point light
  clusters[1].probability = 0.25;
  clusters[2].distant = true;
  clusters[2].probability = 0.25;
  clusters[3].box = {Vec3(4), Vec3(5)};
  const ColorScale scale = probabilityScale(clusters, Colormap::kViridis);
  EXPECT_EQ(scale.range(), (ValueRange{0.0005, 0.5}));
  const std::vector<Segment> segments = clusterSegments(clusters, scale, 200, 0.1f);
  ASSERT_EQ(segments.size(), 12u + 3u + 12u);
  EXPECT_EQ(segments.front().color, Rgba8(colorOf(Colormap::kViridis, 0), 200));
  EXPECT_EQ(segments[12].color, Rgba8(scale.color(0.25), 200));
  EXPECT_NEAR(glm::length(segments[12].to - segments[12].from), 0.1f, 1e-6f);
  EXPECT_EQ(segments.back().color, Rgba8(colorOf(Colormap::kViridis, 1), 200));
}

TEST(ClusterBoxes, OfACutThatNothingIsChosenFromHaveTheLowestColour) {
  const std::array clusters{ClusterInspection{.box = {Vec3(0), Vec3(1)}}};
  const ColorScale scale = probabilityScale(clusters, Colormap::kViridis);
  EXPECT_FALSE(scale.range());
  const std::vector<Segment> segments = clusterSegments(clusters, scale, 255, 0.1f);
  ASSERT_EQ(segments.size(), 12u);
  EXPECT_EQ(segments[0].color, Rgba8(colorOf(Colormap::kViridis, 0), 255));
}

}  // namespace
}  // namespace cellcut::test
