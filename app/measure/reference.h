/// \file reference.h
/// The picture that errors are measured against, made once and kept by the content that it shows.
///
/// It is the mean of batches that are rendered with seeds of their own by `cell-cut`, which is unbiased like all
/// strategies and has the least noise. How far the batches differ says how far their mean is from the truth, whatever the
/// sampler does inside a batch (the variance between the samples of Sobol' points overstates it). What was rendered is on the
/// disk after every batch.
#pragma once

#include "renderer/base/image.h"
#include "renderer/trace/render_settings.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace cellcut {

struct MeasureReference {
  ImageRgb picture;
  double relmse = 0;         ///< estimate of its own error, defined as in `compare`; NaN: not known
  std::uint64_t passes = 0;  ///< samples per pixel; 0: not known
  double seconds = 0;        ///< that it took to render, whenever that was
  std::filesystem::path file;
};

struct ReferenceRequest {
  const Scene& scene;
  RenderSettings settings;              ///< camera, size, depth, threads; strategy and seed are the reference's own
  std::optional<std::uint64_t> passes;  ///< else as many as judge a rendering of `seconds`
  double seconds = 0;
  std::filesystem::path folder;  ///< of the cache; must exist
};

/// Times the seconds or samples of a run that a reference takes if nothing else is asked for: by the law of the error, 1/t,
/// its own is then a sixteenth of that which it judges, with some room below kMostReferenceShare.
inline constexpr int kReferenceFactor = 16;

/// Most that a reference's own relMSE may be of the relMSE that it judges: errors that are measured against it are too large by
/// that share.
inline constexpr double kMostReferenceShare = 0.1;

/// $XDG_CACHE_HOME/cellcut or ~/.cache/cellcut, made if need be; `otherwise` where that cannot be.
std::filesystem::path cacheFolder(const std::filesystem::path& otherwise);

/// \param onPass  passes and seconds so far, and the passes that are aimed at
/// \return nothing when `cancel` became true
std::optional<MeasureReference> makeReference(const ReferenceRequest& request, const std::atomic<bool>& cancel,
                                              const std::function<void(std::uint64_t, double, std::uint64_t)>& onPass);

/// \throws InputError if the error that was measured is less than 1 / kMostReferenceShare times the reference's own
void requireFineReference(const MeasureReference& reference, double smallestRelmse);

}  // namespace cellcut
