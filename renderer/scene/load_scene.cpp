#include "renderer/scene/load_scene.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/gltf_loader.h"
#include "renderer/scene/obj_loader.h"
#include "renderer/scene/scene_draft.h"

#include <new>

namespace cellcut {
namespace {

SceneDraft loadDraft(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string extension = lowerExtension(file);
  if (extension == ".gltf" || extension == ".glb") return loadGltf(file, options);
  if (extension == ".obj") return loadObj(file, options.limits);
  throw InputError(file.string(), "is not a scene file; .gltf, .glb and .obj are read");
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options) {
  try {
    return flatten(loadDraft(file, options));
  } catch (const std::bad_alloc&) {
    throw InputError(file.string(), "does not fit into memory; fewer triangles or smaller textures need less");
  }
}

}  // namespace cellcut
