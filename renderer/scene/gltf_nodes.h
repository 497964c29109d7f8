/// \file gltf_nodes.h
/// The node hierarchy of the active scene, with everything placed in file coordinates.
#pragma once

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/scene_draft.h"

#include <vector>

namespace cellcut {

struct GltfNode {
  std::size_t index;
  glm::dmat4 world;  ///< node → file coordinates, metres; finite
};

/// All nodes below the active scene's roots (`scene`, else the first, else all nodes without a parent), parents before
/// children. Takes time and memory linear in the nodes, however deep.
/// \throws InputError if a transform is broken or not finite
std::vector<GltfNode> activeNodes(const GltfDocument& document);

/// Adds the KHR_lights_punctual lights of the nodes to the draft.
/// \throws InputError for negative or infinite power, by the light's name, and for spot cones without meaning
void readLights(const GltfDocument& document, const std::vector<GltfNode>& nodes, const LoadOptions& options,
                SceneDraft& draft);

/// Adds the nodes' cameras to the draft, named after the node or the camera, each name once.
/// \throws InputError for angles outside (0, π) and sizes that are not positive
void readCameras(const GltfDocument& document, const std::vector<GltfNode>& nodes, SceneDraft& draft);

}  // namespace cellcut
