#include "renderer/trace/accel.h"

#include "renderer/base/capabilities.h"
#include "renderer/base/rng.h"
#include "renderer/lights/triangle_light.h"
#include "renderer/scene/material.h"

#include <array>
#include <atomic>
#include <cassert>
#include <new>
#include <stdexcept>

#include <tbb/parallel_invoke.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace cellcut {

/// What a geometry knows of itself: for coverage, and for triangles that Embree finds too small.
struct CoveredMesh {
  const Scene* scene;
  const Mesh* mesh;
};

namespace {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// Embree's context with what the coverage test needs. Embree hands a pointer to its own part back.
struct CoverageContext {
  QueryContext embree;
  const std::uint32_t* seeds;  ///< by the number of the ray

  explicit CoverageContext(const std::uint32_t* raySeeds) : seeds(raySeeds) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&embree);
#else
    rtcInitIntersectContext(&embree);
#endif
  }
};

Vec3 originOf(const RTCRay& ray) {
  return {ray.org_x, ray.org_y, ray.org_z};
}
Vec3 directionOf(const RTCRay& ray) {
  return {ray.dir_x, ray.dir_y, ray.dir_z};
}

/// Where a hit lies in its triangle. Embree leaves both weights 0 where the triangle as the ray sees it is smaller than
/// 10⁻¹⁸ m² (its min_rcp_input), which those of a scene of a micrometre are.
Vec2 barycentricOf(const Mesh& mesh, const Vec3& origin, const Vec3& direction, std::uint32_t triangle, Vec2 found) {
  if (found != Vec2(0)) return found;
  return intersectPlane(triangleGeometry(mesh, triangle), origin, direction).value_or(found);
}

/// Rejects a hit with probability 1 − coverage. The number is a hash of (ray, triangle): it does not depend on the
/// order in which Embree meets the triangles.
void filterCoverage(const RTCFilterFunctionNArguments* args) {
  const auto& covered = *static_cast<const CoveredMesh*>(args->geometryUserPtr);
  const auto& context = *reinterpret_cast<const CoverageContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
    const RTCHit hit = rtcGetHitFromHitN(args->hit, args->N, i);
    const Vec2 barycentric = barycentricOf(*covered.mesh, originOf(ray), directionOf(ray), hit.primID, {hit.u, hit.v});
    const float share = coverage(*covered.scene, {covered.mesh, hit.primID, barycentric});
    const float u = toUnitFloat(static_cast<std::uint32_t>(hashOf(context.seeds[ray.id], hit.geomID, hit.primID)));
    if (!(u < share)) args->valid[i] = 0;
  }
}

/// Where rays begin. Not 0: Embree's interval is closed, and a ray that starts on an axis plane through the origin,
/// where there is no rounding error to be moved past, meets its own triangle at exactly 0.
constexpr float kNearest = std::numeric_limits<float>::min();

/// Embree's largest coordinate: it aborts on rays beyond, and has no triangles there.
constexpr float kLargest = 1.8e18f;

bool isInReach(const Vec3& v) {
  return std::abs(v.x) < kLargest && std::abs(v.y) < kLargest && std::abs(v.z) < kLargest;  // NaN is not
}

/// A ray that meets nothing; tMax is not negative, for that is how Embree says that one was occluded.
constexpr Ray kNoRay{Vec3(0), Vec3(0, 0, 1), 0};

const Ray& reachable(const Ray& ray) {
  return isInReach(ray.origin) && isInReach(ray.direction) ? ray : kNoRay;
}

RTCRay embreeRay(const Ray& asked) {
  const Ray& ray = reachable(asked);
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = kNearest;
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
  std::optional<Hit> hitOf(const RTCRay& ray, const RTCHit& hit) const;
};

std::optional<Hit> Accel::State::hitOf(const RTCRay& ray, const RTCHit& hit) const {
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Mesh& mesh = *covered[hit.geomID].mesh;
  return Hit{ray.tfar, static_cast<MeshId>(hit.geomID), hit.primID,
             barycentricOf(mesh, originOf(ray), directionOf(ray), hit.primID, {hit.u, hit.v})};
}

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
  // Embree builds without denormal numbers, and oneTBB gives all tasks of a thread what the first one found: a sky of
  // 10⁻⁴² would be black to those that come later.
  tbb::parallel_invoke([] {}, [] {});
  // Without a thread count Embree limits no arena of ours.
  state_->device = rtcNewDevice(nullptr);
  if (!state_->device) {
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(error == RTC_ERROR_UNSUPPORTED_CPU
                                 ? "Embree cannot start on this processor"
                                 : "Embree cannot start (error " + std::to_string(error) + ")");
  }
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
  CoverageContext context(&seed);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.embree;
  rtcIntersect1(state_->scene, &query, &arguments);
#else
  rtcIntersect1(state_->scene, &context.embree, &query);
#endif
  return state_->hitOf(query.ray, query.hit);
}

void Accel::intersect(std::span<const Ray> rays, std::span<const std::uint32_t> seeds,
                      std::span<std::optional<Hit>> hits) const {
  assert(rays.size() <= kRayPacket && seeds.size() == rays.size() && hits.size() == rays.size());
  alignas(32) std::array<int, kRayPacket> valid{};  // −1 where there is a ray
  RTCRayHit8 query;
  for (std::size_t i = 0; i < kRayPacket; ++i) {
    // A lane without a ray has an empty one: Embree 3 without eight lanes of its own looks at nothing else.
    const bool used = i < rays.size();
    const Ray& ray = used ? reachable(rays[i]) : kNoRay;
    valid[i] = used ? -1 : 0;
    query.ray.org_x[i] = ray.origin.x, query.ray.org_y[i] = ray.origin.y, query.ray.org_z[i] = ray.origin.z;
    query.ray.dir_x[i] = ray.direction.x, query.ray.dir_y[i] = ray.direction.y;
    query.ray.dir_z[i] = ray.direction.z;
    query.ray.tnear[i] = kNearest, query.ray.tfar[i] = ray.tMax;
    query.ray.time[i] = 0;
    query.ray.mask[i] = 0xffffffffu;
    query.ray.id[i] = used ? static_cast<unsigned>(i) : 0;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  CoverageContext context(seeds.data());
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.embree;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid.data(), state_->scene, &query, &arguments);
#else
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), state_->scene, &context.embree, &query);
#endif
  auto* queries = reinterpret_cast<RTCRayHitN*>(&query);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto lane = static_cast<unsigned>(i);
    hits[i] = state_->hitOf(rtcGetRayFromRayN(RTCRayHitN_RayN(queries, kRayPacket), kRayPacket, lane),
                            rtcGetHitFromHitN(RTCRayHitN_HitN(queries, kRayPacket), kRayPacket, lane));
  }
}

bool Accel::occluded(const Ray& ray, std::uint32_t seed) const {
  // A shadow ray's direction is as long as the way to the light.
  constexpr float kShorter = 0x1p-70f;
  const bool isLong = !isInReach(ray.direction);
  RTCRay query = embreeRay(isLong ? Ray{ray.origin, ray.direction * kShorter, ray.tMax / kShorter} : ray);
  CoverageContext context(&seed);
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
