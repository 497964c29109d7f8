/// \file report.h
/// The page that shows a measurement: one file that needs nothing else.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace cellcut {

/// assets/report/report.html with the results and the pictures of FOLDER/images inside of it: every base configuration
/// beside its reference, its HDR-ꟻLIP error map, and three crops where the configurations differ most.
/// \param results  resultsJson()
/// \throws InputError if a picture that a run has written is no longer there
std::string reportPage(const nlohmann::ordered_json& results, const std::filesystem::path& folder);

/// assets/report/report.html; CMake puts it into the program.
std::string_view reportTemplate();

}  // namespace cellcut
