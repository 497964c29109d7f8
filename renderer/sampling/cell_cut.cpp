#include "renderer/sampling/cell_cut.h"

#include "renderer/base/stopwatch.h"
#include "renderer/sampling/facing.h"
#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

/// Adds the nanoseconds that it lives to a counter.
class AddElapsed {
 public:
  explicit AddElapsed(std::atomic<std::uint64_t>& sum) : sum_(sum) {}
  ~AddElapsed() { sum_.fetch_add(static_cast<std::uint64_t>(1e9 * watch_.seconds()), std::memory_order_relaxed); }
  AddElapsed(const AddElapsed&) = delete;
  AddElapsed& operator=(const AddElapsed&) = delete;

 private:
  std::atomic<std::uint64_t>& sum_;
  Stopwatch watch_;
};

}  // namespace

CellCutSampler::CellCutSampler(const Lights& lights, const SamplerSettings& settings, std::span<const Vec3> pilot)
    : trees_(lights),
      settings_(settings),
      grid_(pilot.empty() ? lights.scene().bounds : centralBox(pilot), settings.gridResolution),
      cells_(settings.cellMemory) {}

Cut CellCutSampler::makeCutTimed(const Region& region, const CutSettings& settings) const {
  const AddElapsed timing(makeNanoseconds_);
  return makeCut(trees_, region, settings);
}

FarChoice CellCutSampler::makeFarChoice(const Cut& cut, std::size_t facing) const {
  const AddElapsed timing(makeNanoseconds_);
  return cut.makeFarChoice(facing);
}

template <class Use>
auto CellCutSampler::withCut(const ShadingPoint& point, const Use& use) const {
  const std::optional<CellCoordinates> cell = grid_.cellOf(point.p, point.indirect);
  // Past the range of cells every point is a cell of its own.
  const std::size_t facing = facingOf(point.n);
  const auto useOwn = [&](const Cut& own) { return use(own, makeFarChoice(own, facing)); };
  if (!cell) return useOwn(makeCutTimed({point.p, 0}, {settings_.threshold, settings_.maxCut}));
  const auto makeCell = [&] { return makeCutTimed(grid_.region(*cell), cutSettingsOf(settings_, *cell)); };
  const Cut* cut = cells_.find(*cell);
  if (!cut) cut = cells_.findOrMake(*cell, makeCell);
  if (!cut) return useOwn(makeCell());
  if (cut->farCount() == 0) return use(*cut, FarChoice());
  if (const FarChoice* far = cut->farChoice(facing)) return use(*cut, *far);
  FarChoice made = makeFarChoice(*cut, facing);
  const std::size_t bytes = made.bytes();
  if (!cells_.reserve(bytes)) return use(*cut, made);
  const Cut::Kept kept = cut->keep(facing, std::move(made));
  if (!kept.isNew) cells_.release(bytes);
  return use(*cut, *kept.choice);
}

std::optional<SampledLight> CellCutSampler::sample(const ShadingPoint& point, double u) const {
  return withCut(point, [&](const Cut& cut, const FarChoice& far) {
    if (settings_.countVisits) cut.countVisit();
    return sampleCut(trees_, cut, far, settings_.inCluster, point, u);
  });
}

float CellCutSampler::pmf(const ShadingPoint& point, LightId light) const {
  return withCut(point, [&](const Cut& cut, const FarChoice& far) {
    return pmfInCut(trees_, cut, far, settings_.inCluster, point, light);
  });
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
  cells_.forEach([&](const CellCoordinates& cell, const Cut& c) {
    cut.bytes += c.bytes();
    if (cell.coarse) {
      ++grid.coarse;
      return;
    }
    cut.min = grid.fine == 0 ? c.size() : std::min(cut.min, c.size());
    cut.max = std::max(cut.max, c.size());
    sum += c.size();
    ++grid.fine;
  });
  if (grid.fine > 0) cut.mean = static_cast<double>(sum) / static_cast<double>(grid.fine);
  s.grid = grid;
  s.cut = cut;
  return s;
}

std::optional<CutStrategy> CellCutSampler::cutStrategy() const {
  return CutStrategy{&trees_, &grid_, &cells_, settings_};
}

std::unique_ptr<LightSampler> makeCellCutSampler(const Lights& lights, const SamplerSettings& settings,
                                                 std::span<const Vec3> pilot) {
  return std::make_unique<CellCutSampler>(lights, settings, pilot);
}

}  // namespace cellcut
