/// \file scenes.h
/// Scenes made by hand: receivers, occluders and sets of lights of every kind.
#pragma once

#include "renderer/scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace cellcut::test {

/// Exactly Lambertian: metallic 0, roughness 1, specular 0.
Material lambertian(const Vec3& albedo);
/// Metal with this reflectance at normal incidence.
Material metal(const Vec3& f0, float roughness);
/// Black surface with this radiance.
Material emitter(const Vec3& radiance, bool doubleSided);

MaterialId addMaterial(Scene& scene, const Material& material);

/// Each adds a mesh. Fronts: a triangle's is counter-clockwise, a quad's is cross(edgeU, edgeV), a box's and a sphere's
/// outside.
Mesh& addMesh(Scene& scene, MaterialId material);
void appendTriangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c);
void addTriangle(Scene& scene, MaterialId material, const Vec3& a, const Vec3& b, const Vec3& c);
/// In 2·columns·rows triangles, with the quad's corners as texture coordinates (0,0), (1,0), (1,1), (0,1).
void addQuad(Scene& scene, MaterialId material, const Vec3& corner, const Vec3& edgeU, const Vec3& edgeV,
             int columns = 1, int rows = 1);
void addBox(Scene& scene, MaterialId material, const Vec3& lower, const Vec3& upper);
/// Longitudes × latitudes, with smooth normals.
void addSphere(Scene& scene, MaterialId material, const Vec3& centre, float radius, int columns = 64, int rows = 32);

/// Bounds of everything local, as a loader leaves them. Call it last.
void finish(Scene& scene);

Camera perspective(const Vec3& from, const Vec3& to, float verticalFov);
/// A square view of half height `halfHeight`.
Camera orthographic(const Vec3& from, const Vec3& to, float halfHeight);

/// Which lights a scene has.
enum class LightMix : std::uint8_t { kPoint, kSpot, kTriangle, kDirectional, kEnvironment, kAll };
inline constexpr std::array kLightMixes{LightMix::kPoint,       LightMix::kSpot,        LightMix::kTriangle,
                                        LightMix::kDirectional, LightMix::kEnvironment, LightMix::kAll};
std::string nameOf(LightMix mix);

/// Adds `count` lights around the origin, at distances from 3 to 6, of colours and strengths over two decades: a fifth
/// of each kind for kAll. Seen from within 0.3 of the origin no triangle hides another. A count of environment lights
/// is the number of texels, which for up to 64 is the number of tiles.
void addLights(Scene& scene, LightMix mix, int count, std::uint64_t seed);

/// The kinds that have a place.
inline constexpr std::array kLocalMixes{LightMix::kPoint, LightMix::kSpot, LightMix::kTriangle};
/// Adds one light of a local kind at each position, 1 W/sr or 1 W/(m² sr): spots that shine in random directions;
/// triangles that shine from both sides, with their first corner there and edges of about a tenth of the position's
/// largest coordinate.
void addLightsAt(Scene& scene, LightMix mix, std::span<const Vec3> positions, std::uint64_t seed);

/// A room without a ceiling around the origin: floor, two walls, a box and a rough metal ball, with addLights around it
/// and a camera that sees all of it. Shadows and interreflection everywhere.
Scene stage(LightMix mix, int count, std::uint64_t seed);

}  // namespace cellcut::test
