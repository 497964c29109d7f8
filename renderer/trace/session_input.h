/// \file session_input.h
/// What goes into a render session, and what it lets others look at.
#pragma once

#include "renderer/lights/lights.h"
#include "renderer/sampling/light_sampler.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/film.h"
#include "renderer/trace/render_settings.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

namespace cellcut {

/// All that decides what is rendered. Rendering stops at whichever limit is reached first; an edit of limits, `paused`,
/// `layers` or `noise` alone goes on with the picture that there is.
struct SessionInput {
  std::shared_ptr<const Scene> scene;  ///< another pointer is another scene
  RenderSettings settings;             ///< width, height ≥ 1
  std::optional<std::uint64_t> passLimit;
  std::optional<double> timeLimit;   ///< seconds of rendering, > 0
  std::optional<double> noiseLimit;  ///< √relMSE that NoiseWatch finds the picture below, > 0
  bool paused = false;               ///< after the preview
  bool preview = true;               ///< coarse pictures first; they touch cells too
  bool layers = false;               ///< snapshots have Snapshot::layers
  bool noise = false;                ///< and Snapshot::noise without a limit on it; takes memory: NoiseWatch
};

/// What a function that inspects a session may look at: const members of all of it may be called while tiles are being
/// rendered. The film stands still meanwhile; a sampler may be making cells.
struct SessionView {
  std::uint64_t generation;                   ///< of the newest edit that was answered
  const std::shared_ptr<const Scene>& scene;  ///< never null
  const RenderSettings& settings;
  const Accel& accel;
  const Lights& lights;
  const LightSampler& sampler;
  const Film& film;
  const std::atomic<bool>& cancel;  ///< becomes true when an edit or the session's end waits for the function
};

}  // namespace cellcut
