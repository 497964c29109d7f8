#include "tests/support/recipe_scene.h"

#include "renderer/base/image_io.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/temporary_directory.h"

namespace cellcut::test {

Scene recipeScene(Recipe recipe, std::size_t lights, std::uint64_t seed) {
  const TemporaryDirectory folder;
  const std::filesystem::path file = folder / "scene.glb";
  writeFileAtomically(file, generateRecipe(recipe, lights, seed));
  return loadScene(file);
}

}  // namespace cellcut::test
