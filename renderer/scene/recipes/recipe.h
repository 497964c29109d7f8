/// \file recipe.h
/// Procedural scenes with any number of lights, written as ordinary binary glTF.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cellcut {

enum class Recipe : std::uint8_t { kRooms, kStreet, kHall, kKinds };

struct RecipeName {
  Recipe recipe;
  std::string_view name;
  std::string_view description;  ///< one line
};

inline constexpr std::array kRecipes{
    RecipeName{Recipe::kRooms, "rooms", "a building of rooms with doors and clutter, lamps of many strengths"},
    RecipeName{Recipe::kStreet, "street", "a street at night: lit windows, lamps as points and spots, a moon"},
    RecipeName{Recipe::kHall, "hall", "one big hall, chandeliers of tiny emitters, long shadows"},
    RecipeName{Recipe::kKinds, "kinds", "all five kinds of light at once, small"},
};

constexpr std::optional<Recipe> recipeFromName(std::string_view name) {
  for (const RecipeName& r : kRecipes) {
    if (r.name == name) return r.recipe;
  }
  return std::nullopt;
}

inline constexpr std::size_t kMaxRecipeLights = 10'000'000;

/// The bytes of a .glb with exactly `lights` lights (an environment, which `kinds` has inside of its file, is not
/// counted). The same arguments give the same bytes. \pre lights ≤ kMaxRecipeLights
std::vector<std::byte> generateRecipe(Recipe recipe, std::size_t lights, std::uint64_t seed);

}  // namespace cellcut
