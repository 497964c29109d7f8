/// \file builders.h
/// The recipes behind generateRecipe. Each fills a builder with exactly `lights` lights and its cameras.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/scene/recipes/glb_builder.h"

namespace cellcut {

/// A building with an open front: a grid of rooms of different sizes, behind each other through doors.
void buildRooms(GlbBuilder& builder, std::size_t lights, std::uint64_t seed);
/// A night street between two rows of houses.
void buildStreet(GlbBuilder& builder, std::size_t lights, std::uint64_t seed);
/// A columned hall under chandeliers.
void buildHall(GlbBuilder& builder, std::size_t lights, std::uint64_t seed);
/// A terrace at dusk with every kind of light.
void buildKinds(GlbBuilder& builder, std::size_t lights, std::uint64_t seed);

}  // namespace cellcut
