/// \file room_interior.h
/// What is inside of one room of `rooms`: furniture and lamps.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/scene/recipes/palette.h"

#include <array>
#include <optional>

namespace cellcut {

/// A hole in a wall, from the floor up.
struct Doorway {
  float from, to;  ///< along the wall, metres
  float height;
};

/// A wall seen from inside the room: local x along it from its left end, z away from it.
struct RoomWall {
  Pose left;  ///< foot of the left end
  float length;
  bool open = false;  ///< not there at all
  std::optional<Doorway> door;
};

/// An axis-aligned room. Walls in the order −z, +x, +z, −x.
struct RoomSpace {
  Vec3 lower, upper;
  std::array<RoomWall, 4> walls;
  Vec3 centre() const { return 0.5f * (lower + upper); }
};

inline constexpr float kCornerLamp = 0.3f;  ///< distance of a floor lamp from both walls of its corner, metres
/// The two corners at the back of a room, on the floor, which furniture leaves free for lamps.
std::array<Vec3, 2> lampCorners(const RoomSpace& room);

enum class Clutter : std::uint8_t { kFull, kSparse };

/// Furniture, without lights.
/// \param keepClear  floor point (x, z) around which nothing is put: where a camera stands
void furnishRoom(Palette& palette, const RoomSpace& room, Clutter clutter, std::optional<Vec2> keepClear, Rng& rng);

/// Lamps with exactly `lights` lights, log-uniform in strength over four decades, that fill the room with about the
/// given radiance.
/// \param radiance  mean over the room's surfaces, W/(m² sr)
/// \param punctual  may use a point and a spot light
void lightRoom(Palette& palette, const RoomSpace& room, std::size_t lights, float radiance, bool punctual, Rng& rng);

}  // namespace cellcut
