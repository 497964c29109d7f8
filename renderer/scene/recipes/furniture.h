/// \file furniture.h
/// Clutter that stands on floors and hangs on walls.
///
/// Space: metres. A pose stands on the floor at the middle of the piece's back (pieces that belong to a wall: local z
/// points away from it) or of its footprint (all others). Every piece stays inside the footprint that is stated with
/// it.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/scene/recipes/palette.h"

namespace cellcut {

// At a wall; footprints as (width, depth).
inline constexpr Vec2 kSofaFootprint{1.9f, 0.9f};
void addSofa(Palette& palette, const Pose& wall, Paint cloth);
inline constexpr Vec2 kBedFootprint{1.5f, 2.1f};
void addBed(Palette& palette, const Pose& wall, Paint cloth);
inline constexpr Vec2 kShelfFootprint{1.0f, 0.32f};
/// \param books per board, at most; 0 for an empty shelf
void addShelf(Palette& palette, const Pose& wall, std::uint32_t books, Rng& rng);
inline constexpr Vec2 kDeskFootprint{1.4f, 1.35f};
void addDesk(Palette& palette, const Pose& wall, Rng& rng);

// Free; footprints as (width, depth) around the pose.
inline constexpr Vec2 kDiningFootprint{1.9f, 1.9f};
/// Table with four chairs and a bowl.
void addDiningTable(Palette& palette, const Pose& centre, Rng& rng);
inline constexpr Vec2 kCoffeeFootprint{1.1f, 0.7f};
void addCoffeeTable(Palette& palette, const Pose& centre, Rng& rng);
inline constexpr Vec2 kPlantFootprint{0.7f, 0.7f};
void addPlant(Palette& palette, const Pose& centre, float height, Rng& rng);
inline constexpr Vec2 kPedestalFootprint{0.5f, 0.5f};
/// Something shiny and round on a block.
void addPedestal(Palette& palette, const Pose& centre, Rng& rng);
inline constexpr Vec2 kCratesFootprint{1.0f, 1.0f};
void addCrates(Palette& palette, const Pose& centre, Rng& rng);
void addChair(Palette& palette, const Pose& centre, Paint wood);

/// Framed picture; the pose is its middle, on the wall.
void addPicture(Palette& palette, const Pose& wall, Vec2 size, Rng& rng);

/// Turned vase, `height` tall, standing at a point.
void addVase(Palette& palette, const Vec3& base, float height, Paint glaze);

}  // namespace cellcut
