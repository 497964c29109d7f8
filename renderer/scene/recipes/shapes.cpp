#include "renderer/scene/recipes/shapes.h"

#include <array>
#include <cassert>

namespace cellcut {

std::uint32_t Surface::add(const Vec3& position) {
  positions.push_back(position);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Surface::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

Pose Pose::turned(const Vec3& origin, float angle) {
  return {origin, {std::cos(angle), 0, -std::sin(angle)}};
}

Pose Pose::at(const Vec3& local, float angle) const {
  return {point(local), std::cos(angle) * x - std::sin(angle) * z()};
}

void addTriangle(Surface& s, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::uint32_t first = s.add(a);
  s.add(b);
  s.add(c);
  s.triangle(first, first + 1, first + 2);
}

void addQuad(Surface& s, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::uint32_t first = s.add(a);
  s.add(b);
  s.add(c);
  s.add(d);
  s.triangle(first, first + 1, first + 2);
  s.triangle(first, first + 2, first + 3);
}

void addBox(Surface& s, const Pose& pose, const Vec3& lower, const Vec3& upper, unsigned without) {
  struct Side {
    Face face;
    std::array<std::uint8_t, 4> corners;  // bit 0: upper x, bit 1: upper y, bit 2: upper z
  };
  static constexpr std::array<Side, 6> kSides{{{kLeft, {0, 4, 6, 2}},
                                               {kRight, {1, 3, 7, 5}},
                                               {kBottom, {0, 1, 5, 4}},
                                               {kTop, {2, 6, 7, 3}},
                                               {kBack, {0, 2, 3, 1}},
                                               {kFront, {4, 5, 7, 6}}}};
  std::array<std::uint32_t, 8> vertex{};
  for (unsigned c = 0; c < 8; ++c) {
    vertex[c] = s.add(pose.point({c & 1 ? upper.x : lower.x, c & 2 ? upper.y : lower.y, c & 4 ? upper.z : lower.z}));
  }
  for (const Side& side : kSides) {
    if (without & side.face) continue;
    s.triangle(vertex[side.corners[0]], vertex[side.corners[1]], vertex[side.corners[2]]);
    s.triangle(vertex[side.corners[0]], vertex[side.corners[2]], vertex[side.corners[3]]);
  }
}

namespace {

/// Point k of n around the vertical, counter-clockwise seen from above.
Vec3 onCircle(float radius, float height, int k, int n) {
  const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(n);
  return {radius * std::cos(angle), height, -radius * std::sin(angle)};
}

}  // namespace

void addFrustum(Surface& s, const Vec3& base, float bottomRadius, float topRadius, float height, int sides,
                unsigned without) {
  const auto ring = [&](float radius, float y) {
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (int k = 0; k < (radius > 0 ? sides : 1); ++k) s.add(base + onCircle(radius, y, k, sides));
    return first;
  };
  const std::uint32_t bottom = ring(bottomRadius, 0);
  const std::uint32_t top = ring(topRadius, height);
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    if (bottomRadius > 0) s.triangle(bottom + k, bottom + next, topRadius > 0 ? top + next : top);
    if (topRadius > 0) s.triangle(bottomRadius > 0 ? bottom + k : bottom, top + next, top + k);
  }
  for (std::uint32_t k = 1; k + 1 < n; ++k) {
    if (bottomRadius > 0 && !(without & kBottom)) s.triangle(bottom, bottom + k + 1, bottom + k);
    if (topRadius > 0 && !(without & kTop)) s.triangle(top, top + k, top + k + 1);
  }
}

void addTetrahedron(Surface& s, const Vec3& centre, float radius, float angle) {
  // Base corners of a regular tetrahedron with its apex up lie at height −1/3 and distance √8/3 of the radius.
  const Pose pose = Pose::turned(centre, angle);
  const std::uint32_t apex = s.add(centre + Vec3(0, radius, 0));
  for (int k = 0; k < 3; ++k) s.add(pose.point(radius * onCircle(std::sqrt(8.0f) / 3, -1.0f / 3, k, 3)));
  s.triangle(apex, apex + 1, apex + 2);
  s.triangle(apex, apex + 2, apex + 3);
  s.triangle(apex, apex + 3, apex + 1);
  s.triangle(apex + 1, apex + 3, apex + 2);
}

void addOctahedron(Surface& s, const Vec3& centre, float radius) {
  const std::uint32_t top = s.add(centre + Vec3(0, radius, 0));
  const std::uint32_t bottom = s.add(centre - Vec3(0, radius, 0));
  static constexpr std::array<Vec3, 4> kEquator{Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
  for (const Vec3& corner : kEquator) s.add(centre + radius * corner);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t a = bottom + 1 + k;
    const std::uint32_t b = bottom + 1 + (k + 1) % 4;
    s.triangle(top, a, b);
    s.triangle(bottom, b, a);
  }
}

namespace {

/// Unit normal (radial, up) of profile point i: the mean of its two segments, or the one that is not of zero length.
Vec2 profileNormal(std::span<const Vec2> profile, std::size_t i) {
  Vec2 sum{0.0f};
  const auto add = [&](std::size_t from) {
    const Vec2 along = profile[from + 1] - profile[from];
    if (along != Vec2(0.0f)) sum += glm::normalize(Vec2(along.y, -along.x));
  };
  if (i > 0) add(i - 1);
  if (i + 1 < profile.size()) add(i);
  return glm::normalize(sum);
}

}  // namespace

void addLathe(Surface& s, const Vec3& base, std::span<const Vec2> profile, int segments) {
  assert(s.normals.size() == s.positions.size());
  const auto first = static_cast<std::uint32_t>(s.positions.size());
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2 normal = profileNormal(profile, i);
    for (int k = 0; k < segments; ++k) {
      s.add(base + onCircle(profile[i].x, profile[i].y, k, segments));
      s.normals.push_back(onCircle(normal.x, normal.y, k, segments));
    }
  }
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
    if (profile[i] == profile[i + 1]) continue;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = first + i * n + k;
      const std::uint32_t b = first + i * n + (k + 1) % n;
      if (profile[i].x > 0) s.triangle(a, b, b + n);
      if (profile[i + 1].x > 0) s.triangle(a, b + n, a + n);
    }
  }
}

void addSphere(Surface& s, const Vec3& centre, float radius, int rings, int segments) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const float angle = kPi * static_cast<float>(i) / static_cast<float>(rings);
    const bool pole = i == 0 || i == rings;  // sin π is not 0 in floats
    profile.emplace_back(pole ? 0.0f : radius * std::sin(angle), -radius * std::cos(angle));
  }
  addLathe(s, centre, profile, segments);
}

}  // namespace cellcut
