#include "renderer/trace/renderer.h"

#include "renderer/trace/pass_renderer.h"

#include <cassert>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace cellcut {

struct Renderer::State {
  RenderSettings settings;
  tbb::task_arena arena;
  Film film;
  PreparedScene prepared;
  std::unique_ptr<LightSampler> sampler;
  PassRenderer passes;

  State(const Scene& s, const RenderSettings& r);
};

Renderer::State::State(const Scene& s, const RenderSettings& r)
    : settings(r),
      // The arena comes before Embree's device, which would otherwise set limits for it.
      arena(r.threads > 0 ? r.threads : tbb::task_arena::automatic),
      film(r.width, r.height, r.auxiliary),
      prepared(arena.execute([&] { return PreparedScene(s); })),
      sampler(arena.execute([&] { return makeLightSampler(prepared, r); })),
      passes(prepared, *sampler, r, film) {}

Renderer::Renderer(const Scene& scene, const RenderSettings& settings) {
  assert(settings.camera < scene.cameras.size());
  state_ = std::make_unique<State>(scene, settings);
}

Renderer::~Renderer() = default;

bool Renderer::renderPass(const std::atomic<bool>& cancel) {
  State& s = *state_;
  s.passes.startPass();
  bool committed = false;
  s.arena.execute([&] {
    const tbb::blocked_range<int> all(0, s.passes.tileCount());
    const auto renderTiles = [&](const tbb::blocked_range<int>& tiles) {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile) s.passes.renderTile(tile, cancel);
    };
    tbb::parallel_for(all, renderTiles, tbb::simple_partitioner());
    committed = !cancel.load();
    if (committed) s.film.commit();
  });
  if (committed) s.passes.keepCounts();
  return committed;
}

const Film& Renderer::film() const {
  return state_->film;
}
const RenderSettings& Renderer::settings() const {
  return state_->settings;
}
RayCounts Renderer::rays() const {
  return state_->passes.rays();
}
std::uint64_t Renderer::droppedSamples() const {
  return state_->passes.droppedSamples();
}
SamplerStatistics Renderer::samplerStatistics() const {
  return state_->sampler->statistics();
}
int Renderer::threads() const {
  return state_->arena.max_concurrency();
}

LightCounts Renderer::lightCounts() const {
  return state_->prepared.lights.counts();
}

MemoryUse Renderer::memory() const {
  const PreparedScene& prepared = state_->prepared;
  return {prepared.scene.bytes(), prepared.accel.bytes(), prepared.lights.bytes() + state_->sampler->bytes(),
          state_->film.bytes()};
}

}  // namespace cellcut
