#include "renderer/trace/renderer.h"

#include "renderer/base/stopwatch.h"
#include "renderer/trace/arena_niceness.h"
#include "renderer/trace/pass_renderer.h"

#include <cassert>
#include <memory>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace cellcut {

/// What all renderers of a scene share.
struct Renderer::Base {
  tbb::task_arena arena;                    ///< comes before Embree's device, which would otherwise set limits for it
  std::unique_ptr<ArenaNiceness> niceness;  ///< null: nobody asks for another
  PreparedScene prepared;

  Base(const Scene& scene, const RenderSettings& r)
      : arena(r.threads > 0 ? r.threads : tbb::task_arena::automatic),
        niceness(r.niceness > 0 ? std::make_unique<ArenaNiceness>(arena, r.niceness) : nullptr),
        prepared(arena.execute([&] { return PreparedScene(scene); })) {}
};

struct Renderer::State {
  RenderSettings settings;
  std::shared_ptr<Base> base;
  std::shared_ptr<const LightSampler> sampler;
  Film film;
  PassRenderer passes;

  State(const RenderSettings& r, std::shared_ptr<Base> b, std::shared_ptr<const LightSampler> s)
      : settings(r),
        base(std::move(b)),
        sampler(s ? std::move(s) : base->arena.execute([&] { return makeLightSampler(base->prepared, r); })),
        film(r.width, r.height, r.auxiliary),
        passes(base->prepared, *sampler, r, film) {}
};

Renderer::Renderer(const Scene& scene, const RenderSettings& settings) {
  assert(settings.camera < scene.cameras.size());
  state_ = std::make_unique<State>(settings, std::make_shared<Base>(scene, settings), nullptr);
}

Renderer::Renderer(const Renderer& other, const RenderSettings& settings) {
  const State& o = *other.state_;
  state_ = std::make_unique<State>(settings, o.base, haveSameSampler(o.settings, settings) ? o.sampler : nullptr);
}

Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

bool Renderer::renderPass(const std::atomic<bool>& cancel, double seconds) {
  const Stopwatch pass;
  const auto isOver = [&] { return pass.seconds() >= seconds; };
  State& s = *state_;
  s.passes.startPass();
  std::atomic<bool> late = false;
  bool committed = false;
  s.base->arena.execute([&] {
    const tbb::blocked_range<int> all(0, s.passes.tileCount());
    const auto renderTiles = [&](const tbb::blocked_range<int>& tiles) {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile) {
        if (late || isOver())
          late = true;
        else
          s.passes.renderTile(tile, cancel);
      }
    };
    tbb::parallel_for(all, renderTiles, tbb::simple_partitioner());
    committed = !cancel.load() && !late.load();
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
  return state_->base->arena.max_concurrency();
}

LightCounts Renderer::lightCounts() const {
  return state_->base->prepared.lights.counts();
}

MemoryUse Renderer::memory() const {
  const PreparedScene& prepared = state_->base->prepared;
  return {prepared.scene.bytes(), prepared.accel.bytes(), prepared.lights.bytes() + state_->sampler->bytes(),
          state_->film.bytes()};
}

}  // namespace cellcut
