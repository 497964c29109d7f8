#include "renderer/scene/gltf_validation.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/scene_draft.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cellcut {
namespace {

constexpr std::array<std::string_view, 8> kKnownExtensions{
    "KHR_mesh_quantization",  "KHR_texture_transform", "KHR_materials_emissive_strength",
    "KHR_materials_specular", "KHR_materials_ior",     "KHR_materials_unlit",
    "KHR_lights_punctual",    "CELLCUT_environment",
};

bool isKnown(const std::string& extension) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) != kKnownExtensions.end();
}

/// The document whose references are being checked, with the place of the check.
struct Checker {
  const GltfDocument& document;

  [[noreturn]] void refuse(const char* array, std::size_t index, const std::string& problem) const {
    throw InputError(placeOf(document, array, index), problem + "; export the file again");
  }
  template <class T>
  void require(const std::vector<T>& targets, int target, const char* array, std::size_t index,
               const char* what) const {
    if (target < 0 || static_cast<std::size_t>(target) >= targets.size()) {
      refuse(array, index, std::string(what) + ' ' + std::to_string(target) + " does not exist");
    }
  }
  template <class T>
  void requireIfSet(const std::vector<T>& targets, int target, const char* array, std::size_t index,
                    const char* what) const {
    if (target != -1) require(targets, target, array, index, what);
  }
};

void checkVersion(const GltfDocument& document) {
  const tinygltf::Asset& asset = document.model.asset;
  if (!asset.version.starts_with("2.")) {
    throw InputError(document.name, "glTF version \"" + printable(asset.version, 20) + "\"; only version 2 is read");
  }
  if (!asset.minVersion.empty() && asset.minVersion != "2.0") {
    throw InputError(document.name, "needs glTF version " + printable(asset.minVersion, 20) + "; 2.0 is read");
  }
}

void checkBuffers(const Checker& check) {
  const tinygltf::Model& model = check.document.model;
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    check.require(model.buffers, view.buffer, "bufferViews", i, "buffer");
    const std::size_t size = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset) {
      check.refuse("bufferViews", i, "reaches past its buffer");
    }
  }
  for (std::size_t i = 0; i < model.accessors.size(); ++i) viewAccessor(check.document, static_cast<int>(i));
}

void checkMeshes(const Checker& check) {
  const tinygltf::Model& model = check.document.model;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    for (const tinygltf::Primitive& primitive : model.meshes[i].primitives) {
      check.requireIfSet(model.accessors, primitive.indices, "meshes", i, "indices: accessor");
      check.requireIfSet(model.materials, primitive.material, "meshes", i, "material");
      for (const auto& [name, accessor] : primitive.attributes) {
        check.require(model.accessors, accessor, "meshes", i, "attributes: accessor");
      }
    }
  }
}

void checkTextures(const Checker& check) {
  const tinygltf::Model& model = check.document.model;
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    check.requireIfSet(model.bufferViews, model.images[i].bufferView, "images", i, "bufferView");
  }
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    check.requireIfSet(model.images, model.textures[i].source, "textures", i, "source: image");
    check.requireIfSet(model.samplers, model.textures[i].sampler, "textures", i, "sampler");
  }
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& m = model.materials[i];
    for (const int texture :
         {m.pbrMetallicRoughness.baseColorTexture.index, m.pbrMetallicRoughness.metallicRoughnessTexture.index,
          m.normalTexture.index, m.occlusionTexture.index, m.emissiveTexture.index}) {
      check.requireIfSet(model.textures, texture, "materials", i, "texture");
    }
  }
}

/// No node is its own ancestor: from each unvisited node, walk up until something known or a root; a node met twice in
/// one walk closes a circle. Linear, and no recursion: chains may be as long as the file.
void checkForCycles(const Checker& check, const std::vector<int>& parents) {
  std::vector<std::size_t> walkOf(parents.size(), 0);
  for (std::size_t start = 0; start < parents.size(); ++start) {
    const std::size_t walk = start + 1;
    for (int at = static_cast<int>(start); at >= 0 && walkOf[static_cast<std::size_t>(at)] != walk;) {
      const auto node = static_cast<std::size_t>(at);
      if (walkOf[node] != 0) break;
      walkOf[node] = walk;
      at = parents[node];
      if (at >= 0 && walkOf[static_cast<std::size_t>(at)] == walk) check.refuse("nodes", node, "is its own ancestor");
    }
  }
}

void checkNodes(const Checker& check) {
  const tinygltf::Model& model = check.document.model;
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const tinygltf::Node& node = model.nodes[i];
    check.requireIfSet(model.meshes, node.mesh, "nodes", i, "mesh");
    check.requireIfSet(model.cameras, node.camera, "nodes", i, "camera");
    for (const int child : node.children) {
      check.require(model.nodes, child, "nodes", i, "child");
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0) check.refuse("nodes", static_cast<std::size_t>(child), "has more than one parent");
      parent = static_cast<int>(i);
    }
  }
  checkForCycles(check, parents);
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    std::vector<int> roots = model.scenes[i].nodes;
    for (const int root : roots) {
      check.require(model.nodes, root, "scenes", i, "node");
      if (parents[static_cast<std::size_t>(root)] >= 0) check.refuse("scenes", i, "lists a node that has a parent");
    }
    std::sort(roots.begin(), roots.end());
    if (std::adjacent_find(roots.begin(), roots.end()) != roots.end()) check.refuse("scenes", i, "lists a node twice");
  }
  check.requireIfSet(model.scenes, model.defaultScene, "scenes", 0, "default scene");
}

}  // namespace

void checkExtensions(const GltfDocument& document) {
  for (const std::string& extension : document.model.extensionsRequired) {
    if (!isKnown(extension)) {
      throw InputError(document.name, "requires the extension " + printable(extension) +
                                          ", which is not supported; export the file without it");
    }
  }
}

void warnOfIgnoredExtensions(const GltfDocument& document, Scene& scene) {
  for (const std::string& extension : document.model.extensionsUsed) {
    if (!isKnown(extension)) warnOnce(scene, "the extension " + printable(extension) + " is not supported and ignored");
  }
}

void checkDocument(const GltfDocument& document) {
  const Checker check{document};
  checkVersion(document);
  checkBuffers(check);
  checkMeshes(check);
  checkTextures(check);
  checkNodes(check);
}

}  // namespace cellcut
