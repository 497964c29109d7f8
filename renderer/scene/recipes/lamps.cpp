#include "renderer/scene/recipes/lamps.h"

#include <array>

namespace cellcut {

namespace {

/// Thin rod without its ends.
void addRod(Surface& s, const Pose& pose, float fromY, float toY, float halfWidth) {
  addBox(s, pose, {-halfWidth, fromY, -halfWidth}, {halfWidth, toY, halfWidth}, kTop | kBottom);
}

constexpr float kCord = 0.006f;
constexpr float octahedronArea(float radius) {
  return 6.9282f * radius * radius;
}  // 4√3 r²
constexpr float tetrahedronArea(float radius) {
  return 4.6188f * radius * radius;
}  // 8/√3 r²

}  // namespace

void addCeilingPanel(Palette& palette, const Pose& ceiling, Vec2 size, int panes, Glow glow) {
  constexpr float kDepth = 0.05f;
  constexpr float kRim = 0.02f;
  const Vec3 half(size.x / 2, 0, size.y / 2);
  addBox(palette.flat(Paint::kSteel), ceiling, {-half.x, -kDepth, -half.z}, {half.x, 0, half.z}, kTop);
  const float paneWidth = size.x / static_cast<float>(panes);
  const float area = (paneWidth - 2 * kRim) * (size.y - 2 * kRim) * static_cast<float>(panes);
  Surface& light = palette.emitter(glow.tint, radianceOf(glow.flux, area));
  for (int i = 0; i < panes; ++i) {
    const float x0 = -half.x + static_cast<float>(i) * paneWidth + kRim;
    const float x1 = x0 + paneWidth - 2 * kRim;
    const float y = -kDepth - 0.004f;  // clear of the box by more than floats lose a kilometre away
    const float z = half.z - kRim;
    addQuad(light, ceiling.point({x0, y, -z}), ceiling.point({x1, y, -z}), ceiling.point({x1, y, z}),
            ceiling.point({x0, y, z}));
  }
}

void addPendant(Palette& palette, const Pose& ceiling, float drop, Paint shade, Glow glow) {
  constexpr float kBulb = 0.07f;
  const Vec3 bulb = ceiling.point({0, -drop, 0});
  addRod(palette.flat(Paint::kBlackMetal), ceiling, -drop + kBulb, 0, kCord);
  addFrustum(palette.flat(shade), bulb - Vec3(0, 0.10f, 0), 0.26f, 0.09f, 0.26f, 16, kTop | kBottom);
  addOctahedron(palette.emitter(glow.tint, radianceOf(glow.flux, octahedronArea(kBulb))), bulb, kBulb);
}

void addFloorLamp(Palette& palette, const Pose& floor, float height, Paint shade, Glow glow) {
  constexpr float kBulb = 0.07f;
  addFrustum(palette.flat(Paint::kBlackMetal), floor.origin, 0.15f, 0.14f, 0.03f, 12, kBottom);
  addRod(palette.flat(Paint::kBlackMetal), floor, 0.03f, height - kBulb, 0.012f);
  const Vec3 bulb = floor.point({0, height, 0});
  addFrustum(palette.flat(shade), bulb - Vec3(0, 0.16f, 0), 0.22f, 0.16f, 0.34f, 16, kTop | kBottom);
  addOctahedron(palette.emitter(glow.tint, radianceOf(glow.flux, octahedronArea(kBulb))), bulb, kBulb);
}

void addGlobe(Palette& palette, const Pose& ceiling, float drop, float radius, Glow glow) {
  // Each octant of an octahedron cut in four and pushed out to the sphere.
  const Vec3 centre = ceiling.point({0, -drop, 0});
  addRod(palette.flat(Paint::kBlackMetal), ceiling, -drop + radius, 0, kCord);
  Surface& light = palette.emitter(glow.tint, radianceOf(glow.flux, 4 * kPi * radius * radius));
  Surface octahedron;
  addOctahedron(octahedron, Vec3(0.0f), 1);
  for (std::size_t t = 0; t < octahedron.indices.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return octahedron.positions[octahedron.indices[t + i]]; };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    std::array<std::uint32_t, 6> v{};
    const std::array<Vec3, 6> directions{a, b, c, a + b, b + c, c + a};
    for (std::size_t i = 0; i < 6; ++i) v[i] = light.add(centre + radius * glm::normalize(directions[i]));
    light.triangle(v[0], v[3], v[5]);
    light.triangle(v[3], v[1], v[4]);
    light.triangle(v[5], v[4], v[2]);
    light.triangle(v[3], v[4], v[5]);
  }
}

