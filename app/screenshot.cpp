/// The verb `screenshot`: one picture of the viewer, without a display, and its numbers as JSON.
#include "app/command_line.h"
#include "app/json_text.h"
#include "app/numbers.h"
#include "app/option_text.h"
#include "app/report.h"
#include "app/verbs.h"
#include "app/viewer_options.h"
#include "renderer/base/error.h"

#include <array>
#include <memory>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr const char* kScreenshotExplanations = R"(
Beside OUT.png an OUT.json says what the overlay shows: minimum, maximum, mean, the share of cells touched, and with
--pick the inspector's table. --size is that of the PNG; with panels the rendering is what is left of it. Of --split
the overlay, its numbers and --pick are those of the first strategy.

Examples:
  cellcut screenshot room.glb -o room.png --overlay cut-size --spp 16
  cellcut screenshot room.glb -o cell.png --pick 400,200 --grid
  cellcut screenshot room.glb -o ab.png --split cell-cut:power --no-ui)";

constexpr std::uint64_t kDefaultPasses = 16;
constexpr double kFrameSeconds = 1.0 / 60;
// The first has the overlay and the inspector's table. ImGui lays out by the sizes of the frame before: a scroll bar comes
// in the second, and in the third the panels have what it left of their width.
constexpr int kOverlayFrames = 3;

struct ScreenshotOptions {
  ViewerCommandLine common;
  std::filesystem::path output;
  bool noUi = false;
  OverlayChoice overlay;
  std::optional<glm::ivec2> pick;
  std::optional<std::pair<Strategy, Strategy>> split;
};

/// "A:B" in two halves.
std::pair<std::string, std::string> halves(const std::string& option, const std::string& text, char separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) throw InputError(option, "'" + text + "' has no '" + std::string(1, separator) + "'");
  return {text.substr(0, at), text.substr(at + 1)};
}

void addOverlayOptions(CLI::App& verb, OverlayChoice& overlay) {
  addText(
      verb, "--overlay", "NAME",
      [&overlay](const std::string& t) { overlay.overlay = requireNamed(kOverlays, "--overlay", t).overlay; },
      joinedNames(kOverlays));
  addText(
      verb, "--overlay-range", "A:B",
      [&overlay](const std::string& t) {
        const auto [a, b] = halves("--overlay-range", t, ':');
        overlay.scale.pinned = ValueRange{parseReal("--overlay-range", a, {}), parseReal("--overlay-range", b, {})};
      },
      "Colours from A to B, not from the least to the largest value");
  addText(
      verb, "--overlay-scale", "linear|log",
      [&overlay](const std::string& t) {
        overlay.scale.kind = requireNamed(std::array{ScaleKind::kLinear, ScaleKind::kLog}, "--overlay-scale", t);
      },
      "Of the colours (default linear)");
  addText(
      verb, "--overlay-opacity", "X",
      [&overlay](const std::string& t) {
        overlay.opacity = static_cast<float>(parseReal("--overlay-opacity", t, {.least = 0, .most = 1}));
      },
      "0 … 1 (default 0.7)");
  addText(
      verb, "--colormap", "NAME",
      [&overlay](const std::string& t) { overlay.scale.colormap = requireNamed(kColormaps, "--colormap", t).colormap; },
      joinedNames(kColormaps) + " (default viridis)");
  verb.add_flag("--grid", overlay.grid, "Wireframe of the cells that were touched");
}

std::filesystem::path numbersFile(std::filesystem::path picture) {
  return picture.replace_extension(".json");
}

/// What the PNG shows in numbers.
nlohmann::ordered_json numbersOf(const Viewer& viewer, const OverlayChoice& choice, const Snapshot& snapshot) {
  nlohmann::ordered_json json;
  json["width"] = snapshot.width;
  json["height"] = snapshot.height;
  json["spp"] = snapshot.passes;
  json["overlay"] = describe(choice.overlay).name;
  const OverlayPicture* overlay = viewer.overlay();
  if (!overlay) return json;
  json["title"] = overlay->title;
  if (overlay->statistics.count > 0) {
    json["minimum"] = overlay->statistics.minimum;
    json["maximum"] = overlay->statistics.maximum;
    json["mean"] = overlay->statistics.mean;
    json["pixels"] = overlay->statistics.count;
  }
  if (overlay->touched) {
    json["cells"] = {{"touched", overlay->touched->inside},
                     {"outside", overlay->touched->outside},
                     {"remote", overlay->touched->remote},
                     {"all", overlay->touched->all},
                     {"touched_percent", 100 * overlay->touched->share()}};
  }
  if (overlay->inspection) json["pick"] = toJson(*overlay->inspection);
  return json;
}

