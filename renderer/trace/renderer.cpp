#include "renderer/trace/renderer.h"

#include "renderer/scene/camera.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/pilot.h"

#include <cassert>

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace cellcut {
namespace {

/// Pixels per side of the square that a thread takes at a time: enough for rays to share Embree's nodes, small enough
/// to spread.
constexpr int kTileSize = 16;

bool hasUnlit(const Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                     [&](const Mesh& mesh) { return scene.materials[indexOf(mesh.material)].unlit; });
}

/// Counters of a pass, shared by its tiles.
struct AtomicCounts {
  std::atomic<std::uint64_t> bounce{0}, shadow{0}, dropped{0};
  void add(const PathCounts& counts) {
    bounce.fetch_add(counts.bounceRays, std::memory_order_relaxed);
    shadow.fetch_add(counts.shadowRays, std::memory_order_relaxed);
    dropped.fetch_add(counts.dropped, std::memory_order_relaxed);
  }
};

}  // namespace

struct Renderer::State {
  const Scene& scene;
  RenderSettings settings;
  tbb::task_arena arena;
  Film film;
  Accel accel;
  Lights lights;
  std::unique_ptr<LightSampler> sampler;
  RayCounts rays;
  std::uint64_t dropped = 0;

  State(const Scene& s, const RenderSettings& r);
  void renderTile(const tbb::blocked_range2d<int>& tile, const PathContext& context, AtomicCounts& counts,
                  const std::atomic<bool>& cancel);
};

Renderer::State::State(const Scene& s, const RenderSettings& r)
    : scene(s),
      settings(r),
      // The arena comes before Embree's device, which would otherwise set limits for it.
      arena(r.threads > 0 ? r.threads : tbb::task_arena::automatic),
      film(r.width, r.height, r.auxiliary),
      accel(arena.execute([&] { return Accel(s); })),
      lights(arena.execute([&] { return Lights(s); })),
      sampler(arena.execute([&] {
        return makeLightSampler(r.strategy, lights, r.sampler,
                                pilotVertices(s, accel, s.cameras[r.camera], r.maxDepth));
      })) {}

void Renderer::State::renderTile(const tbb::blocked_range2d<int>& tile, const PathContext& context,
                                 AtomicCounts& counts, const std::atomic<bool>& cancel) {
  const Camera& camera = scene.cameras[settings.camera];
  const glm::ivec2 size(settings.width, settings.height);
  PathCounts local;
  for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
    for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) {
      if (cancel.load(std::memory_order_relaxed)) return;
      PixelSampler random(settings.sampling, settings.seed, x, y, film.passes());
      const Sample4 position = random.next();
      const Vec2 onFilm(static_cast<float>(x) + position[0], static_cast<float>(y) + position[1]);
      film.record(x, y, tracePath(context, cameraRay(camera, onFilm, size), random, local));
    }
  }
  counts.add(local);
}

Renderer::Renderer(const Scene& scene, const RenderSettings& settings)
    : state_(std::make_unique<State>(scene, settings)) {
  assert(settings.camera < scene.cameras.size());
}

Renderer::~Renderer() = default;

bool Renderer::renderPass(const std::atomic<bool>& cancel) {
  State& s = *state_;
  const bool bounceCanFind = s.lights.count(LightKind::kTriangle) > 0 || s.scene.environment || hasUnlit(s.scene);
  const PathContext context{
      s.scene, s.accel, s.lights, *s.sampler, s.settings.maxDepth, bounceCanFind, s.settings.auxiliary};
  AtomicCounts counts;
  bool committed = false;
  s.arena.execute([&] {
    const tbb::blocked_range2d<int> all(0, s.settings.height, kTileSize, 0, s.settings.width, kTileSize);
    tbb::parallel_for(
        all, [&](const auto& tile) { s.renderTile(tile, context, counts, cancel); }, tbb::simple_partitioner());
    committed = !cancel.load();
    if (committed) s.film.commit();
  });
  if (!committed) return false;
  s.rays.camera += static_cast<std::uint64_t>(s.settings.width) * static_cast<std::uint64_t>(s.settings.height);
  s.rays.bounce += counts.bounce;
  s.rays.shadow += counts.shadow;
  s.dropped += counts.dropped;
  return true;
}

const Film& Renderer::film() const {
  return state_->film;
}
const RenderSettings& Renderer::settings() const {
  return state_->settings;
}
RayCounts Renderer::rays() const {
  return state_->rays;
}
std::uint64_t Renderer::droppedSamples() const {
  return state_->dropped;
}
SamplerStatistics Renderer::samplerStatistics() const {
  return state_->sampler->statistics();
}
int Renderer::threads() const {
  return state_->arena.max_concurrency();
}

LightCounts Renderer::lightCounts() const {
  return state_->lights.counts();
}

MemoryUse Renderer::memory() const {
  return {state_->scene.bytes(), state_->accel.bytes(), state_->lights.bytes() + state_->sampler->bytes(),
          state_->film.bytes()};
}

}  // namespace cellcut
