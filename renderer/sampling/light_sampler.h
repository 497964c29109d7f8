/// \file light_sampler.h
/// The choice of ONE light at a path vertex: what every strategy implements and all that the integrator knows of them.
#pragma once

#include "renderer/lights/lights.h"
#include "renderer/sampling/sampler_settings.h"
#include "renderer/sampling/strategy.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace cellcut {

struct LightTrees;
class GridGeometry;
class CellTable;

/// The GGX reflection of a surface, for choices that ask where it comes from.
struct GlossyLobe {
  Vec3 wo{0};       ///< unit, world space: where the light is to go
  float alpha = 1;  ///< of the microfacets, > 0
  float share = 0;  ///< of all reflected light, by albedos for wo; 0: there is no such reflection
};

/// Where light is to be gathered.
struct ShadingPoint {
  Vec3 p;             ///< metres
  Vec3 n;             ///< unit shading normal, on the side of the outgoing direction; only directions above it matter
  GlossyLobe lobe{};  ///< as far as LightSampler::usesLobe()
  bool indirect = false;  ///< a later vertex of a path than the first
};

struct SampledLight {
  LightId light;
  float pmf;  ///< P(light | point), > 0
};

/// A light that was drawn with a probability ≥ 0. Nothing where no float holds it (below 10⁻⁴⁵): pmf() calls that 0,
/// and nobody can divide by it.
inline std::optional<SampledLight> sampledLight(LightId light, double pmf) {
  const auto rounded = static_cast<float>(pmf);
  return rounded > 0 ? std::optional(SampledLight{light, rounded}) : std::nullopt;
}

/// What a strategy with cuts chooses from, for those who look at its decisions (inspection.h). Lives as long as the
/// strategy.
struct CutStrategy {
  const LightTrees* trees;
  const GridGeometry* grid;  ///< null: every point has a cut of its own
  const CellTable* cells;    ///< null likewise
  SamplerSettings settings;
};

/// A strategy. Threads: const members may run concurrently. Unbiased: P(ℓ | x) > 0 wherever ℓ can contribute at x.
class LightSampler {
 public:
  virtual ~LightSampler() = default;
  /// Nothing when no light can reach the point, and for a descent that ends where none of the lights below can; Σ pmf
  /// over all lights is 1 less the probability of nothing.
  /// \param u  uniform in [0, 1)
  virtual std::optional<SampledLight> sample(const ShadingPoint& point, double u) const = 0;
  /// The probability that sample() returns `light` at one and the same point, lobe and all.
  virtual float pmf(const ShadingPoint& point, LightId light) const = 0;
  /// Whether it looks at ShadingPoint::lobe.
  virtual bool usesLobe() const { return false; }
  /// Memory of its tables.
  virtual std::size_t bytes() const = 0;
  /// What was built so far. Not while samples are drawn.
  virtual SamplerStatistics statistics() const { return {}; }
  /// Nothing for a strategy without cuts.
  virtual std::optional<CutStrategy> cutStrategy() const { return std::nullopt; }
};

/// Builds a strategy over lights that outlive it; over a single light that is the uniform one, whatever was asked for.
/// \param pilot  points like those that it will be asked at, a fixed sample: they size the grid of cells
std::unique_ptr<LightSampler> makeLightSampler(Strategy strategy, const Lights& lights,
                                               const SamplerSettings& settings = {}, std::span<const Vec3> pilot = {});

}  // namespace cellcut
