/// \file film.h
/// Per-pixel sums of samples.
///
/// A pass writes one sample per pixel into a buffer of its own (record) and is then added as a whole (commit) or
/// forgotten, so that a pass that was interrupted leaves no trace. Sums are in double: after 10⁸ samples a pixel is
/// right to 10⁻⁶. Threads: record() may run concurrently for different pixels, commitRow() for different rows; const
/// members may run beside record(); everything else by one thread at a time.
#pragma once

#include "renderer/base/image.h"
#include "renderer/base/image_io.h"

#include <cstdint>

namespace cellcut {

/// What one camera path found.
struct PathSample {
  Vec3 radiance{0.0f};  ///< W/(m² sr)
  Vec3 albedo{0.0f};    ///< of the first hit; 0 when nothing was hit
  Vec3 normal{0.0f};    ///< shading normal of the first hit, world space
  float depth = 0;      ///< distance to the first hit, metres; 0 when nothing was hit
};

/// Samples that were no number; they count as black.
struct BadSamples {
  std::uint64_t nan = 0;
  std::uint64_t inf = 0;
};

class Film {
 public:
  /// \param auxiliary  keep albedo, normal and depth too
  Film(int width, int height, bool auxiliary);

  int width() const { return sums_.width(); }
  int height() const { return sums_.height(); }
  /// Committed passes, which is samples per pixel.
  std::uint64_t passes() const { return passes_; }

  void record(int x, int y, const PathSample& sample);
  /// Adds the recorded pass, on the calling thread's TBB arena.
  void commit();
  /// The same for threads of the caller's: commitRow() once for each row, concurrently for different ones, and then
  /// finishCommit().
  void commitRow(int y);
  void finishCommit() { ++passes_; }
  /// Forgets all passes. Takes no time: the next commit overwrites.
  void clear();

  /// Mean radiance; black before the first pass.
  ImageRgb mean() const;
  /// Standard error of the mean per channel, from the variance between samples; 0 with fewer than two passes. With
  /// Sobol' points the samples of a pixel are not independent and the real error is smaller.
  ImageRgb standardError() const;
  /// Estimate of √relMSE of mean(): per channel standardError² / (mean² + ε), averaged over channels and pixels, square
  /// root; ε = 0.01 · (mean of the picture)² as in `compare`. Infinity with fewer than two passes.
  double relativeError() const;
  BadSamples badSamples() const { return bad_; }
  /// Per pixel, NaN and infinite together; stays at 65535.
  const Image<std::uint16_t>& badSampleCounts() const { return badCounts_; }
  std::size_t bytes() const;
  /// What a pixel of such a film takes, to know before it is made whether there is room.
  static std::size_t bytesPerPixel(bool auxiliary) {
    return sizeof(Sums) + sizeof(Vec3) + sizeof(std::uint16_t) +
           (auxiliary ? sizeof(Auxiliary) + sizeof(PendingAuxiliary) : 0);
  }

  /// "" (RGB), "albedo" (RGB), "normal" (XYZ), "depth" (Z) and "error" (RGB, standard error of the mean); no metadata.
  LayeredImage layers() const;

 private:
  struct Sums {
    glm::dvec3 mean{0.0};
    glm::dvec3 squares{0.0};  ///< Σ (x − mean)², updated as Welford 1962 does: no cancellation
  };
  struct Auxiliary {
    glm::dvec3 albedo{0.0};
    glm::dvec3 normal{0.0};
    double depth = 0;
  };
  struct PendingAuxiliary {
    Vec3 albedo, normal;
    float depth;
  };
  /// Of the mean, per channel. \pre passes() ≥ 2
  glm::dvec3 errorOf(const Sums& sums) const;

  Image<Sums> sums_;
  Image<Auxiliary> auxiliary_;  ///< empty unless asked for
  Image<Vec3> pendingRadiance_;
  Image<PendingAuxiliary> pendingAuxiliary_;  ///< empty unless asked for
  std::uint64_t passes_ = 0;
  BadSamples bad_;
  Image<std::uint16_t> badCounts_;
};

}  // namespace cellcut