void addSconce(Palette& palette, const Pose& wall, Glow glow) {
  const Vec3 half(0.09f, 0.10f, 0);
  constexpr float kDepth = 0.11f;
  addBox(palette.flat(Paint::kBlackMetal), wall, {-half.x, -half.y, 0}, {half.x, half.y, kDepth}, kBack);
  constexpr float kRim = 0.01f;
  const float x = half.x - kRim, z0 = kRim, z1 = kDepth - kRim, y = half.y + 0.003f;
  Surface& light = palette.emitter(glow.tint, radianceOf(glow.flux, 4 * x * (z1 - z0)));
  addQuad(light, wall.point({-x, y, z1}), wall.point({x, y, z1}), wall.point({x, y, z0}), wall.point({-x, y, z0}));
  addQuad(light, wall.point({-x, -y, z0}), wall.point({x, -y, z0}), wall.point({x, -y, z1}), wall.point({-x, -y, z1}));
}

void addTube(Palette& palette, const Pose& wall, float length, Glow glow) {
  constexpr float kRadius = 0.025f;
  constexpr float kDistance = 0.07f;  // of the axis from the wall
  const float half = length / 2;
  for (const float side : {-1.0f, 1.0f}) {
    const float x0 = side < 0 ? -half - 0.03f : half;
    addBox(palette.flat(Paint::kSteel), wall, {x0, -0.04f, 0}, {x0 + 0.03f, 0.04f, kDistance + 0.04f}, kBack);
  }
  Surface& light = palette.emitter(glow.tint, radianceOf(glow.flux, 3 * 1.7320508f * kRadius * length));
  std::array<std::uint32_t, 6> v{};
  for (int k = 0; k < 3; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / 3;
    const float y = kRadius * std::sin(angle), z = kDistance + kRadius * std::cos(angle);
    v[2 * static_cast<std::size_t>(k)] = light.add(wall.point({-half, y, z}));
    v[2 * static_cast<std::size_t>(k) + 1] = light.add(wall.point({half, y, z}));
  }
  for (std::size_t k = 0; k < 6; k += 2) {
    const std::size_t next = (k + 2) % 6;
    light.triangle(v[k], v[k + 1], v[next + 1]);
    light.triangle(v[k], v[next + 1], v[next]);
  }
}

void addFairyString(Palette& palette, const Vec3& from, const Vec3& to, float sag, std::size_t bulbs, float radius,
                    Glow glow, bool coloured) {
  static constexpr std::array kParty{Tint::kAmber, Tint::kRed, Tint::kTeal, Tint::kSoft, Tint::kBlue, Tint::kMagenta};
  const float each = radianceOf(glow.flux / static_cast<float>(bulbs), tetrahedronArea(radius));
  for (std::size_t i = 0; i < bulbs; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(bulbs);
    const Vec3 centre = (1 - t) * from + t * to - Vec3(0, 4 * sag * t * (1 - t), 0);
    addTetrahedron(palette.emitter(coloured ? kParty[i % kParty.size()] : glow.tint, each), centre, radius,
                   static_cast<float>(i) * 1.1f);
  }
}

void addTriangleLamp(Palette& palette, const Pose& wall, float size, Glow glow) {
  const float half = size / 2;
  constexpr float kDistance = 0.03f;
  Surface& light = palette.emitter(glow.tint, radianceOf(glow.flux, half * size));
  addTriangle(light, wall.point({-half, half, kDistance}), wall.point({0, -half, kDistance}),
              wall.point({half, half, kDistance}));
}

void addSpotCan(Palette& palette, const Pose& ceiling, const Vec3& target, Glow glow) {
  constexpr float kInner = 0.35f;
  constexpr float kOuter = 0.60f;
  const Vec3 source = ceiling.point({0, -0.16f, 0});
  addFrustum(palette.flat(Paint::kBlackMetal), ceiling.point({0, -0.14f, 0}), 0.06f, 0.06f, 0.14f, 12, kTop);
  // The falloff's share of the flux is that of a uniform cone half-way between the angles, near enough for a lamp.
  const float solidAngle = 2 * kPi * (1 - std::cos(0.5f * (kInner + kOuter)));
  palette.builder().addSpot(source, target - source, palette.intensity(glow.tint, glow.flux / solidAngle), kInner,
                            kOuter);
}

void addLantern(Palette& palette, const Pose& ceiling, float drop, Glow glow) {
  Surface& metal = palette.flat(Paint::kBlackMetal);
  const Pose centre = ceiling.at({0, -drop, 0});
  constexpr float kHalf = 0.09f;
  addRod(metal, ceiling, -drop + 0.15f, 0, kCord);
  addFrustum(metal, centre.point({0, 0.12f, 0}), 0.15f, 0.02f, 0.07f, 8);
  addBox(metal, centre, {-kHalf, -0.15f, -kHalf}, {kHalf, -0.13f, kHalf});
  for (const float x : {-kHalf, kHalf}) {
    for (const float z : {-kHalf, kHalf}) addRod(metal, centre.at({0.9f * x, 0, 0.9f * z}), -0.13f, 0.12f, 0.006f);
  }
  palette.builder().addPoint(centre.origin, palette.intensity(glow.tint, glow.flux / (4 * kPi)));
}

}  // namespace cellcut
