/// \file pass_renderer.h
/// Passes over a film, tile by tile, on whatever threads the caller has.
#pragma once

#include "renderer/trace/film.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/prepared_scene.h"

#include <atomic>
#include <cstdint>

namespace cellcut {

/// Renders the passes of one view into a film of any size: a smaller one gets the same view with fewer pixels.
///
/// A pass is startPass(); renderTile() once for every tile, in any order; and, unless it was cancelled, the film's
/// commit and keepCounts(). A pass that was not kept leaves no trace. The film is bit for bit the same for any order of
/// tiles on any number of threads. Threads: renderTile() may run concurrently for different tiles; the rest by one
/// thread at a time, and not during renderTile().
class PassRenderer {
 public:
  /// Everything outlives it. \pre the settings are within their ranges and their camera exists
  PassRenderer(const PreparedScene& prepared, const LightSampler& sampler, const RenderSettings& settings, Film& film);

  int tileCount() const { return tiles_.x * tiles_.y; }

  void startPass();
  /// Records one more sample for each pixel of a tile. Returns with some missing when `cancel` becomes true.
  /// \param tile  0 … tileCount() − 1, row by row
  void renderTile(int tile, const std::atomic<bool>& cancel);
  void keepCounts();

  /// Of all passes that were kept.
  RayCounts rays() const { return rays_; }
  /// Light samples that had to be given up, all kept passes: the shading point coincides with a point or spot light.
  std::uint64_t droppedSamples() const { return dropped_; }

 private:
  std::shared_ptr<const LightMask> shownLights_;
  PathContext context_;
  Camera camera_;
  PixelSampling sampling_;
  std::uint64_t seed_;
  Film& film_;
  glm::ivec2 tiles_;
  std::atomic<std::uint64_t> passBounce_{0}, passShadow_{0}, passDropped_{0};
  RayCounts rays_;
  std::uint64_t dropped_ = 0;
};

}  // namespace cellcut