/// Frames until the rendering has its samples.
void renderToEnd(Viewer& viewer, Window& window, std::uint64_t passes) {
  viewer.frame(kFrameSeconds);
  viewer.session().waitPasses(passes);
  viewer.session().waitIdle();
  window.pollEvents();
  viewer.frame(kFrameSeconds);
}

/// What does not fit the rendering is refused before its samples are waited for.
/// \param viewer  has its size by a first frame
void requireFits(const ScreenshotOptions& options, Viewer& viewer) {
  const RenderSettings& settings = viewer.state().settings;
  const std::string size = std::to_string(settings.width) + " x " + std::to_string(settings.height);
  if (viewer.reference().picture && !viewer.referenceFits()) {
    throw InputError("--reference", "has other pixels than the rendering, which has " + size +
                                        "; choose --size, and --no-ui for a picture of that size");
  }
  if (options.pick && (options.pick->x >= settings.width || options.pick->y >= settings.height)) {
    throw InputError("--pick", "the picture has " + size + " pixels");
  }
}

int takeScreenshot(const ScreenshotOptions& options, const Console& console) {
  requireDistinct({{"--output", options.output}, {"--output", numbersFile(options.output)}}, inputsOf(options.common));
  const std::shared_ptr<const Scene> scene = loadViewerScene(options.common);
  for (const std::string& warning : scene->warnings) console.warn(warning);
  const RenderSettings& settings = options.common.render.settings;
  const std::unique_ptr<Window> window =
      openWindow(options.common.windowKind.value_or(WindowKind::kEgl), {.size = {settings.width, settings.height}});
  ViewerOptions viewerOptions = cellcut::viewerOptions(options.common, *scene);
  viewerOptions.sizeSettleFrames.reset();
  ViewerState& state = viewerOptions.state;
  if (!state.passLimit && !state.timeLimit && !state.noiseLimit) state.passLimit = kDefaultPasses;
  state.overlay = options.overlay;
  state.showUi = !options.noUi;
  if (options.split) state.settings.strategy = options.split->second;
  const std::uint64_t passes = state.passLimit.value_or(1);

  Viewer viewer(*window, scene, sceneLoader(options.common), viewerOptions);
  viewer.frame(kFrameSeconds);
  requireFits(options, viewer);
  renderToEnd(viewer, *window, passes);
  if (options.split) {
    viewer.storePicture();
    viewer.state().settings.strategy = options.split->first;
    renderToEnd(viewer, *window, passes);
  }
  if (options.pick) viewer.state().pick = options.pick;
  viewer.refreshOverlay();
  for (int i = 0; i < kOverlayFrames; ++i) viewer.frame(kFrameSeconds);
  writeBytes(options.output, encodePng(viewer.picture()));
  const std::filesystem::path numbers = numbersFile(options.output);
  writeText(numbers, jsonText(numbersOf(viewer, options.overlay, *viewer.session().snapshot()), 2) + "\n");
  console.err << "wrote " << options.output.string() << " and " << numbers.string() << '\n';
  return kDone;
}

}  // namespace

Verb addScreenshot(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("screenshot", "A picture of the viewer with its overlays, without a display");
  const auto options = std::make_shared<ScreenshotOptions>();
  ScreenshotOptions& o = *options;
  addViewerOptions(*verb, o.common, true);
  const auto output = [&o](const std::string& t) {
    const Output checked = checkedOutput(t);
    if (checked.kind != PictureKind::kPng) throw InputError(t, "a screenshot is a .png");
    requireWritable(numbersFile(checked.file));
    o.output = checked.file;
  };
  addText(*verb, "-o,--output", "FILE", output, "Picture, .png; numbers go to the .json beside it")->required();
  verb->add_flag("--no-ui", o.noUi, "The picture and its overlay alone");
  addOverlayOptions(*verb, o.overlay);
  const auto pick = [&o](const std::string& t) {
    const auto [x, y] = halves("--pick", t, ',');
    o.pick = glm::ivec2(static_cast<int>(parseWhole("--pick", x, {.most = kMaxPictureSide})),
                        static_cast<int>(parseWhole("--pick", y, {.most = kMaxPictureSide})));
  };
  addText(*verb, "--pick", "X,Y", pick, "Inspect the cell behind that pixel of the picture");
  const auto split = [&o](const std::string& t) {
    const auto [a, b] = halves("--split", t, ':');
    o.split = std::pair(parseStrategy("--split", a), parseStrategy("--split", b));
  };
  addText(*verb, "--split", "STRATEGY:STRATEGY", split, "Two strategies side by side in one picture");
  verb->footer(explainPictureOptions() + kScreenshotExplanations);
  return {verb, [options](const Console& console) { return takeScreenshot(*options, console); }};
}

}  // namespace cellcut
