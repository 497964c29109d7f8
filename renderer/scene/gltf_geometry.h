/// \file gltf_geometry.h
/// glTF mesh primitives → Part.
#pragma once

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene_draft.h"

namespace cellcut {

/// Triangles of a primitive without its instances, before degenerate ones are dropped; 0 for points and lines.
std::size_t triangleCount(const GltfDocument& document, const tinygltf::Primitive& primitive);

/// Reads a primitive's triangles with the attributes that its material needs. Vertices that no triangle uses are left
/// out.
/// \param mesh     index of the mesh that holds it, for messages
/// \param material of the scene, already resolved
/// \throws InputError if an index is past the vertices, attributes differ in number, or an attribute has a type that it
/// cannot have
Part readPrimitive(const GltfDocument& document, std::size_t mesh, const tinygltf::Primitive& primitive, MaterialId id,
                   const Material& material);

}  // namespace cellcut
