#include "renderer/trace/pass_renderer.h"

#include "renderer/scene/camera.h"

#include <cassert>

namespace cellcut {
namespace {

/// Pixels per side of the square that a thread takes at a time: enough for rays to share Embree's nodes, small enough
/// to spread.
constexpr int kTileSize = 16;

bool hasUnlit(const Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                     [&](const Mesh& mesh) { return scene.materials[indexOf(mesh.material)].unlit; });
}

bool bounceCanFind(const PreparedScene& prepared) {
  return prepared.lights.count(LightKind::kTriangle) > 0 || prepared.scene.environment || hasUnlit(prepared.scene);
}

}  // namespace

PassRenderer::PassRenderer(const PreparedScene& prepared, const LightSampler& sampler, const RenderSettings& settings,
                           Film& film)
    : shownLights_(settings.shownLights),
      context_{prepared.scene,
               prepared.accel,
               prepared.lights,
               sampler,
               settings.maxDepth,
               bounceCanFind(prepared),
               settings.auxiliary,
               nullptr,
               settings.shownLights.get()},
      camera_(viewOf(prepared.scene, settings)),
      sampling_(settings.sampling),
      seed_(settings.seed),
      film_(film),
      tiles_((film.width() + kTileSize - 1) / kTileSize, (film.height() + kTileSize - 1) / kTileSize) {}

void PassRenderer::startPass() {
  passBounce_ = 0;
  passShadow_ = 0;
  passDropped_ = 0;
}

void PassRenderer::renderTile(int tile, const std::atomic<bool>& cancel) {
  assert(tile >= 0 && tile < tileCount());
  const glm::ivec2 size(film_.width(), film_.height());
  const glm::ivec2 begin = kTileSize * glm::ivec2(tile % tiles_.x, tile / tiles_.x);
  const glm::ivec2 end(std::min(begin.x + kTileSize, size.x), std::min(begin.y + kTileSize, size.y));
  PathCounts counts;
  std::vector<CameraPath> paths;  // of neighbours in a row
  paths.reserve(kRayPacket);
  for (int y = begin.y; y < end.y; ++y) {
    for (int x = begin.x; x < end.x; x += static_cast<int>(paths.size())) {
      paths.clear();
      for (int i = x; i < end.x && paths.size() < kRayPacket; ++i) {
        PixelSampler random(sampling_, seed_, i, y, film_.passes());
        const Sample4 position = random.next();
        const Vec2 onFilm(static_cast<float>(i) + position[0], static_cast<float>(y) + position[1]);
        paths.push_back({cameraRay(camera_, onFilm, size), random});
      }
      findFirstHits(context_.accel, paths);
      for (std::size_t i = 0; i < paths.size(); ++i) {
        if (cancel.load(std::memory_order_relaxed)) return;
        film_.record(x + static_cast<int>(i), y, tracePath(context_, paths[i], counts));
      }
    }
  }
  passBounce_.fetch_add(counts.bounceRays, std::memory_order_relaxed);
  passShadow_.fetch_add(counts.shadowRays, std::memory_order_relaxed);
  passDropped_.fetch_add(counts.dropped, std::memory_order_relaxed);
}

void PassRenderer::keepCounts() {
  rays_.camera += static_cast<std::uint64_t>(film_.width()) * static_cast<std::uint64_t>(film_.height());
  rays_.bounce += passBounce_;
  rays_.shadow += passShadow_;
  dropped_ += passDropped_;
}

}  // namespace cellcut
