#include "ui/overlays/overlay.h"

#include "renderer/scene/camera.h"
#include "tests/support/frozen_render.h"
#include "tests/support/scenes.h"

#include <map>
#include <tuple>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using Cell = std::tuple<int, int, int, bool>;

/// An overlay and everything about the rendering that it is counted again from.
class OverlayRecount : public testing::Test {
 protected:
  OverlayRecount() {
    inputs.firstHits = &firstHits;
    inputs.sampler = run.sampler.get();
    inputs.mean = &mean;
    inputs.standardError = &standardError;
    inputs.passes = run.film.passes();
    inputs.badSamples = &run.film.badSampleCounts();
  }
  Image<float> overlay(Overlay which) const { return *computeOverlay(which, inputs, run.settings.size, kNever); }
  /// Where the centre of a pixel hits, not by the code under test.
  std::optional<Vec3> hitOf(int x, int y) const {
    const Ray ray = cameraRay(run.camera(), Vec2(x, y) + Vec2(0.5f), run.settings.size);
    const std::optional<Hit> hit = run.accel.intersect(ray, 0);
    if (!hit) return std::nullopt;
    return surfaceAt(scene, *hit).p;
  }
  Cell cellOf(const Vec3& p, bool indirect = false) const {
    const CellCoordinates c = *grid.cellOf(p, indirect);
    return {c.x, c.y, c.z, c.coarse};
  }
  /// Calls `check(value of the overlay, hit point, cell)` at every pixel with a hit; all others must have no value.
  template <class Check>
  void forEachHit(Overlay which, const Check& check) const {
    const Image<float> values = overlay(which);
    std::size_t hits = 0;
    for (int y = 0; y < values.height(); ++y) {
      for (int x = 0; x < values.width(); ++x) {
        const std::optional<Vec3> p = hitOf(x, y);
        if (!p) {
          EXPECT_TRUE(std::isnan(values.at(x, y)));
          continue;
        }
        ++hits;
        check(values.at(x, y), *p, cellOf(*p));
      }
    }
    EXPECT_GT(hits, values.size() / 4);
    EXPECT_LT(hits, values.size());  // the room has no ceiling: some pixels see nothing
  }

  Scene scene = stage(LightMix::kAll, 300, 11);
  FrozenRender run{scene, {}};
  GridGeometry grid{centralBox(run.pilot), run.settings.sampler.gridResolution};
  Image<FirstHit> firstHits = *traceFirstHits(scene, run.accel, run.camera(), run.settings.size, kNever);
  ImageRgb mean = run.film.mean(), standardError = run.film.standardError();
  OverlayInputs inputs;
};

TEST_F(OverlayRecount, VisitsAreTheVerticesThatAskedInTheCell) {
  std::map<Cell, std::size_t> visits;
  for (const ShadingPoint& vertex : run.vertices) ++visits[cellOf(vertex.p, vertex.indirect)];
  std::size_t most = 0;
  forEachHit(Overlay::kVisits, [&](float value, const Vec3&, const Cell& cell) {
    EXPECT_EQ(value, static_cast<float>(visits[cell]));
    most = std::max(most, visits[cell]);
  });
  EXPECT_GT(most, 20u);
}

TEST_F(OverlayRecount, TouchedCellsAreThoseOfTheVerticesThatAskInThem) {
  std::map<Cell, bool> touched;
  for (const ShadingPoint& vertex : run.vertices) touched[cellOf(vertex.p, vertex.indirect)] = true;
  std::size_t untouched = 0;
  forEachHit(Overlay::kTouched, [&](float value, const Vec3&, const Cell& cell) {
    EXPECT_EQ(value, touched.contains(cell) ? 1.0f : 0.0f);
    untouched += touched.contains(cell) ? 0 : 1;
  });

  const glm::ivec3 r = grid.resolution();
  std::size_t inside = 0, fine = 0, remote = 0;
  for (const auto& [cell, yes] : touched) {
    const auto [x, y, z, coarse] = cell;
    remote += coarse && grid.isRemote({x, y, z, coarse}) ? 1 : 0;
    if (coarse) continue;
    ++fine;
    inside += x >= 0 && x < r.x && y >= 0 && y < r.y && z >= 0 && z < r.z ? 1 : 0;
  }
  const std::optional<TouchedCells> counted = touchedCells(*run.sampler);
  ASSERT_TRUE(counted);
  EXPECT_EQ(counted->inside, inside);
  EXPECT_EQ(counted->inside + counted->outside, fine);
  EXPECT_EQ(counted->remote, remote);
  EXPECT_LT(fine + remote, touched.size());
  EXPECT_EQ(counted->all, static_cast<std::size_t>(r.x * r.y * r.z));
  EXPECT_EQ(counted->share(), static_cast<double>(inside) / static_cast<double>(counted->all));
}

