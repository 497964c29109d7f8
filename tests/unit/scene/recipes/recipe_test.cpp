#include "renderer/scene/recipes/recipe.h"

#include "renderer/base/rng.h"
#include "tests/support/depth.h"
#include "tests/support/glb_reader.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

using test::Glb;
using test::GlbTriangle;

Glb generate(Recipe recipe, std::size_t lights, std::uint64_t seed = 1) {
  return test::readGlb(generateRecipe(recipe, lights, seed));
}

class Recipes : public ::testing::TestWithParam<RecipeName> {
 protected:
  Recipe recipe() const { return GetParam().recipe; }
};

INSTANTIATE_TEST_SUITE_P(All, Recipes, ::testing::ValuesIn(kRecipes),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Recipes, HaveExactlyTheLightsAskedFor) {
  for (std::size_t lights = 0; lights < 40; ++lights) EXPECT_EQ(generate(recipe(), lights).lightCount(), lights);
  for (const std::size_t lights : std::initializer_list<std::size_t>{100, 101, 333, 999, 1000, 4001, 20'011}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      EXPECT_EQ(generate(recipe(), lights, seed).lightCount(), lights) << "seed " << seed;
    }
  }
}

TEST_P(Recipes, FitAMillionLightsInto150Megabytes) {
  const std::size_t lights = test::sampleShare(1'000'000);
  const std::vector<std::byte> bytes = generateRecipe(recipe(), lights, 7);
  EXPECT_LT(bytes.size(), 150'000'000u);
  EXPECT_EQ(test::readGlb(bytes).lightCount(), lights);
}

TEST_P(Recipes, AreTheSameBytesForTheSameSeedAndOthersForAnother) {
  EXPECT_EQ(generateRecipe(recipe(), 500, 3), generateRecipe(recipe(), 500, 3));
  const Glb one = generate(recipe(), 500, 3), other = generate(recipe(), 500, 4);
  EXPECT_NE(one.binary, other.binary);
}

TEST_P(Recipes, HaveNoDegenerateTriangles) {
  for (const GlbTriangle& t : generate(recipe(), 2000).triangles()) {
    const float twiceArea = glm::length(t.normal());
    ASSERT_TRUE(std::isfinite(twiceArea));
    // The smallest bulbs are some 4 mm wide: 1e-5 m². A product that cancels is below 1e-8.
    ASSERT_GT(twiceArea, 1e-6f) << t.centroid().x << ' ' << t.centroid().y << ' ' << t.centroid().z;
  }
}

TEST_P(Recipes, StateTheBoundsOfTheirPositions) {
  const Glb glb = generate(recipe(), 300);
  std::map<std::size_t, Bounds> bounds;
  for (const GlbTriangle& t : glb.triangles()) {
    for (const Vec3& p : t.corners) bounds[t.material].add(p);
  }
  for (const auto& mesh : glb.json["meshes"]) {
    Bounds stated;
    for (const auto& primitive : mesh["primitives"]) {
      const auto& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      stated.add({accessor["min"][0], accessor["min"][1], accessor["min"][2]});
      stated.add({accessor["max"][0], accessor["max"][1], accessor["max"][2]});
    }
    const Bounds& found = bounds[mesh["primitives"][0]["material"].get<std::size_t>()];
    EXPECT_EQ(stated.lower, found.lower) << mesh["name"];
    EXPECT_EQ(stated.upper, found.upper) << mesh["name"];
  }
}

/// Brute force, so that the test shares nothing with the ray tracer.
/// \return the nearest hit, or null
const GlbTriangle* nearest(const std::vector<GlbTriangle>& triangles, const Vec3& origin, const Vec3& direction) {
  const GlbTriangle* hit = nullptr;
  float nearestT = kInfinity;
  for (const GlbTriangle& triangle : triangles) {  // Möller and Trumbore 1997
    const Vec3 e1 = triangle.corners[1] - triangle.corners[0], e2 = triangle.corners[2] - triangle.corners[0];
    const Vec3 p = glm::cross(direction, e2), s = origin - triangle.corners[0], q = glm::cross(s, e1);
    const float determinant = glm::dot(e1, p);
    const float u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const float t = glm::dot(e2, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearestT) {
      nearestT = t;
      hit = &triangle;
    }
  }
  return hit;
}

// A lamp that looks the wrong way, sits inside of a wall or a table, or shines at a face that is wound the wrong way,
// sees a back.
TEST_P(Recipes, LampsSeeOnlyTheFrontsOfSurfaces) {
  const Glb glb = generate(recipe(), 120);
  const std::vector<GlbTriangle> triangles = glb.triangles();
  Rng rng(5);
  for (const GlbTriangle& lamp : triangles) {
    if (!glb.isEmissive(lamp.material)) continue;
    const Vec3 normal = glm::normalize(lamp.normal());
    const Frame frame(normal);
    for (int i = 0; i < 4; ++i) {
      const float height = rng.uniform(0.1f, 1.0f), angle = rng.uniform(0, 2 * kPi),
                  across = safeSqrt(1 - height * height);
      const Vec3 direction = frame.toWorld({across * std::cos(angle), across * std::sin(angle), height});
      // A tenth of a millimetre clears the lamp itself by more than floats lose 100 m from the origin.
      const GlbTriangle* hit = nearest(triangles, lamp.centroid() + 1e-4f * normal, direction);
      if (hit == nullptr || glb.isDoubleSided(hit->material)) continue;
      EXPECT_LT(glm::dot(hit->normal(), direction), 0)
          << glb.materialName(lamp.material) << " at " << lamp.centroid().x << ' ' << lamp.centroid().y << ' '
          << lamp.centroid().z << " sees the back of " << glb.materialName(hit->material);
    }
  }
}

