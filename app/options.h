/// \file options.h
/// The options of a rendering, as text on the command line and as the structures that the renderer takes.
#pragma once

#include "app/output.h"
#include "app/stop_rule.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/renderer.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <oneapi/tbb/global_control.h>

namespace CLI {
class App;
}

namespace cellcut {

struct EnvironmentOptions {
  std::optional<std::filesystem::path> file;
  double scale = 1;     ///< ≥ 0
  double rotation = 0;  ///< degrees about +Y, counter-clockwise seen from above
};

struct RenderOptions {
  std::filesystem::path scene;
  Output output;
  std::optional<std::filesystem::path> report;
  std::optional<StopRule> stop;  ///< nothing: nobody asked for an end
  RenderSettings settings;       ///< `camera` is filled in when the scene is known: findCamera()
  LoadOptions load;
  EnvironmentOptions environment;
  std::string camera;               ///< name or index; empty: the first
  std::vector<Quality> candidates;  ///< of --quality auto, with the explicit options in each; empty: nothing is tried
};

inline constexpr int kMaxPictureSide = 16384;                 // as kMaxImagePixels: what we write we can read
inline constexpr std::uint64_t kMaxCellMegabytes = 1u << 20;  // a terabyte: more is a typing error
inline constexpr int kMaxDepthLimit = 10000;  // far past where a path in a closed white room still carries light
inline constexpr int kMaxThreads = 1024;      // more is a typing error
inline constexpr std::uint64_t kMaxTriangles = 1u << 30;  // three vertices each are still counted in 32 bits
inline constexpr std::uint64_t kMaxPasses = 1u << 30;     // film sums are proved right to 10⁸

/// Of a recipe where nobody says how many.
inline constexpr std::size_t kDefaultRecipeLights = 4000;

/// Declares the options of a rendering on `verb`; parsing then fills `options`, which must stay where it is until then.
/// Parsing throws InputError for a value that cannot be used.
void addRenderOptions(CLI::App& verb, RenderOptions& options);

/// The same without SCENE, --output, --report and --quality auto: what says how a picture is made and not where it goes.
void addPictureOptions(CLI::App& verb, RenderOptions& options);

/// The same without --strategy and without the options that say when to stop.
void addSettingOptions(CLI::App& verb, RenderOptions& options);

/// What "see below" stands for in the lines of addPictureOptions() and of addSettingOptions(): paragraphs for the end of
/// --help. Those of the settings have the strategies too.
std::string explainPictureOptions();
std::string explainSettingOptions();

/// Declares --max-triangles and --max-texture-bytes.
void addLoadLimits(CLI::App& verb, LoadLimits& limits);

/// The value of an option as the options above read it. \throws InputError that names `option` and lists what is known
Strategy parseStrategy(const std::string& option, const std::string& name);
InCluster parseInCluster(const std::string& option, const std::string& name);
/// \param alsoKnown  a name that the caller knows, for the list
Quality parseQuality(const std::string& option, const std::string& name, std::string_view alsoKnown = "");
float parseThreshold(const std::string& option, const std::string& text);
int parseMaxCut(const std::string& option, const std::string& text);
int parseGridResolution(const std::string& option, const std::string& text);
int parseMaxDepth(const std::string& option, const std::string& text);

/// The options that set these of the qualities' settings, whatever preset stands before them.
std::string pinningOptions(const SamplerSettings& settings);

/// Bytes that this machine has.
double installedMemory();

/// Linux promises memory that it does not have and kills whoever uses it; a film that cannot fit is refused before that.
/// \throws InputError
void requireMemory(const RenderSettings& settings);

/// Index of a camera by its exact name, else by its number from 0. Empty text is the first camera.
/// \throws InputError that lists the cameras
std::size_t findCamera(const Scene& scene, const std::string& nameOrIndex);

/// What a rendering reads.
std::vector<NamedFile> inputsOf(const RenderOptions& options);

/// As long as it lives there may be as many threads as --threads asks for, on fewer cores too. Comes before all work: what
/// loads a scene makes TBB's own limit the number of cores.
tbb::global_control allowThreads(const RenderSettings& settings);

/// Loads the scene and what the options put around it.
/// \throws InputError as loadScene()
Scene loadWithOptions(const RenderOptions& options);

}  // namespace cellcut
