/// \file results.h
/// What `measure` has measured: kept in results.json run by run, so that it can go on where it was stopped.
#pragma once

#include "app/measure/plan.h"
#include "app/measure/reference.h"
#include "app/measure/run.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cellcut {

/// A run without its picture.
struct RunRecord {
  std::size_t configuration = 0;  ///< into MeasurePlan::configurations
  int run = 0;                    ///< 0, 1, … of the configuration
  std::uint64_t seed = 0;
  double buildSeconds = 0;
  std::uint64_t badSamples = 0;
  std::vector<Checkpoint> checkpoints;  ///< at least one, ascending
};

/// What is known of a case beside the plan.
struct CaseRecord {
  std::uint64_t sceneHash = 0;
  LightCounts lights;
  std::optional<MeasureReference> reference;  ///< `picture` is not kept in the file of results
};

struct MeasureResults {
  MeasurePlan plan;
  /// What all runs share: settingsJson().
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  std::vector<std::string> commands;  ///< that made it, in their order
  std::vector<CaseRecord> cases;      ///< as in the plan
  std::vector<RunRecord> runs;        ///< in the order in which they were done
};

/// Size, limit, sampler, seed, camera, environment …: what must be the same for runs to belong together.
nlohmann::ordered_json settingsJson(const MeasureOptions& options);

/// Everything, the summary included. Numbers that are not finite become null.
nlohmann::ordered_json resultsJson(const MeasureResults& results, const MeasureOptions& options);

/// Takes over the runs and the references of an earlier file.
/// \throws InputError if it is none of ours, is damaged, has other settings, or holds runs that the plan does not
void takeOver(MeasureResults& results, const std::filesystem::path& path);

}  // namespace cellcut
