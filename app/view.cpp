/// The verb `view`: the interactive viewer, on a display or replaying a script without one.
#include "app/command_line.h"
#include "app/option_text.h"
#include "app/verbs.h"
#include "app/viewer_options.h"
#include "renderer/base/error.h"
#include "ui/viewer/frame_loop.h"
#include "ui/viewer/script.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr const char* kViewExplanations = R"(
F1 shows the keys. --size is the window's. Without --spp, --time and --noise rendering goes on until the window closes.

--headless needs no display; with --script it replays input, one action a line, and stops at its end:
  size W H | click LABEL | set LABEL VALUE | drag left|middle|right X0 Y0 X1 Y1 | scroll X Y DY | key NAME | pick X Y
  move X Y | view POSITION BACK UP HALF_HEIGHT FOCUS perspective|orthographic (three numbers for each vector)
  drop FILE | wait spp N | wait idle | screenshot FILE | expect LABEL VALUE | quit
Labels of several words stand in quotes. A label that is not there, or an expectation that fails, ends it with exit
code 2.

Examples:
  cellcut                                    a generated building with 4,000 lamps
  cellcut room.glb --strategy light-tree
  cellcut view --headless --script actions.txt room.glb)";

struct ViewOptions {
  ViewerCommandLine common;
  bool headless = false;
  std::optional<std::filesystem::path> script;
  std::optional<std::filesystem::path> record;
};

OpenedWindow windowFor(const ViewOptions& options) {
  const WindowSettings settings{.size = {options.common.render.settings.width, options.common.render.settings.height}};
  if (options.common.windowKind) return {openWindow(*options.common.windowKind, settings), ""};
  if (options.headless) return {openWindow(WindowKind::kEgl, settings), ""};
  return openAnyWindow(settings);
}

int showViewer(const ViewOptions& options, const Console& console) {
  if (options.headless && !options.script) {
    throw InputError("--headless", "needs --script; for a single picture there is 'cellcut screenshot'");
  }
  std::vector<NamedFile> inputs = inputsOf(options.common);
  inputs.push_back({"--script", options.script.value_or("")});
  requireDistinct({{"--record", options.record.value_or("")}}, inputs);
  std::vector<ScriptAction> actions;
  if (options.script) actions = readScript(*options.script);
  // The window first: without a display nobody waits for a large scene in vain.
  const OpenedWindow opened = windowFor(options);
  if (!opened.notice.empty()) {
    // Nobody would see what goes on in memory, nor could end it.
    if (!options.script) {
      throw std::runtime_error(opened.notice +
                               "; for a picture there is 'cellcut screenshot', for a script --headless");
    }
    console.err << "cellcut: " << opened.notice << '\n';
  }
  const std::shared_ptr<const Scene> scene = loadViewerScene(options.common);
  for (const std::string& warning : scene->warnings) console.warn(warning);
  ViewerOptions viewerOptions = cellcut::viewerOptions(options.common, *scene);
  viewerOptions.record = options.record;
  viewerOptions.recentFiles = recentFilesPath(options.headless);  // a script's scenes are no person's
  Viewer viewer(*opened.window, scene, sceneLoader(options.common), std::move(viewerOptions));
  if (options.script) {
    playScript(actions, std::filesystem::current_path(), viewer, *opened.window);
  } else {
    FrameLoop loop(viewer, *opened.window);
    while (!opened.window->shouldClose()) loop.step();
  }
  viewer.endRecording();
  return kDone;
}

}  // namespace

Verb addView(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("view", "Look at a scene while it renders (also without the word view)");
  const auto options = std::make_shared<ViewOptions>();
  ViewOptions& o = *options;
  addViewerOptions(*verb, o.common, false);
  verb->add_flag("--headless", o.headless, "No display: draw in memory");
  addText(
      *verb, "--script", "FILE", [&o](const std::string& t) { o.script = t; }, "Replay input from FILE; see below");
  const auto record = [&o](const std::string& t) {
    requireWritable(t);
    o.record = t;
  };
  addText(*verb, "--record", "FILE", record, "Write down what is done as such a script");
  verb->footer(explainPictureOptions() + kViewExplanations);
  return {verb, [options](const Console& console) { return showViewer(*options, console); }};
}

}  // namespace cellcut
