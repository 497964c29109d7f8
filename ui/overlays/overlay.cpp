#include "ui/overlays/overlay.h"

#include <cassert>
#include <limits>
#include <map>
#include <unordered_map>

namespace cellcut {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

float valueOf(Overlay overlay, const CutSummary& cut) {
  switch (overlay) {
    case Overlay::kTouched:
      return 1;
    case Overlay::kVisits:
      return static_cast<float>(cut.visits);
    case Overlay::kCutSize:
      return static_cast<float>(cut.size);
    case Overlay::kEstimate:
      return static_cast<float>(cut.estimate);
    case Overlay::kTreeDepth:
      return static_cast<float>(cut.depth);
    default:
      assert(false);
      return kNoValue;
  }
}

/// Values of cells, each found once: neighbouring pixels share theirs.
class CellValues {
 public:
  CellValues(Overlay overlay, const CutInspector& inspector, bool everyCell)
      : overlay_(overlay), inspector_(inspector), everyCell_(everyCell) {}

  float at(const Vec3& p) {
    if (!inspector_.grid()) return ofPoint(p);
    const std::optional<CellCoordinates> cell = inspector_.cellOf(p);
    if (!cell) return ofPoint(p);
    const Cut* cut = inspector_.find(*cell);
    if (!cut && (overlay_ == Overlay::kTouched || overlay_ == Overlay::kVisits)) return 0;
    if (!cut) return everyCell_ ? ofUntouched(*cell) : kNoValue;
    const auto [found, isNew] = values_.try_emplace(cut, kNoValue);
    if (isNew) found->second = valueOf(overlay_, inspector_.summary(*cut));
    return found->second;
  }

 private:
  float ofUntouched(const CellCoordinates& cell) {
    const auto [found, isNew] = untouched_.try_emplace({cell.x, cell.y, cell.z, cell.coarse}, kNoValue);
    if (isNew) found->second = valueOf(overlay_, inspector_.summaryOfCell(cell));
    return found->second;
  }
  /// Where every point has a cut of its own there is no cell to be touched or visited.
  float ofPoint(const Vec3& p) const {
    if (overlay_ == Overlay::kTouched || overlay_ == Overlay::kVisits) return kNoValue;
    return valueOf(overlay_, inspector_.summaryOfPoint(p));
  }

  Overlay overlay_;
  const CutInspector& inspector_;
  bool everyCell_;
  std::unordered_map<const Cut*, float> values_;
  std::map<std::array<std::int32_t, 4>, float> untouched_;
};

std::optional<Image<float>> cellOverlay(Overlay overlay, const OverlayInputs& inputs, Image<float> values,
                                        const std::atomic<bool>& cancel) {
  const std::optional<CutInspector> inspector =
      inputs.sampler ? CutInspector::of(*inputs.sampler) : std::optional<CutInspector>();
  if (!inspector || !inputs.firstHits) return values;
  CellValues cells(overlay, *inspector, inputs.everyCell);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (cancel.load(std::memory_order_relaxed)) return std::nullopt;
    const FirstHit& hit = (*inputs.firstHits)[i];
    if (hit.hit()) values[i] = cells.at(hit.point.p);
  }
  return values;
}

double meanOfSquares(const Vec3& v) {
  const glm::dvec3 d(v);
  return glm::dot(d, d) / 3;
}

float filmValue(Overlay overlay, const OverlayInputs& in, bool hasReference, std::size_t i) {
  switch (overlay) {
    case Overlay::kVariance:
      if (!in.standardError || in.passes < 2) return kNoValue;
      return static_cast<float>(static_cast<double>(in.passes) * meanOfSquares((*in.standardError)[i]));
    case Overlay::kError:
      if (hasReference) return static_cast<float>(std::sqrt(meanOfSquares((*in.mean)[i] - (*in.reference)[i])));
      if (in.reference || !in.standardError || in.passes < 2) return kNoValue;
      return static_cast<float>(std::sqrt(meanOfSquares((*in.standardError)[i])));
    case Overlay::kSamples:
      return static_cast<float>(in.passes);
    case Overlay::kNan:
      return in.badSamples && !in.badSamples->empty() ? static_cast<float>((*in.badSamples)[i]) : 0;
    default:
      return kNoValue;
  }
}

template <class Pixel>
bool hasSize(const Image<Pixel>* image, glm::ivec2 size) {
  return image && image->width() == size.x && image->height() == size.y;
}

}  // namespace

std::optional<Image<float>> computeOverlay(Overlay overlay, const OverlayInputs& inputs, glm::ivec2 size,
                                           const std::atomic<bool>& cancel) {
  assert(!inputs.firstHits || hasSize(inputs.firstHits, size));
  assert(!inputs.mean || hasSize(inputs.mean, size));
  assert(!inputs.standardError || hasSize(inputs.standardError, size));
  Image<float> values(size.x, size.y, kNoValue);
  switch (overlay) {
    case Overlay::kTouched:
    case Overlay::kVisits:
    case Overlay::kCutSize:
    case Overlay::kEstimate:
    case Overlay::kTreeDepth:
      return cellOverlay(overlay, inputs, std::move(values), cancel);
    default:
      break;
  }
  const bool hasReference = inputs.mean && hasSize(inputs.reference, size);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (cancel.load(std::memory_order_relaxed)) return std::nullopt;
    values[i] = filmValue(overlay, inputs, hasReference, i);
  }
  return values;
}

ScaleSettings scaleOf(Overlay overlay, const ScaleSettings& settings) {
  ScaleSettings scale = settings;
  if (overlay == Overlay::kTouched && !scale.pinned) {
    scale.pinned = ValueRange{0, 1};
    scale.kind = ScaleKind::kLinear;  // a logarithm has no 0
  }
  return scale;
}

OverlayStatistics statisticsOf(const Image<float>& values) {
  OverlayStatistics s;
  double sum = 0;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    const auto v = static_cast<double>(value);
    s.minimum = s.count == 0 ? v : std::min(s.minimum, v);
    s.maximum = s.count == 0 ? v : std::max(s.maximum, v);
    sum += v;
    ++s.count;
  }
  if (s.count > 0) s.mean = sum / static_cast<double>(s.count);
  return s;
}

std::optional<TouchedCells> touchedCells(const LightSampler& sampler) {
  const std::optional<CutInspector> inspector = CutInspector::of(sampler);
  if (!inspector || !inspector->grid()) return std::nullopt;
  const glm::ivec3 resolution = inspector->grid()->resolution();
  TouchedCells touched;
  touched.all = static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y) *
                static_cast<std::size_t>(resolution.z);
  inspector->forEachCell([&](const CellCoordinates& c, const Cut&) {
    if (c.coarse) {
      touched.remote += inspector->grid()->isRemote(c) ? 1 : 0;
      return;
    }
    const bool inside =
        c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < resolution.x && c.y < resolution.y && c.z < resolution.z;
    ++(inside ? touched.inside : touched.outside);
  });
  return touched;
}

}  // namespace cellcut