/// Depth of a node by a search that knows only children.
int searchDepth(const LightTree& tree, NodeId at, NodeId wanted) {
  if (at == wanted) return 0;
  if (tree.isLeaf(at)) return -1;
  for (const NodeId child : {tree.left(at), tree.right(at)}) {
    const int depth = searchDepth(tree, child, wanted);
    if (depth >= 0) return depth + 1;
  }
  return -1;
}

TEST_F(OverlayRecount, CutsAreThoseOfTheCells) {
  const LightTrees trees(run.lights);
  struct Found {
    std::size_t size;
    double estimate;
    int depth = 0;
  };
  std::map<Cell, Found> cuts;
  const auto cutOf = [&](const Cell& cell) {
    const auto [x, y, z, coarse] = cell;
    const auto found = cuts.find(cell);
    if (found != cuts.end()) return found->second;
    std::vector<Cluster> clusters;
    const CellCoordinates at{x, y, z, coarse};
    findCut(trees, grid.region(at), cutSettingsOf(run.settings.sampler, at), clusters);
    Found cut{clusters.size(), 0};
    for (const Cluster& c : clusters) {
      cut.estimate += static_cast<double>(c.estimate);
      const LightTree& tree = c.distant ? trees.distant : trees.local;
      cut.depth = std::max(cut.depth, searchDepth(tree, tree.root(), c.node));
    }
    return cuts[cell] = cut;
  };
  const double unit = std::ldexp(1.0, intensityExponent(run.lights));
  forEachHit(Overlay::kCutSize, [&](float value, const Vec3&, const Cell& cell) {
    if (std::isnan(value)) return;
    EXPECT_EQ(value, static_cast<float>(cutOf(cell).size));
  });
  forEachHit(Overlay::kEstimate, [&](float value, const Vec3&, const Cell& cell) {
    // The clusters are summed in another order; the value is a float.
    if (std::isnan(value)) return;
    EXPECT_NEAR(static_cast<double>(value) / (unit * cutOf(cell).estimate), 1, 1e-6);
  });
  forEachHit(Overlay::kTreeDepth, [&](float value, const Vec3&, const Cell& cell) {
    if (std::isnan(value)) return;
    EXPECT_EQ(value, static_cast<float>(cutOf(cell).depth));
  });
  const Image<float> touched = overlay(Overlay::kTouched), size = overlay(Overlay::kCutSize);
  for (std::size_t i = 0; i < touched.size(); ++i) EXPECT_EQ(touched[i] == 1, !std::isnan(size[i]));
  EXPECT_GT(cuts.size(), 10u);
}

TEST_F(OverlayRecount, FilmOverlaysAreTheFilmsNumbers) {
  const Image<float> variance = overlay(Overlay::kVariance), samples = overlay(Overlay::kSamples);
  const Image<float> error = overlay(Overlay::kError), bad = overlay(Overlay::kNan);
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const glm::dvec3 e(standardError[i]);
    const double squared = (e.x * e.x + e.y * e.y + e.z * e.z) / 3;
    EXPECT_FLOAT_EQ(variance[i], static_cast<float>(2 * squared));  // the variance of the mean of two, times two
    EXPECT_FLOAT_EQ(error[i], static_cast<float>(std::sqrt(squared)));
    EXPECT_EQ(samples[i], 2);
    EXPECT_EQ(bad[i], 0);
  }
}

TEST_F(OverlayRecount, ErrorIsTheDistanceFromAReferenceOfTheSameSize) {
  ImageRgb reference = mean;
  reference[5] *= 2.0f;  // so that the difference is not rounded
  inputs.reference = &reference;
  const Image<float> error = overlay(Overlay::kError);
  EXPECT_GT(error[5], 0);
  EXPECT_FLOAT_EQ(error[5], std::sqrt(glm::dot(mean[5], mean[5]) / 3));
  EXPECT_EQ(error[6], 0);
  const ImageRgb other(3, 3);
  inputs.reference = &other;
  EXPECT_EQ(statisticsOf(overlay(Overlay::kError)).count, 0u);
}

TEST_F(OverlayRecount, BadSamplesAreShownWhereTheyFell) {
  Image<std::uint16_t> bad(run.settings.size.x, run.settings.size.y);
  bad.at(3, 2) = 7;
  inputs.badSamples = &bad;
  const Image<float> values = overlay(Overlay::kNan);
  EXPECT_EQ(values.at(3, 2), 7);
  EXPECT_EQ(statisticsOf(values).maximum, 7);
  EXPECT_EQ(statisticsOf(values).minimum, 0);
}

