#include "renderer/trace/prepared_scene.h"

#include "renderer/trace/pilot.h"

namespace cellcut {
std::unique_ptr<LightSampler> makeLightSampler(const PreparedScene& prepared, const RenderSettings& settings) {
  const Scene& scene = prepared.scene;
  return makeLightSampler(settings.strategy, prepared.lights, settings.sampler,
                          pilotVertices(scene, prepared.accel, scene.cameras[settings.camera], settings.maxDepth));
}

bool haveSameSampler(const RenderSettings& a, const RenderSettings& b) {
  if (a.strategy != b.strategy) return false;
  if (a.strategy != Strategy::kCellCut && a.strategy != Strategy::kPointCut) return true;
  if (a.sampler != b.sampler) return false;
  if (a.strategy == Strategy::kPointCut) return true;
  return a.camera == b.camera && std::min(a.maxDepth, kPilotDepth) == std::min(b.maxDepth, kPilotDepth);
}

}  // namespace cellcut
