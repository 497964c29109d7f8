/// \file cell_cut.h
/// The method of this program: one cut per grid cell, found when the cell is first touched, and one light from it per
/// path vertex.
///
/// Source: Vévoda and Křivánek 2016, doi:10.1145/3005274.3005283.
#pragma once

#include "renderer/sampling/cell_grid.h"
#include "renderer/sampling/cut_choice.h"

namespace cellcut {

class CellCutSampler final : public LightSampler {
 public:
  /// \param pilot  points that the scene is shaded at, a fixed sample of them: they size the grid; without any the
  ///               scene's bounds do
  CellCutSampler(const Lights& lights, const SamplerSettings& settings, std::span<const Vec3> pilot);

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override;
  float pmf(const ShadingPoint& point, LightId light) const override;
  bool usesLobe() const override { return true; }
  std::size_t bytes() const override;
  SamplerStatistics statistics() const override;
  std::optional<CutStrategy> cutStrategy() const override;

 private:
  /// Calls `use` with the cut of the cell around a point and its choice among far clusters.
  template <class Use>
  auto withCut(const ShadingPoint& point, const Use& use) const;
  FarChoice makeFarChoice(const Cut& cut, std::size_t facing) const;
  Cut makeCutTimed(const Region& region, const CutSettings& settings) const;

  LightTrees trees_;
  SamplerSettings settings_;
  GridGeometry grid_;
  /// What sampling fills in: caches of a deterministic function, so that const members stay free of visible effects.
  mutable CellTable cells_;
  mutable std::atomic<std::uint64_t> makeNanoseconds_{0};
};

}  // namespace cellcut
