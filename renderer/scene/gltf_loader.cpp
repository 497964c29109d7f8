#include "renderer/scene/gltf_loader.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/gltf_geometry.h"
#include "renderer/scene/gltf_materials.h"
#include "renderer/scene/gltf_nodes.h"
#include "renderer/scene/gltf_validation.h"
#include "renderer/scene/gltf_values.h"

#include <algorithm>
#include <optional>

#include <tbb/parallel_for.h>

namespace cellcut {
namespace {

/// A primitive of a mesh that the active scene shows.
struct UsedPrimitive {
  std::size_t mesh;
  const tinygltf::Primitive* primitive;
};

/// Most primitives that are shown, one in several places counted as often: each takes 200 bytes while the scene is
/// loaded.
constexpr std::size_t kMaxPlacedPrimitives = std::size_t{1} << 24;

/// What a mesh adds to the scene wherever it is placed.
struct MeshSize {
  std::size_t primitives = 0;  ///< that have triangles
  std::size_t triangles = 0;
};

/// A small file can ask for any number of triangles by instances of instances: count before anything is read.
void checkInstances(const GltfDocument& document, const std::vector<GltfNode>& nodes, std::size_t mostTriangles) {
  std::vector<MeshSize> sizes(document.model.meshes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (const tinygltf::Primitive& primitive : document.model.meshes[i].primitives) {
      const std::size_t triangles = triangleCount(document, primitive);
      sizes[i].primitives += triangles > 0;
      sizes[i].triangles += triangles;
    }
  }
  MeshSize all;
  for (const GltfNode& node : nodes) {
    const int mesh = document.model.nodes[node.index].mesh;
    if (mesh < 0) continue;
    all.primitives += sizes[static_cast<std::size_t>(mesh)].primitives;
    all.triangles += sizes[static_cast<std::size_t>(mesh)].triangles;
    if (all.triangles > mostTriangles) {
      throw InputError(document.name, "more than " + std::to_string(mostTriangles) +
                                          " triangles with all instances written out, the limit (--max-triangles)");
    }
    if (all.primitives > kMaxPlacedPrimitives) {
      throw InputError(document.name,
                       "more than " + std::to_string(kMaxPlacedPrimitives) +
                           " primitives with all instances written out; join primitives of one material");
    }
  }
}

/// Lists the primitives of the meshes in use and, in draft.instances, where those with triangles are.
std::vector<UsedPrimitive> listPrimitives(const GltfDocument& document, const std::vector<GltfNode>& nodes,
                                          SceneDraft& draft) {
  std::vector<std::optional<std::vector<std::size_t>>> partsOf(document.model.meshes.size());  // of those in use
  std::vector<UsedPrimitive> used;
  for (const GltfNode& node : nodes) {
    const int mesh = document.model.nodes[node.index].mesh;
    if (mesh < 0) continue;
    ++draft.scene.counts.instances;
    const auto index = static_cast<std::size_t>(mesh);
    if (!partsOf[index]) {
      partsOf[index].emplace();
      for (const tinygltf::Primitive& primitive : document.model.meshes[index].primitives) {
        if (triangleCount(document, primitive) > 0) partsOf[index]->push_back(used.size());
        used.push_back({index, &primitive});
      }
    }
    for (const std::size_t part : *partsOf[index]) draft.instances.push_back({part, node.world});
  }
  return used;
}

void readParts(const GltfDocument& document, const std::vector<UsedPrimitive>& used, SceneDraft& draft) {
  draft.parts.resize(used.size());
  tbb::parallel_for(std::size_t{0}, used.size(), [&](std::size_t i) {
    const int own = used[i].primitive->material;
    const std::size_t material = own < 0 ? document.model.materials.size() : static_cast<std::size_t>(own);
    draft.parts[i] = readPrimitive(document, used[i].mesh, *used[i].primitive,
                                   MaterialId{static_cast<std::uint32_t>(material)}, draft.scene.materials[material]);
  });
}

void readEnvironment(const GltfDocument& document, std::uint64_t maxBytes, Scene& scene) {
  const tinygltf::Value* environment = extension(document.model.extensions, "CELLCUT_environment");
  if (!environment) return;
  const std::string place = document.name + ": CELLCUT_environment";
  const std::optional<int> bufferView = indexMember(*environment, "bufferView", place);
  if (!bufferView || static_cast<std::size_t>(*bufferView) >= document.model.bufferViews.size()) {
    throw InputError(place, "its bufferView does not exist; export the file again");
  }
  setEnvironment(scene, decodeImage(bufferViewBytes(document.model, *bufferView), place, maxBytes), 1, 0, place);
}

bool hasPunctualLights(const Scene& scene) {
  return !(scene.pointLights.empty() && scene.spotLights.empty() && scene.directionalLights.empty());
}

void addWarnings(const GltfDocument& document, const std::vector<UsedPrimitive>& used, const LoadOptions& options,
                 Scene& scene) {
  if (!document.complaint.empty()) warnOnce(scene, "not all of the file could be read: " + document.complaint);
  warnOfIgnoredExtensions(document, scene);
  const bool anyTargets =
      std::any_of(used.begin(), used.end(), [](const auto& u) { return !u.primitive->targets.empty(); });
  if (!document.model.skins.empty() || !document.model.animations.empty() || anyTargets) {
    warnOnce(scene,
             "skins, animations and morph targets are ignored: meshes are shown as they are, where their nodes are");
  }
  for (const UsedPrimitive& use : used) {
    if (use.primitive->mode < TINYGLTF_MODE_TRIANGLES || use.primitive->mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      warnOnce(scene, "points and lines are not shown");
    } else if (!use.primitive->attributes.contains("POSITION")) {
      warnOnce(scene, "primitives without positions are not shown");
    }
  }
  if (hasPunctualLights(scene) && options.punctualScale == 1 && scene.generator.find("Blender") != std::string::npos) {
    warnOnce(scene,
             "Blender writes its point, spot and sun lights with 683 lm/W and its emissive surfaces without; "
             "--punctual-scale blender makes them fit");
  }
}

}  // namespace

SceneDraft loadGltf(const std::filesystem::path& file, const LoadOptions& options) {
  const GltfDocument document = readGltf(file);
  SceneDraft draft;
  draft.name = document.name;
  draft.limits = options.limits;
  draft.scene.generator = document.model.asset.generator;
  draft.scene.counts.meshes = document.model.meshes.size();

  const std::vector<GltfNode> nodes = activeNodes(document);
  checkInstances(document, nodes, options.limits.maxTriangles);
  readMaterials(document, options.limits.maxTextureBytes, draft.scene);
  const std::vector<UsedPrimitive> used = listPrimitives(document, nodes, draft);
  readParts(document, used, draft);
  readLights(document, nodes, options, draft);
  readCameras(document, nodes, draft);
  readEnvironment(document, options.limits.maxTextureBytes, draft.scene);
  addWarnings(document, used, options, draft.scene);
  return draft;
}

}  // namespace cellcut
