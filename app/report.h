/// \file report.h
/// What a rendering reports: the --report file and the metadata inside an EXR.
#pragma once

#include "app/options.h"
#include "renderer/measure/quality_choice.h"

#include <cstddef>
#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace cellcut {

/// Wall-clock seconds.
struct RenderTimes {
  double load = 0;
  double build = 0;   ///< ray-tracing structure, lights, strategy
  double render = 0;  ///< all passes, the interrupted one included
};

/// What is known when a rendering is over.
struct RenderRecord {
  const RenderOptions& options;
  const Scene& scene;
  const Renderer& renderer;
  RenderTimes times;
  bool interrupted = false;
  const QualityChoice* quality = nullptr;  ///< of --quality auto
};

/// The keys are a contract: later work adds some and renames none. Numbers that are not finite become null.
nlohmann::ordered_json renderReport(const RenderRecord& record);

/// How the picture was made, for the EXR's header.
std::map<std::string, std::string> pictureMetadata(const RenderRecord& record, const std::string& commandLine);

/// The light counts as all verbs report them.
nlohmann::ordered_json toJson(const LightCounts& lights);

/// Bytes that the process held at most, as the operating system knows it.
std::size_t peakResidentBytes();

}  // namespace cellcut
