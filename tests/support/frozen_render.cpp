#include "tests/support/frozen_render.h"

#include "renderer/scene/camera.h"
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
  for (int pass = 0; pass < settings.passes; ++pass) {
    for (int y = 0; y < settings.size.y; ++y) {
      for (int x = 0; x < settings.size.x; ++x) {
        PixelSampler random(PixelSampling::kSobol, 0, x, y, film.passes());
        const Sample4 position = random.next();
        const Ray ray = cameraRay(camera(), Vec2(x, y) + Vec2(position[0], position[1]), settings.size);
        film.record(x, y, tracePath(context, ray, random, counts));
      }
    }
    film.commit();
  }
  vertices = std::move(record.vertices);
}

}  // namespace cellcut::test
