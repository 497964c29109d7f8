/// \file recipe_scene.h
#pragma once

#include "renderer/scene/recipes/recipe.h"
#include "renderer/scene/scene.h"

namespace cellcut::test {

/// A recipe's scene, by way of a file like any other.
Scene recipeScene(Recipe recipe, std::size_t lights, std::uint64_t seed = 0);

}  // namespace cellcut::test
