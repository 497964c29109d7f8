/// \file scene_draft.h
/// What a loader makes of a file before the scene is flattened: instanced parts and places in double precision.
///
/// Everything in a draft's `scene` that has no place is final. What has one is placed here in the file's coordinates,
/// in double, because only the whole draft tells where the scene's centre is.
#pragma once

#include "renderer/scene/load_options.h"
#include "renderer/scene/scene.h"

#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

namespace cellcut {

/// Triangles of one material in coordinates of their own. Attributes as in Mesh: empty, or one value per position.
struct Part {
  MaterialId material{};
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;   ///< of any length; zero or not finite: the facet's is used
  std::vector<Vec4> tangents;  ///< only beside normals
  std::array<std::vector<Vec2>, 2> texCoords;
  std::vector<Vec4> colors;
  std::vector<Triangle> triangles;  ///< indices < positions.size(), of which they use all
};

struct PartInstance {
  std::size_t part;
  glm::dmat4 world;  ///< part → file coordinates, metres; finite
};

struct SceneDraft {
  std::string name;  ///< of the file, for messages
  LoadLimits limits;
  Scene scene;
  std::vector<Part> parts;
  std::vector<PartInstance> instances;
  std::vector<glm::dvec3> pointPositions;   ///< of scene.pointLights, file coordinates, metres
  std::vector<glm::dvec3> spotPositions;    ///< of scene.spotLights
  std::vector<glm::dvec3> cameraPositions;  ///< of scene.cameras
};

/// Remembers a warning unless it is already there. Hostile files must not fill memory with warnings: beyond 100 they
/// are dropped.
void warnOnce(Scene& scene, const std::string& warning);

/// True if any of the material's textures uses the given set of texture coordinates.
bool usesTexCoords(const Material& material, std::uint8_t set);

/// Writes out the instances around the centre of all triangles (Scene::origin), drops degenerate triangles and fills in
/// what materials need and files leave out: texture coordinates, tangents, a camera. Parallel; the same result for any
/// number of threads.
/// \throws InputError if a place leaves the range of a float
Scene flatten(SceneDraft draft);

}  // namespace cellcut
