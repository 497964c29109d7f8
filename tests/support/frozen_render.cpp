#include "tests/support/frozen_render.h"

#include "renderer/scene/camera.h"
#include "renderer/trace/pilot.h"

namespace cellcut::test {

FrozenRender::FrozenRender(const Scene& s, const FrozenSettings& frozen)
    : scene(s),
      settings(frozen),
      accel(s),
      lights(s),
      pilot(pilotVertices(s, accel, s.cameras[0], frozen.maxDepth)),
      sampler(makeLightSampler(frozen.strategy, lights, frozen.sampler, pilot)),
      film(frozen.size.x, frozen.size.y, false) {
  PathRecord record;
  const PathContext context{s, accel, lights, *sampler, frozen.maxDepth, true, false, &record};
  PathCounts counts;
  for (int pass = 0; pass < frozen.passes; ++pass) {
    for (int y = 0; y < frozen.size.y; ++y) {
      for (int x = 0; x < frozen.size.x; ++x) {
        PixelSampler random(PixelSampling::kSobol, 0, x, y, film.passes());
        const Sample4 position = random.next();
        const Ray ray = cameraRay(camera(), Vec2(x, y) + Vec2(position[0], position[1]), frozen.size);
        film.record(x, y, tracePath(context, ray, random, counts));
      }
    }
    film.commit();
  }
  vertices = std::move(record.vertices);
}

}  // namespace cellcut::test