TEST_P(Recipes, CamerasSeeOnlyTheFrontsOfSurfaces) {
  const Glb glb = generate(recipe(), 60);
  const std::vector<GlbTriangle> triangles = glb.triangles();
  std::size_t cameras = 0;
  Rng rng(6);
  for (const auto& node : glb.json["nodes"]) {
    if (!node.contains("camera")) continue;
    ++cameras;
    const Vec3 eye(node["translation"][0], node["translation"][1], node["translation"][2]);
    for (int i = 0; i < 200; ++i) {
      const float y = rng.uniform(-1, 1), angle = rng.uniform(0, 2 * kPi), across = safeSqrt(1 - y * y);
      const Vec3 direction(across * std::cos(angle), y, across * std::sin(angle));
      const GlbTriangle* hit = nearest(triangles, eye, direction);
      if (hit == nullptr || glb.isDoubleSided(hit->material)) continue;
      EXPECT_LT(glm::dot(hit->normal(), direction), 0)
          << node["name"] << " sees the back of " << glb.materialName(hit->material) << " at " << hit->centroid().x
          << ' ' << hit->centroid().y << ' ' << hit->centroid().z;
    }
  }
  EXPECT_GE(cameras, 2u);
}

// Rooms: every edge of walls, floors and ceilings is shared by two triangles that run along it in opposite directions,
// but for those on the open front. (Furniture of the same paint is closed or stands on a floor: its edges at y = floor
// are skipped.)
TEST(RoomsRecipe, RoomsHaveNoCracks) {
  const Glb glb = generate(Recipe::kRooms, 30);
  static const std::set<std::string> kShell{"ceiling", "cream wall", "sage wall", "sky wall", "ochre wall"};
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [](const Vec3& p) { return Point{p.x, p.y, p.z}; };
  for (const GlbTriangle& t : glb.triangles()) {
    if (glb.isEmissive(t.material)) continue;
    for (std::size_t k = 0; k < 3; ++k) ++edges[{point(t.corners[k]), point(t.corners[(k + 1) % 3])}];
  }
  std::size_t tested = 0;
  for (const GlbTriangle& t : glb.triangles()) {
    if (!kShell.contains(glb.materialName(t.material))) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = t.corners[k], b = t.corners[(k + 1) % 3];
      if (a.z == 0 && b.z == 0) continue;
      ++tested;
      EXPECT_EQ((edges[{point(b), point(a)}]), 1)
          << a.x << ' ' << a.y << ' ' << a.z << " – " << b.x << ' ' << b.y << ' ' << b.z;
    }
  }
  EXPECT_GT(tested, 100u);
}

TEST(KindsRecipe, HasEveryKindOfLight) {
  for (const std::size_t lights : std::initializer_list<std::size_t>{8, 30, 300}) {
    const Glb glb = generate(Recipe::kKinds, lights);
    EXPECT_GT(glb.punctualCount("point"), 0u);
    EXPECT_GT(glb.punctualCount("spot"), 0u);
    EXPECT_GT(glb.punctualCount("directional"), 0u);
    EXPECT_LT(glb.punctualCount("point") + glb.punctualCount("spot") + glb.punctualCount("directional"), lights);
    const std::size_t view = glb.json["extensions"]["CELLCUT_environment"]["bufferView"];
    const std::size_t offset = glb.json["bufferViews"][view]["byteOffset"];
    EXPECT_EQ(glb.binary.at(offset), std::byte{0x76});  // OpenEXR's magic number, little-endian 20000630
    bool textured = false, twoSided = false;
    for (std::size_t m = 0; m < glb.json["materials"].size(); ++m) {
      textured |= glb.json["materials"][m].contains("emissiveTexture");
      twoSided |= glb.isEmissive(m) && glb.isDoubleSided(m);
    }
    EXPECT_TRUE(textured);
    EXPECT_TRUE(twoSided);
  }
}

TEST(StreetRecipe, ShinesByMoonSpotsPointsAndWindows) {
  const Glb glb = generate(Recipe::kStreet, 300);
  EXPECT_EQ(glb.punctualCount("directional"), 1u);
  EXPECT_GT(glb.punctualCount("spot"), 0u);
  EXPECT_GT(glb.punctualCount("point"), 0u);
}

}  // namespace
}  // namespace cellcut
