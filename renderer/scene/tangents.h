/// \file tangents.h
/// Tangent frames for normal maps.
#pragma once

#include "renderer/scene/scene.h"

namespace cellcut {

/// Fills mesh.tangents from the texture coordinates that `slot` reads: per vertex, the area-weighted mean over its
/// triangles, made orthogonal to the vertex's normal. Vertices between triangles that see the picture upright and
/// mirrored, and all of a mesh without normals, are split first. Where the mapping is degenerate the frame is arbitrary
/// but valid. The bitangent cross(n, t) · w points to the top of the picture, as glTF 2.0 section 3.9.3 wants (+Y is
/// up, v runs down). \pre mesh.texCoords[slot.texCoord] is not empty
void computeTangents(Mesh& mesh, const TextureSlot& slot);

}  // namespace cellcut
