#include "tests/support/frozen_render.h"

#include "renderer/trace/pilot.h"

namespace cellcut::test {

FrozenRender::FrozenRender(const Scene& scene, const FrozenSettings& settings)
    : scene(scene),
      settings(settings),
      accel(scene),
      lights(scene),
      pilot(pilotVertices(scene, accel, scene.cameras[0], settings.maxDepth)),
      sampler(makeLightSampler(settings.strategy, lights, settings.sampler, pilot)),
      film(settings.size.x, settings.size.y, false) {
  PathRecord record;
  const PathContext context{scene, accel, lights, *sampler, settings.maxDepth, true, false, &record};
  PathCounts counts;
  film = renderPasses(context, settings.size, settings.passes, 0, counts, PixelSampling::kSobol);
  vertices = std::move(record.vertices);
}

}  // namespace cellcut::test
