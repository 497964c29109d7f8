/// The verb `generate`: recipe → scene file.
#include "app/command_line.h"
#include "app/numbers.h"
#include "app/option_text.h"
#include "app/output.h"
#include "app/verbs.h"
#include "renderer/base/error.h"
#include "renderer/scene/recipes/recipe.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr const char* kGenerateExplanations = R"(
The same arguments give the same file.

Example:
  cellcut generate rooms --lights 4000 -o rooms.glb)";

struct GenerateOptions {
  Recipe recipe = Recipe::kRooms;
  std::size_t lights = 0;
  std::uint64_t seed = 0;
  std::filesystem::path output;
};

std::filesystem::path parseOutput(const std::filesystem::path& file) {
  if (file.extension() != ".glb") throw InputError(file.string(), "a generated scene is binary glTF; use .glb");
  requireWritable(file);
  return file;
}

int generateScene(const GenerateOptions& options, const Console& console) {
  const std::vector<std::byte> bytes = generateRecipe(options.recipe, options.lights, options.seed);
  writeBytes(options.output, bytes);
  console.err << "wrote " << options.output.string() << '\n';
  return kDone;
}

}  // namespace

Verb addGenerate(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("generate", "Write a procedural scene with any number of lights");
  const auto options = std::make_shared<GenerateOptions>();
  GenerateOptions& o = *options;
  const auto recipe = [&o](const std::string& t) { o.recipe = requireNamed(kRecipes, "RECIPE", t).recipe; };
  addText(*verb, "RECIPE", "", recipe, "What to build; see below")->required();
  const auto lights = [&o](const std::string& t) { o.lights = parseWhole("--lights", t, {.most = kMaxRecipeLights}); };
  addText(*verb, "--lights", "N", lights, "How many lights")->required();
  addText(
      *verb, "--seed", "S", [&o](const std::string& t) { o.seed = parseWhole("--seed", t, {}); },
      "Another seed, another scene");
  addText(
      *verb, "-o,--output", "FILE", [&o](const std::string& t) { o.output = parseOutput(t); }, "Scene file, .glb")
      ->required();
  verb->footer("Recipes:\n" + explained(kRecipes) + kGenerateExplanations);
  return {verb, [options](const Console& console) { return generateScene(*options, console); }};
}

}  // namespace cellcut