TEST_F(OverlayRecount, StopsWhenItIsTold) {
  const std::atomic<bool> now{true};
  EXPECT_FALSE(computeOverlay(Overlay::kCutSize, inputs, run.settings.size, now));
  EXPECT_FALSE(traceFirstHits(scene, run.accel, run.camera(), run.settings.size, now));
}

TEST(Overlay, PointCutsHaveASizeButNoCells) {
  const Scene scene = stage(LightMix::kPoint, 100, 3);
  const FrozenRender run(scene, {.size = {8, 6}, .strategy = Strategy::kPointCut, .sampler = {.maxCut = 20}});
  const Image<FirstHit> hits = *traceFirstHits(scene, run.accel, run.camera(), {8, 6}, kNever);
  const OverlayInputs inputs{.firstHits = &hits, .sampler = run.sampler.get()};
  const LightTrees trees(run.lights);
  const Image<float> sizes = *computeOverlay(Overlay::kCutSize, inputs, {8, 6}, kNever);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!hits[i].hit()) continue;
    std::vector<Cluster> clusters;
    findCut(trees, {hits[i].point.p, 0}, {run.settings.sampler.threshold, 20}, clusters);
    EXPECT_EQ(sizes[i], static_cast<float>(clusters.size()));
  }
  EXPECT_EQ(statisticsOf(*computeOverlay(Overlay::kTouched, inputs, {8, 6}, kNever)).count, 0u);
  EXPECT_FALSE(touchedCells(*run.sampler));
}

TEST(Overlay, IsWithoutValuesWhereThereIsNothingToShow) {
  const Scene scene = stage(LightMix::kPoint, 10, 3);
  const FrozenRender run(scene, {.size = {4, 4}, .passes = 1, .strategy = Strategy::kUniform});
  const Image<FirstHit> hits = *traceFirstHits(scene, run.accel, run.camera(), {4, 4}, kNever);
  const ImageRgb error = run.film.standardError();
  const OverlayInputs inputs{.firstHits = &hits, .sampler = run.sampler.get(), .standardError = &error, .passes = 1};
  for (const Overlay o : {Overlay::kNone, Overlay::kTouched, Overlay::kVisits, Overlay::kCutSize, Overlay::kEstimate,
                          Overlay::kTreeDepth, Overlay::kVariance, Overlay::kError}) {
    for (const OverlayInputs& in : {inputs, OverlayInputs{}}) {
      const Image<float> values = *computeOverlay(o, in, {4, 4}, kNever);
      EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](float v) { return std::isnan(v); })) << describe(o).name;
    }
  }
}

TEST(Overlay, NamesAreThoseOfTheCommandLine) {
  std::string names;
  for (const OverlayName& o : kOverlays) {
    names += std::string(o.name) + "|";
    EXPECT_EQ(describe(o.overlay).name, o.name);
  }
  EXPECT_EQ(names, "none|touched|visits|cut-size|estimate|tree-depth|variance|samples|error|nan|");
}

TEST(OverlayStatistics, AreOfTheFiniteValues) {
  Image<float> values(4, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(statisticsOf(values).count, 0u);
  values[0] = 3;
  values[2] = -1;
  values[3] = kInfinity;
  const OverlayStatistics s = statisticsOf(values);
  EXPECT_EQ(s.count, 2u);
  EXPECT_EQ(s.minimum, -1);
  EXPECT_EQ(s.maximum, 3);
  EXPECT_EQ(s.mean, 1);
}

TEST(FirstHit, IsTheVertexThatTheIntegratorAsksAt) {
  const Scene scene = stage(LightMix::kPoint, 10, 3);
  FrozenSettings settings{.size = {16, 16}, .passes = 0};
  const FrozenRender run(scene, settings);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Ray ray = cameraRay(run.camera(), Vec2(x, y) + Vec2(0.5f), {16, 16});
      PathRecord record;
      PathCounts counts;
      const PathContext context{scene, run.accel, run.lights, *run.sampler, 1, true, false, &record};
      PixelSampler random(PixelSampling::kSobol, 0, x, y, 0);
      tracePath(context, ray, random, counts);
      const FirstHit hit = firstHit(scene, run.accel, ray);
      ASSERT_EQ(hit.hit(), !record.vertices.empty());
      if (!hit.hit()) continue;
      EXPECT_EQ(hit.point.p, record.vertices[0].p);
      EXPECT_EQ(hit.point.n, record.vertices[0].n);
      EXPECT_NEAR(glm::length(hit.point.p - ray.origin), hit.distance, 1e-5f * hit.distance);
    }
  }
}

}  // namespace
}  // namespace cellcut::test
