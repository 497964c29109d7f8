#include "renderer/scene/recipes/recipe.h"

#include "renderer/scene/recipes/builders.h"

#include <cassert>
#include <string>

namespace cellcut {

std::vector<std::byte> generateRecipe(Recipe recipe, std::size_t lights, std::uint64_t seed) {
  assert(lights <= kMaxRecipeLights);
  GlbBuilder builder(std::string(kRecipes[static_cast<std::size_t>(recipe)].name), lights, seed);
  switch (recipe) {
    case Recipe::kRooms:
      buildRooms(builder, lights, seed);
      break;
    case Recipe::kStreet:
      buildStreet(builder, lights, seed);
      break;
    case Recipe::kHall:
      buildHall(builder, lights, seed);
      break;
    case Recipe::kKinds:
      buildKinds(builder, lights, seed);
      break;
  }
  assert(builder.lightCount() == lights);
  return builder.finish();
}

}  // namespace cellcut
