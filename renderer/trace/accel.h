/// \file accel.h
/// Ray–scene intersection. accel.cpp is the one file that includes Embree.
#pragma once

#include "renderer/base/ray.h"
#include "renderer/scene/scene.h"

#include <memory>
#include <optional>
#include <span>

namespace cellcut {

struct Hit {
  float t;
  MeshId mesh;
  std::uint32_t triangle;
  Vec2 barycentric;  ///< weights of corners 1 and 2
};

/// Most rays of a packet: what AVX2 has lanes for.
inline constexpr std::size_t kRayPacket = 8;

class Accel {
 public:
  /// Builds on the threads of the calling TBB arena. The scene must outlive it: vertices and indices are shared, not
  /// copied.
  explicit Accel(const Scene& scene);
  ~Accel();
  Accel(Accel&&) noexcept;

  /// Nearest hit with 0 < t < tMax. Thread-safe.
  /// \param seed  decides where partly covered surfaces (alpha) let the ray through: each with its own probability
  std::optional<Hit> intersect(const Ray& ray, std::uint32_t seed) const;
  /// The same for rays that start and point about alike, as those of neighbouring pixels do: together they take a
  /// quarter of the time. Where surfaces coincide a packet may meet another of them than a ray alone does.
  /// \param hits  out; as many as rays and seeds, at most kRayPacket
  void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> seeds,
                 std::span<std::optional<Hit>> hits) const;
  /// Whether anything lies at 0 < t < tMax.
  bool occluded(const Ray& ray, std::uint32_t seed) const;

  /// Memory that Embree holds.
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cellcut
