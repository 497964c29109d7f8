#include "renderer/trace/accel.h"

#include "renderer/base/rng.h"
#include "renderer/base/warp.h"
#include "renderer/lights/triangle_light.h"
#include "tests/support/depth.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/vectors.h"

#include <array>
#include <atomic>
#include <thread>

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace cellcut::test {
namespace {

TEST(Accel, FindsTheNearestTriangle) {
  Scene scene;
  const MaterialId grey = addMaterial(scene, lambertian(Vec3(0.5f)));
  addQuad(scene, grey, {-1, -1, 3}, {2, 0, 0}, {0, 2, 0});
  addQuad(scene, grey, {-1, -1, 2}, {2, 0, 0}, {0, 2, 0});
  const Accel accel(scene);
  const auto hit = accel.intersect({Vec3(0.5f, -0.25f, 0), {0, 0, 1}}, 0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->mesh, MeshId{1});
  EXPECT_FLOAT_EQ(hit->t, 2);
  EXPECT_FALSE(accel.intersect({Vec3(0), {0, 0, -1}}, 0));
  EXPECT_FALSE(accel.intersect({Vec3(0), {0, 0, 1}, 1.9f}, 0));
  EXPECT_TRUE(accel.occluded({Vec3(0), {0, 0, 1}, 2.1f}, 0));
  EXPECT_FALSE(accel.occluded({Vec3(0), {0, 0, 1}, 1.9f}, 0));
}

TEST(Accel, LeavesDenormalNumbersToTheThreadThatBuildsIt) {
  Scene scene;
  addQuad(scene, addMaterial(scene, lambertian(Vec3(0.5f))), Vec3(0), {1, 0, 0}, {0, 1, 0});
  std::atomic<int> lost{0};
  // A thread that has had no tasks before.
  std::thread([&] {
    const Accel accel(scene);
    tbb::parallel_for(0, 64, [&](int) {
      volatile float tiny = std::numeric_limits<float>::min();
      tiny = tiny * 0.25f;
      if (!(tiny > 0)) ++lost;
    });
  }).join();
  EXPECT_EQ(lost, 0);
}

TEST(Accel, RaysBeyondEmbreesReachMeetNothingAndLongShadowRaysAreTraced) {
  Scene scene;
  addQuad(scene, addMaterial(scene, lambertian(Vec3(0.5f))), {-1e6f, -1e6f, 10}, {2e6f, 0, 0}, {0, 2e6f, 0});
  const Accel accel(scene);
  for (const float far : {1.9e18f, 1e19f, 3e38f}) {
    const Ray from{{0, 0, -far}, {0, 0, 1}};
    EXPECT_FALSE(accel.intersect(from, 0)) << far;
    EXPECT_FALSE(accel.occluded(from, 0)) << far;
    std::array<std::optional<Hit>, 2> hits;
    const std::array<std::uint32_t, 2> seeds{};
    accel.intersect(std::array{from, Ray{Vec3(0), {0, 0, 1}}}, seeds, hits);
    EXPECT_FALSE(hits[0]) << far;
    EXPECT_TRUE(hits[1]) << far;
    EXPECT_TRUE(accel.occluded(shadowRay(Vec3(0), {0, 0, far}), 0)) << far;
    EXPECT_FALSE(accel.occluded(shadowRay(Vec3(0), {0, 0, -far}), 0)) << far;
  }
}

TEST(Accel, KnowsWhereAMinuteTriangleIsHit) {
  // Embree alone knows it down to 10⁻¹⁸ m².
  for (const float size : {1.0f, 1e-6f, 1e-9f, 1e-12f}) {
    Scene scene;
    Material corner = lambertian(Vec3(1));
    corner.alphaMode = AlphaMode::kMask;
    corner.setSlot(TextureUse::kBaseColor, {TextureId{0}});
    scene.texels.push_back(ImageRgba8(2, 1));  // alpha 0 on the left, 255 on the right
    scene.texels[0].at(1, 0).w = 255;
    scene.textures.push_back({TexelsId{0}, Wrap::kClamp, Wrap::kClamp, true});
    addQuad(scene, addMaterial(scene, corner), {0, 0, size}, {size, 0, 0}, {0, size, 0});
    const Accel accel(scene);
    for (const Vec2 at : {Vec2(0.75f, 0.25f), Vec2(0.9f, 0.8f), Vec2(0.6f, 0.1f)}) {
      const auto hit = accel.intersect({size * Vec3(at, 0), {0, 0, 1}}, 0);
      ASSERT_TRUE(hit) << size;
      const Mesh& mesh = scene.meshes[0];
      const Triangle t = mesh.triangles[hit->triangle];
      const Vec2 b = hit->barycentric;
      const Vec3 p = (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
      EXPECT_LT(glm::length(p - size * Vec3(at, 1)), 1e-5f * size) << size;  // a few roundings, and Embree's 1 / x
    }
    EXPECT_FALSE(accel.intersect({size * Vec3(0.25f, 0.1f, 0), {0, 0, 1}}, 0)) << "the mask's hole, size " << size;
    EXPECT_FALSE(accel.occluded({size * Vec3(0.3f, 0.6f, 0), {0, 0, 1}}, 0)) << "the mask's hole, size " << size;
  }
}

TEST(Accel, APacketFindsWhatItsRaysFindOneByOne) {
  // Walls of many sizes, half of them partly covered, and rays of neighbouring pixels.
  Rng rng(4);
  for (const float size : {1e-9f, 1e-3f, 1.0f, 1e6f}) {
    Scene scene;
    Material glass = lambertian(Vec3(1));
    glass.alphaMode = AlphaMode::kBlend;
    glass.baseColor.w = 0.4f;
    const std::array materials{addMaterial(scene, lambertian(Vec3(1))), addMaterial(scene, glass)};
    for (std::size_t i = 0; i < 60; ++i) {
      const Vec3 at = size * Vec3(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(2, 8));
      addQuad(scene, materials[i % 2], at, size * 2.0f * randomUnit(rng), size * 2.0f * randomUnit(rng));
    }
    const Accel accel(scene);
    std::size_t found = 0;
    for (std::uint32_t packet = 0; packet < 400; ++packet) {
      const Vec3 middle(rng.uniform(-0.5f, 0.5f), rng.uniform(-0.5f, 0.5f), 1);
      const std::size_t count = 1 + packet % kRayPacket;
      std::array<Ray, kRayPacket> rays;
      std::array<std::uint32_t, kRayPacket> seeds;
      std::array<std::optional<Hit>, kRayPacket> hits;
      for (std::size_t i = 0; i < count; ++i) {
        rays[i] = {Vec3(0), glm::normalize(middle + 0.01f * randomUnit(rng))};
        seeds[i] = 100 * packet + static_cast<std::uint32_t>(i);
      }
      accel.intersect(std::span(rays).first(count), std::span(seeds).first(count), std::span(hits).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        const std::optional<Hit> alone = accel.intersect(rays[i], seeds[i]);
        ASSERT_EQ(hits[i].has_value(), alone.has_value());
        if (!alone) continue;
        ++found;
        ASSERT_EQ(hits[i]->mesh, alone->mesh);
        ASSERT_EQ(hits[i]->triangle, alone->triangle);
        // Embree's instructions are not the same for packets.
        ASSERT_NEAR(hits[i]->t, alone->t, 1e-5f * alone->t);
        ASSERT_LT(glm::length(hits[i]->barycentric - alone->barycentric), 1e-4f);
      }
      for (std::size_t i = count; i < kRayPacket; ++i) ASSERT_FALSE(hits[i]);
    }
    EXPECT_GT(found, 1000u) << size;
  }
}

TEST(Accel, EmptySceneHasNoHits) {
  const Scene scene;
  const Accel accel(scene);
  EXPECT_FALSE(accel.intersect({Vec3(0), {0, 0, 1}}, 0));
  EXPECT_FALSE(accel.occluded({Vec3(0), {0, 0, 1}}, 0));
}

TEST(Accel, ARayDoesNotMeetThePlaneItStartsOn) {
  // Planes through the origin hold points without any rounding error to be moved past.
  for (int axis = 0; axis < 3; ++axis) {
    for (const float size : {1e-6f, 1.0f, 1e6f}) {
      Scene scene;
      Vec3 u(0), v(0), n(0);
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = size;
      n[axis] = 1;
      addQuad(scene, addMaterial(scene, lambertian(Vec3(1))), -0.5f * (u + v), u, v, 3, 3);
      const Accel accel(scene);
      Rng rng(1);
      for (int i = 0; i < 1000; ++i) {
        const Vec3 p = rng.uniform(-0.4f, 0.4f) * u + rng.uniform(-0.4f, 0.4f) * v;
        const Vec3 direction = randomUnit(rng);
        const Vec3 origin =
            offsetRayOrigin(p, triangleError(-0.5f * (u + v), 0.5f * (u - v), 0.5f * (u + v)), n, direction);
        ASSERT_FALSE(accel.occluded({origin, direction}, 0)) << "axis " << axis << ", size " << size;
        ASSERT_FALSE(accel.intersect({origin, direction}, 0)) << "axis " << axis << ", size " << size;
      }
    }
  }
}

TEST(Accel, PartlyCoveredSurfaceStopsItsShareOfRays) {
  for (const float alpha : {0.0f, 0.25f, 0.7f, 1.0f}) {
    Scene scene;
    Material veil = lambertian(Vec3(1));
    veil.baseColor.w = alpha;
    veil.alphaMode = AlphaMode::kBlend;
    const MaterialId material = addMaterial(scene, veil);
    addQuad(scene, material, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    addQuad(scene, material, {-1, -1, 2}, {2, 0, 0}, {0, 2, 0});
    const Accel accel(scene);
    Moments first, second, shadow;
    for (std::uint32_t seed = 0; seed < 20000; ++seed) {
      const auto hit = accel.intersect({Vec3(0.1f, 0.3f, 0), {0, 0, 1}}, seed);
      first.add(hit && hit->t < 1.5f ? 1 : 0);
      second.add(hit && hit->t > 1.5f ? 1 : 0);
      const bool occluded = accel.occluded({Vec3(0.1f, 0.3f, 0), {0, 0, 1}}, seed);
      shadow.add(occluded ? 1 : 0);
      ASSERT_EQ(occluded, hit.has_value()) << "the same ray with the same seed";
    }
    const double a = static_cast<double>(alpha);
    EXPECT_LT(std::abs(zScore(first.mean(), first.meanVariance(), a, 0)), criticalZ(12));
    // The two veils decide independently.
    EXPECT_LT(std::abs(zScore(second.mean(), second.meanVariance(), a * (1 - a), 0)), criticalZ(12));
    EXPECT_LT(std::abs(zScore(shadow.mean(), shadow.meanVariance(), 1 - (1 - a) * (1 - a), 0)), criticalZ(12));
  }
}

TEST(Accel, MaskIsAllOrNothing) {
  for (const auto& [alpha, hits] : {std::pair(0.49f, false), std::pair(0.5f, true)}) {
    Scene scene;
    Material mask = lambertian(Vec3(1));
    mask.baseColor.w = alpha;
    mask.alphaMode = AlphaMode::kMask;
    addQuad(scene, addMaterial(scene, mask), {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    const Accel accel(scene);
    for (std::uint32_t seed = 0; seed < 100; ++seed)
      EXPECT_EQ(accel.occluded({Vec3(0.1f, 0.3f, 0), {0, 0, 1}}, seed), hits);
  }
}

TEST(Accel, MaskHasNoHolesWhereTheAlphaOfVerticesIsItsCutoff) {
  Rng rng(5);
  for (const float alpha : {1.0f, 0.75f, 0.5f, 0.2f}) {
    Scene scene;
    Material mask = lambertian(Vec3(1));
    mask.alphaMode = AlphaMode::kMask;
    mask.alphaCutoff = alpha;
    addQuad(scene, addMaterial(scene, mask), {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    scene.meshes[0].colors.assign(scene.meshes[0].positions.size(), Vec4(1, 1, 1, alpha));
    const Accel accel(scene);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_TRUE(accel.occluded({{rng.uniform(), rng.uniform(), 0}, {0, 0, 1}}, 0)) << alpha;
    }
  }
}

TEST(Accel, NothingLeaksThroughSharedEdges) {
  // Rays from inside a ball at points of its edges, and at its very vertices.
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    Scene scene;
    addSphere(scene, addMaterial(scene, lambertian(Vec3(1))), Vec3(0), scale, 32, 16);
    const Accel accel(scene);
    const Mesh& mesh = scene.meshes[0];
    Rng rng(2);
    std::size_t leaks = 0, leaksAtVertices = 0;
    const std::size_t rays = sampleShare(byDepth(200'000, 2'000'000));
    for (std::size_t i = 0; i < rays; ++i) {
      const Triangle& t = mesh.triangles[rng.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
      const auto edge = static_cast<int>(rng.below(3));
      const Vec3 a = mesh.positions[t[edge]], b = mesh.positions[t[(edge + 1) % 3]];
      const bool atVertex = i % 8 == 0;
      const float s = atVertex ? 0.0f : rng.uniform();
      const Vec3 origin = 0.3f * scale * randomUnit(rng);
      if (!accel.intersect({origin, glm::normalize((1 - s) * a + s * b - origin)}, 0))
        ++(atVertex ? leaksAtVertices : leaks);
    }
    EXPECT_EQ(leaks, 0u) << "scale " << scale;
    // Embree's edge tests are watertight, the fans of six around a vertex are not: 10⁻⁴ of rays at the very float of a
    // vertex, which no camera aims at.
    EXPECT_LT(static_cast<double>(leaksAtVertices), 1e-3 * static_cast<double>(rays)) << "scale " << scale;
  }
}

struct Placement {
  float scale;
  float offset;  ///< of the scene from the origin, in its own radii
};

class RayOrigins : public testing::TestWithParam<Placement> {};

TEST_P(RayOrigins, NeitherMeetTheirOwnSurfaceNorLeaveTheRoom) {
  // A closed room with a ball in it. From every hit a ray goes on: it may not find the triangle that it left, and may
  // not escape.
  const auto [scale, offset] = GetParam();
  const Vec3 at = scale * offset * glm::normalize(Vec3(1, 0.7f, -0.4f));
  Scene scene;
  const MaterialId grey = addMaterial(scene, lambertian(Vec3(0.5f)));
  const Vec3 lower = at + Vec3(-scale), upper = at + Vec3(scale);
  addBox(scene, grey, lower, upper);
  // Coarse enough that the ball's triangles, too, are told apart by floats 10⁻³ of the radius apart.
  addSphere(scene, grey, at, 0.5f * scale, 12, 6);
  const Accel accel(scene);
  Rng rng(3);
  std::size_t selfHits = 0, escapes = 0, outside = 0, total = 0;
  const std::size_t rays = sampleShare(byDepth(100'000, 1'500'000));
  Ray ray{at + scale * Vec3(0.7f, 0.6f, 0.5f), randomUnit(rng)};
  std::optional<Hit> from;
  for (std::size_t i = 0; i < rays; ++i) {
    const auto hit = accel.intersect(ray, 0);
    ++total;
    if (!hit) {
      const bool strictlyInside =
          glm::all(glm::lessThan(lower, ray.origin)) && glm::all(glm::lessThan(ray.origin, upper));
      ++(strictlyInside ? escapes : outside);
      ray = {at + scale * Vec3(0.7f, 0.6f, 0.5f), randomUnit(rng)};
      from.reset();
      continue;
    }
    if (from && from->mesh == hit->mesh && from->triangle == hit->triangle) ++selfHits;
    const Mesh& mesh = scene.meshes[indexOf(hit->mesh)];
    const TriangleGeometry g = triangleGeometry(mesh, hit->triangle);
    const Vec3 p = (1 - hit->barycentric.x - hit->barycentric.y) * g.corners[0] + hit->barycentric.x * g.corners[1] +
                   hit->barycentric.y * g.corners[2];
    const Vec3 normal = glm::dot(g.normal, ray.direction) < 0 ? g.normal : -g.normal;
    Vec3 direction = Frame(normal).toWorld(cosineHemisphere({rng.uniform(), rng.uniform()}));
    // One in eight grazes.
    if (rng.below(8) == 0) direction = glm::normalize(direction - 0.9999f * glm::dot(direction, normal) * normal);
    ray = {offsetRayOrigin(p, triangleError(g.corners[0], g.corners[1], g.corners[2]), normal, direction),
           glm::normalize(direction)};
    from = hit;
  }
  EXPECT_EQ(selfHits, 0u) << "of " << total;
  EXPECT_EQ(escapes, 0u) << "of " << total;
  // In a corner the point itself may be rounded into the wall: as often as it is within a float's spacing of it.
  const double spacing =
      static_cast<double>(std::nextafter(glm::length(at) + scale, kInfinity) - (glm::length(at) + scale)) / scale;
  EXPECT_LE(static_cast<double>(outside), 1 + 4 * spacing * static_cast<double>(total));
}

INSTANTIATE_TEST_SUITE_P(Scales, RayOrigins,
                         testing::Values(Placement{1e-6f, 0}, Placement{1e-3f, 0}, Placement{1, 0}, Placement{1e6f, 0},
                                         Placement{1, 1}, Placement{1, 100}, Placement{1, 1e4f}, Placement{1e-6f, 1e4f},
                                         Placement{1e6f, 1e4f}),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

}  // namespace
}  // namespace cellcut::test
