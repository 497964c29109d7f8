/// \file renderer.h
/// A scene and settings → passes over a film. The whole of a headless rendering but for files and clocks. What people
/// change while they look at it: session.h.
#pragma once

#include "renderer/lights/lights.h"
#include "renderer/trace/film.h"
#include "renderer/trace/render_settings.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>

namespace cellcut {

/// Bytes; what the process holds at most is the operating system's to say.
struct MemoryUse {
  std::size_t scene = 0;
  std::size_t accel = 0;
  std::size_t lights = 0;  ///< lights and the strategy's tables
  std::size_t film = 0;
};

class Renderer {
 public:
  /// Builds the ray-tracing structure, the lights and the strategy. The scene must outlive the renderer.
  /// \pre the settings are within their ranges and `camera` exists
  Renderer(const Scene& scene, const RenderSettings& settings);
  /// Another film of the same scene, by the same threads and structures, and by the same strategy with all that it has
  /// found where the settings allow it: haveSameSampler(). One of them renders at a time.
  /// \pre as above; `settings.threads` is not looked at
  Renderer(const Renderer& other, const RenderSettings& settings);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// One more sample per pixel. Returns false, with the film as it was, when `cancel` became true first, or when it
  /// takes more than `seconds`, looked at before every tile. The film is bit for bit the same on any number of threads.
  bool renderPass(const std::atomic<bool>& cancel, double seconds = std::numeric_limits<double>::infinity());

  const Film& film() const;
  const RenderSettings& settings() const;
  LightCounts lightCounts() const;
  /// Of all committed passes.
  RayCounts rays() const;
  /// Light samples that had to be given up, all committed passes: the shading point coincides with a point or spot light.
  std::uint64_t droppedSamples() const;
  MemoryUse memory() const;
  SamplerStatistics samplerStatistics() const;
  /// Threads that passes run on.
  int threads() const;

 private:
  struct Base;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cellcut
