/// \file plan.h
/// What `measure` is asked for, and the list of renderings that follows from it.
#pragma once

#include "app/options.h"
#include "renderer/scene/recipes/recipe.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cellcut {

/// One parameter and the values that it is given, all others as they are.
struct Sweep {
  std::string name;                 ///< one of kSweepNames
  std::vector<std::string> values;  ///< as on the command line, checked
};

/// max-depth sweeps every strategy, the others those with cuts.
inline constexpr std::array<std::string_view, 6> kSweepNames{"quality",         "threshold",  "max-cut",
                                                             "grid-resolution", "in-cluster", "max-depth"};

struct MeasureOptions {
  std::string scene;  ///< a file, or the name of a recipe
  std::filesystem::path folder;
  RenderOptions picture;  ///< loading, camera and settings; the rest of it is not used
  std::vector<Strategy> strategies;
  double seconds = 20;                  ///< at which strategies are compared; a run ends with the pass that reaches it
  std::optional<std::uint64_t> passes;  ///< of every run, whatever it takes; errors are then compared at the end
  int runs = 5;                         ///< ≥ 1, of every configuration
  std::optional<std::filesystem::path> reference;
  std::optional<std::uint64_t> referencePasses;
  std::vector<Sweep> sweeps;
  std::vector<std::size_t> lights;  ///< of a recipe
  bool resume = false;
};

/// A picture that is rendered in several ways: what has one true answer.
struct MeasureCase {
  std::string name;  ///< unique, fit for a file's name
  std::optional<Recipe> recipe;
  std::size_t lights = 0;  ///< of the recipe
  int maxDepth = 8;
};

/// A point of a sweep.
struct SweepPoint {
  std::string name, value;
};

/// A way to render a case.
struct Configuration {
  std::string name;       ///< unique, fit for a file's name
  std::size_t caseIndex;  ///< into MeasurePlan::cases
  Strategy strategy;
  SamplerSettings sampler;         ///< of strategies with cuts
  std::vector<SweepPoint> points;  ///< the sweeps that it belongs to; none: only the base
  bool isBase;                     ///< the parameters are those of the command line
};

struct MeasurePlan {
  std::vector<MeasureCase> cases;
  std::vector<Configuration> configurations;  ///< of the first case, of the second …
};

/// Every case with every strategy; sweeps vary one parameter at a time. A point of a sweep that is what the command line
/// says anyway is not measured twice.
MeasurePlan planOf(const MeasureOptions& options);

/// What a configuration is rendered with; the seed is that of the run.
RenderSettings settingsOf(const MeasureOptions& options, const MeasurePlan& plan, const Configuration& configuration);

}  // namespace cellcut
