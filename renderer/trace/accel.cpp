#include "renderer/trace/accel.h"

#include "renderer/base/capabilities.h"
#include "renderer/base/rng.h"
#include "renderer/lights/triangle_light.h"
#include "renderer/scene/material.h"

#include <atomic>
#include <new>
#include <stdexcept>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace cellcut {
namespace {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// Embree's context with what the coverage test needs. Embree hands a pointer to its own part back.
struct CoverageContext {
  QueryContext embree;
  std::uint32_t seed;

  explicit CoverageContext(std::uint32_t raySeed) : seed(raySeed) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&embree);
#else
    rtcInitIntersectContext(&embree);
#endif
  }
};

/// What a geometry knows of itself: for coverage, and for triangles that Embree finds too small.
struct CoveredMesh {
  const Scene* scene;
  const Mesh* mesh;
};

/// Where a hit lies in its triangle. Embree leaves both weights 0 where the triangle as the ray sees it is smaller than
/// 10⁻¹⁸ m² (its min_rcp_input), which those of a scene of a micrometre are.
Vec2 barycentricOf(const Mesh& mesh, const RTCRay& ray, std::uint32_t triangle, Vec2 found) {
  if (found != Vec2(0)) return found;
  const Vec3 origin(ray.org_x, ray.org_y, ray.org_z), direction(ray.dir_x, ray.dir_y, ray.dir_z);
  return intersectPlane(triangleGeometry(mesh, triangle), origin, direction).value_or(found);
}

/// Rejects a hit with probability 1 − coverage. The number is a hash of (ray, triangle): it does not depend on the
/// order in which Embree meets the triangles.
void filterCoverage(const RTCFilterFunctionNArguments* args) {
  const auto& covered = *static_cast<const CoveredMesh*>(args->geometryUserPtr);
  const auto& context = *reinterpret_cast<const CoverageContext*>(args->context);
  if (args->valid[0] != -1) return;
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const Vec2 barycentric = barycentricOf(*covered.mesh, *ray, hit->primID, {hit->u, hit->v});
  const float share = coverage(*covered.scene, {covered.mesh, hit->primID, barycentric});
  const float u = toUnitFloat(static_cast<std::uint32_t>(hashOf(context.seed, hit->geomID, hit->primID)));
  if (!(u < share)) args->valid[0] = 0;
}

RTCRay embreeRay(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  // Not 0: Embree's interval is closed, and a ray that starts on an axis plane through the origin, where there is no
  // rounding error to be moved past, meets its own triangle at exactly 0.
  r.tnear = std::numeric_limits<float>::min();
  r.tfar = ray.tMax;
  r.time = 0;
  r.mask = 0xffffffffu;
  r.id = 0;
  r.flags = 0;
  return r;
}

}  // namespace

struct Accel::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<CoveredMesh> covered;  ///< one per mesh; Embree points into it
  std::atomic<std::ptrdiff_t> bytes{0};

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void attach(const Mesh& mesh, unsigned id, bool partlyCovered);
};

void Accel::State::attach(const Mesh& mesh, unsigned id, bool partlyCovered) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(Vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Triangle), mesh.triangles.size());
  if (partlyCovered) {
    rtcSetGeometryUserData(geometry, &covered[id]);
    rtcSetGeometryIntersectFilterFunction(geometry, filterCoverage);
    rtcSetGeometryOccludedFilterFunction(geometry, filterCoverage);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

Accel::Accel(const Scene& scene) : state_(std::make_unique<State>()) {
  // Without a thread count Embree limits no arena of ours.
  state_->device = rtcNewDevice(nullptr);
  if (!state_->device) throw std::runtime_error("Embree cannot start on this processor");
  rtcSetDeviceMemoryMonitorFunction(
      state_->device,
      [](void* state, ssize_t bytes, bool) {
        static_cast<State*>(state)->bytes += bytes;
        return true;
      },
      state_.get());

  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  state_->covered.resize(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    state_->covered[i] = {&scene, &mesh};
    const bool partlyCovered = kCanHaveAlpha && scene.materials[indexOf(mesh.material)].alphaMode != AlphaMode::kOpaque;
    if (!mesh.triangles.empty()) state_->attach(mesh, static_cast<unsigned>(i), partlyCovered);
  }
  rtcCommitScene(state_->scene);
  switch (rtcGetDeviceError(state_->device)) {
    case RTC_ERROR_NONE:
      break;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    default:
      throw std::runtime_error("Embree could not build the scene");
  }
}

Accel::~Accel() = default;
Accel::Accel(Accel&&) noexcept = default;

std::optional<Hit> Accel::intersect(const Ray& ray, std::uint32_t seed) const {
  RTCRayHit query;
  query.ray = embreeRay(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  CoverageContext context(seed);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.embree;
  rtcIntersect1(state_->scene, &query, &arguments);
#else
  rtcIntersect1(state_->scene, &context.embree, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Mesh& mesh = *state_->covered[query.hit.geomID].mesh;
  return Hit{query.ray.tfar, static_cast<MeshId>(query.hit.geomID), query.hit.primID,
             barycentricOf(mesh, query.ray, query.hit.primID, {query.hit.u, query.hit.v})};
}

bool Accel::occluded(const Ray& ray, std::uint32_t seed) const {
  RTCRay query = embreeRay(ray);
  CoverageContext context(seed);
#if RTC_VERSION_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context.embree;
  rtcOccluded1(state_->scene, &query, &arguments);
#else
  rtcOccluded1(state_->scene, &context.embree, &query);
#endif
  return query.tfar < 0;
}

std::size_t Accel::bytes() const {
  return static_cast<std::size_t>(state_->bytes.load());
}

}  // namespace cellcut
