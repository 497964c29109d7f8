#include "app/viewer_options.h"

#include "app/numbers.h"
#include "renderer/base/error.h"
#include "renderer/scene/recipes/recipe.h"

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

constexpr std::size_t kDefaultLights = 4000;

WindowKind parseWindowKind(const std::string& name) {
  for (const WindowKind kind : {WindowKind::kEgl, WindowKind::kOsmesa}) {
    if (windowKindName(kind) == name) return kind;
  }
  throw InputError("--gl", "'" + name + "' is none of egl, osmesa");
}

/// A recipe goes through a file, as every scene does.
std::shared_ptr<const Scene> defaultScene(const RenderOptions& render) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("cellcut-rooms-" + std::to_string(getpid()) + ".glb");
  writeFileAtomically(file, generateRecipe(Recipe::kRooms, kDefaultLights, 0));
  RenderOptions options = render;
  options.scene = file;
  struct Remove {
    const std::filesystem::path& file;
    ~Remove() {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }
  } const remove{file};
  return std::make_shared<const Scene>(loadWithOptions(options));
}

}  // namespace

void addViewerOptions(CLI::App& verb, ViewerCommandLine& o, bool sceneRequired) {
  const auto scene = [&o](const std::string& text) {
    o.render.scene = text;
    o.sceneGiven = true;
  };
  verb.add_option_function<std::string>("SCENE", scene, "Scene: .gltf, .glb or .obj")
      ->type_name("")
      ->required(sceneRequired);
  o.render.stop.passes = 0;  // 0: nobody asked for an end
  addPictureOptions(verb, o.render);
  const auto add = [&verb](const char* name, const char* type, const std::function<void(const std::string&)>& use,
                           const char* description) {
    verb.add_option_function<std::string>(name, use, description)->type_name(type);
  };
  add(
      "--ui-scale", "X",
      [&o](const std::string& t) {
        o.uiScale = static_cast<float>(parseReal("--ui-scale", t, {.least = 0.5, .most = 4}));
      },
      "Size of text and panels (default 1)");
  add(
      "--reference", "FILE", [&o](const std::string& t) { o.reference = t; },
      "Converged picture (.exr, .pfm, .hdr) for the overlay 'error'");
  add(
      "--gl", "egl|osmesa", [&o](const std::string& t) { o.windowKind = parseWindowKind(t); },
      "Draw without a display, by EGL or OSMesa");
}

std::shared_ptr<const Scene> loadViewerScene(const ViewerCommandLine& options) {
  if (!options.sceneGiven) return defaultScene(options.render);
  return std::make_shared<const Scene>(loadWithOptions(options.render));
}

ViewerOptions viewerOptions(const ViewerCommandLine& options, const Scene& scene) {
  ViewerOptions viewer;
  viewer.uiScale = options.uiScale;
  viewer.file = options.render.scene;
  viewer.state.settings = options.render.settings;
  viewer.state.settings.camera = findCamera(scene, options.render.camera);
  const StopRule& stop = options.render.stop;
  if (stop.kind == StopRule::Kind::kPasses && stop.passes > 0) viewer.state.passLimit = stop.passes;
  if (stop.kind == StopRule::Kind::kSeconds) viewer.state.timeLimit = stop.seconds;
  if (stop.kind == StopRule::Kind::kNoise) viewer.state.noiseLimit = stop.noise;
  if (options.reference) viewer.reference = std::make_shared<const ImageRgb>(readImage(*options.reference));
  return viewer;
}

SceneLoader sceneLoader(const ViewerCommandLine& options) {
  return [render = options.render](const std::filesystem::path& file) {
    RenderOptions wanted = render;
    wanted.scene = file;
    return std::make_shared<const Scene>(loadWithOptions(wanted));
  };
}

}  // namespace cellcut
