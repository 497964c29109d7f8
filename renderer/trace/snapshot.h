/// \file snapshot.h
/// The state of a rendering at one moment, for whoever shows it. Never changed after it was published.
#pragma once

#include "renderer/base/image_io.h"
#include "renderer/trace/film.h"
#include "renderer/trace/noise.h"
#include "renderer/trace/prepared_scene.h"
#include "renderer/trace/render_settings.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

namespace cellcut {

struct Snapshot {
  std::uint64_t generation = 0;  ///< number of the newest edit that was answered; 0: none yet
  std::string error;  ///< why that edit was refused; the picture is then the one before it. Empty: it was not
  /// Size that was asked for. The picture's own is smaller for a preview.
  int width = 0, height = 0;
  /// Mean radiance, W/(m² sr); never null, empty before the first picture.
  std::shared_ptr<const ImageRgb> radiance = std::make_shared<const ImageRgb>();
  bool preview = false;      ///< one pass at a fraction of the resolution, to be shown enlarged
  std::uint64_t passes = 0;  ///< samples per pixel
  double seconds = 0;        ///< of rendering these passes
  RayCounts rays;
  std::uint64_t droppedSamples = 0;  ///< a shading point coincides with a point or spot light
  BadSamples bad;
  /// The last look of a NoiseWatch, which the input asks for; infinite before the first.
  NoiseEstimate noise{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double noiseSeconds = 0;  ///< of rendering up to that look
  SamplerStatistics sampler;
  /// For rays of whoever shows it; gone when the session has gone on to another scene. Who locks it meanwhile owns it.
  std::weak_ptr<const PreparedScene> prepared;
  std::shared_ptr<const LayeredImage> layers;  ///< Film::layers() where the input asks for them; null for a preview
};

}  // namespace cellcut
