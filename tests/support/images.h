/// \file images.h
/// Pictures as estimates: their tiles, their errors, and whether two agree.
#pragma once

#include "renderer/trace/integrator.h"
#include "renderer/trace/renderer.h"

#include <atomic>
#include <string>
#include <vector>

namespace cellcut::test {

/// Luminance of a part of a picture, with the variance of that number.
struct LuminanceEstimate {
  double mean = 0;
  double variance = 0;
};

/// Luminance per pixel and the variance of each pixel's mean.
Image<LuminanceEstimate> estimatesOf(const Film& film);

/// Of what can be cancelled and is not.
inline const std::atomic<bool> kNever{false};

/// The picture after so many more passes, each of which is expected to be completed.
ImageRgb renderPasses(Renderer& renderer, std::size_t passes);
/// `passes` passes of a scene with independent random numbers.
Image<LuminanceEstimate> renderEstimates(const Scene& scene, RenderSettings settings, std::size_t passes);
/// The same of a context of the test's own, on the calling thread, through the scene's first camera.
Film renderPasses(const PathContext& context, glm::ivec2 size, std::size_t passes, std::uint64_t seed,
                  PathCounts& counts, PixelSampling sampling = PixelSampling::kIndependent);
/// The same picture by ReferenceTracer.
Image<LuminanceEstimate> referenceEstimates(const Scene& scene, const RenderSettings& settings, std::size_t passes);

/// Means over a grid of tiles.
std::vector<LuminanceEstimate> tilesOf(const Image<LuminanceEstimate>& image, int tilesPerSide);

/// Compares pictures by tiles, as far as these are made of enough paths, and as a whole. A quarter of the tiles must
/// be.
/// \param comparisons  how many pairs are compared in the test, this one included
/// \return "" if no tile of the 8 by 8 and not the mean differs by more than chance, else what differs and by how much
std::string difference(const Image<LuminanceEstimate>& a, const Image<LuminanceEstimate>& b, std::size_t comparisons);

}  // namespace cellcut::test
