#include "renderer/trace/prepared_scene.h"

#include "renderer/scene/material.h"
#include "renderer/trace/pilot.h"

#include <algorithm>

namespace cellcut {

PreparedScene::PreparedScene(const Scene& s) : scene(s), accel(s), lights(s) {
  const auto reflects = [&](const Mesh& mesh) { return canReflect(s.materials[indexOf(mesh.material)]); };
  if (std::any_of(s.meshes.begin(), s.meshes.end(), reflects)) GgxAlbedo::prepare();
}

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
