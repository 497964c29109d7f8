/// The verb `generate`: recipe → scene file.
#include "app/command_line.h"
#include "app/numbers.h"
#include "app/output.h"
#include "app/verbs.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/recipes/recipe.h"

#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

struct GenerateOptions {
  Recipe recipe = Recipe::kRooms;
  std::size_t lights = 0;
  std::uint64_t seed = 0;
  std::filesystem::path output;
};

Recipe parseRecipe(const std::string& name) {
  if (const auto recipe = recipeFromName(name)) return *recipe;
  std::string known;
  for (const RecipeName& recipe : kRecipes) {
    known += (known.empty() ? "" : ", ") + std::string(recipe.name);
  }
  throw InputError("RECIPE", "'" + name + "' is none of " + known);
}

std::filesystem::path parseOutput(const std::filesystem::path& file) {
  if (file.extension() != ".glb") throw InputError(file.string(), "a generated scene is binary glTF; use .glb");
  requireWritable(file);
  return file;
}

std::string generateHelp() {
  std::string text = "Recipes:\n";
  for (const RecipeName& recipe : kRecipes) {
    text += "  " + std::string(recipe.name) + ": " + std::string(recipe.description) + "\n";
  }
  return text +
         "\nThe same arguments give the same file.\n\nExample:\n  cellcut generate rooms --lights 4000 -o rooms.glb";
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
  const auto add = [verb](const char* name, const char* type, const std::function<void(const std::string&)>& use,
                          const char* description) {
    return verb->add_option_function<std::string>(name, use, description)->type_name(type);
  };
  add(
      "RECIPE", "", [&o](const std::string& t) { o.recipe = parseRecipe(t); }, "What to build; see below")
      ->required();
  const auto lights = [&o](const std::string& t) { o.lights = parseWhole("--lights", t, {.most = kMaxRecipeLights}); };
  add("--lights", "N", lights, "How many lights")->required();
  add(
      "--seed", "S", [&o](const std::string& t) { o.seed = parseWhole("--seed", t, {}); },
      "Another seed, another scene");
  add(
      "-o,--output", "FILE", [&o](const std::string& t) { o.output = parseOutput(t); }, "Scene file, .glb")
      ->required();
  verb->footer(generateHelp());
  return {verb, [options](const Console& console) { return generateScene(*options, console); }};
}

}  // namespace cellcut
