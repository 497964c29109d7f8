#include "renderer/sampling/cell_cut.h"

#include "renderer/sampling/strategies.h"

#include <chrono>

namespace cellcut {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

CellCutSampler::CellCutSampler(const Lights& lights, const SamplerSettings& settings, std::span<const Vec3> pilot)
    : trees_(lights),
      settings_(settings),
      grid_(centralBox(pilot), settings.gridResolution),
      cells_(settings.cellMemory) {}

Cut CellCutSampler::makeCut(const Region& region) const {
  const Clock::time_point start = Clock::now();
  std::vector<Cluster> clusters;
  findCut(trees_, region, {settings_.threshold, settings_.maxCut}, clusters);
  Cut cut(trees_, region, clusters);
  const auto elapsed = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start);
  makeNanoseconds_.fetch_add(static_cast<std::uint64_t>(elapsed.count()), std::memory_order_relaxed);
  return cut;
}

template <class Use>
auto CellCutSampler::withCut(const Vec3& p, const Use& use) const {
  const std::optional<CellCoordinates> cell = grid_.cellOf(p);
  // Past the range of cells every point is a cell of its own.
  if (!cell) return use(makeCut({p, 0}));
  if (const Cut* cut = cells_.find(*cell)) return use(*cut);
  if (const Cut* cut = cells_.findOrMake(*cell, [&] { return makeCut(grid_.region(*cell)); })) return use(*cut);
  return use(makeCut(grid_.region(*cell)));
}

std::optional<SampledLight> CellCutSampler::sample(const ShadingPoint& point, double u) const {
  return withCut(point.p, [&](const Cut& cut) { return sampleCut(trees_, cut, settings_.inCluster, point, u); });
}

float CellCutSampler::pmf(const ShadingPoint& point, LightId light) const {
  return withCut(point.p, [&](const Cut& cut) { return pmfInCut(trees_, cut, settings_.inCluster, point, light); });
}

std::size_t CellCutSampler::bytes() const {
  return trees_.bytes() + cells_.bytes();
}

SamplerStatistics CellCutSampler::statistics() const {
  SamplerStatistics s;
  s.tree = trees_.statistics();
  const glm::ivec3 resolution = grid_.resolution();
  GridStatistics grid{.resolution = {resolution.x, resolution.y, resolution.z}};
  CutStatistics cut{.seconds = static_cast<double>(makeNanoseconds_.load()) * 1e-9};
  std::uint64_t sum = 0;
  cells_.forEach([&](const CellCoordinates&, const Cut& c) {
    cut.min = grid.touched == 0 ? c.size() : std::min(cut.min, c.size());
    cut.max = std::max(cut.max, c.size());
    sum += c.size();
    cut.bytes += c.bytes();
    ++grid.touched;
  });
  if (grid.touched > 0) cut.mean = static_cast<double>(sum) / static_cast<double>(grid.touched);
  s.grid = grid;
  s.cut = cut;
  return s;
}

std::unique_ptr<LightSampler> makeCellCutSampler(const Lights& lights, const SamplerSettings& settings,
                                                 std::span<const Vec3> pilot) {
  return std::make_unique<CellCutSampler>(lights, settings, pilot);
}

}  // namespace cellcut
