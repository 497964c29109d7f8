#include "renderer/base/error.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene_draft.h"
#include "renderer/scene/tangents.h"

#include <map>

#include <glm/mat3x3.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace cellcut {
namespace {

/// Vertices per task: large enough to hide the cost of a task, small enough to share one big mesh among threads.
constexpr std::size_t kVerticesPerTask = 8192;

DoubleBounds merged(DoubleBounds a, const DoubleBounds& b) {
  a.add(b);
  return a;
}

DoubleBounds instanceBounds(const Part& part, const glm::dmat4& world) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, part.positions.size(), kVerticesPerTask), DoubleBounds{},
      [&](const auto& range, DoubleBounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (isFinite(part.positions[i])) bounds.add(glm::dvec3(world * glm::dvec4(glm::dvec3(part.positions[i]), 1)));
        }
        return bounds;
      },
      merged);
}

/// Bounds of the triangles in the file's coordinates; of the lights only where there are none, for around the middle of
/// a room and a star that lights it, floats would hold neither.
DoubleBounds draftBounds(const SceneDraft& draft) {
  DoubleBounds bounds = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, draft.instances.size()), DoubleBounds{},
      [&](const auto& range, DoubleBounds sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const PartInstance& instance = draft.instances[i];
          sum.add(instanceBounds(draft.parts[instance.part], instance.world));
        }
        return sum;
      },
      merged);
  if (!bounds.empty()) return bounds;
  for (const glm::dvec3& p : draft.pointPositions) bounds.add(p);
  for (const glm::dvec3& p : draft.spotPositions) bounds.add(p);
  return bounds;
}

enum Attribute : std::uint8_t { kNormals = 1, kTangents = 2, kTexCoords0 = 4, kTexCoords1 = 8, kColors = 16 };

std::uint8_t attributesOf(const Part& part) {
  return static_cast<std::uint8_t>((part.normals.empty() ? 0 : kNormals) | (part.tangents.empty() ? 0 : kTangents) |
                                   (part.texCoords[0].empty() ? 0 : kTexCoords0) |
                                   (part.texCoords[1].empty() ? 0 : kTexCoords1) | (part.colors.empty() ? 0 : kColors));
}

/// One instance of a part, and the stretch of a mesh that it fills.
struct Placement {
  const PartInstance* instance;
  std::size_t mesh, firstVertex, firstTriangle;
};

struct MeshSize {
  MaterialId material;
  std::uint8_t attributes;
  std::size_t vertices = 0, triangles = 0;
};

void allocate(const MeshSize& size, Mesh& mesh) {
  mesh.material = size.material;
  mesh.positions.resize(size.vertices);
  if (size.attributes & kNormals) mesh.normals.resize(size.vertices);
  if (size.attributes & kTangents) mesh.tangents.resize(size.vertices);
  if (size.attributes & kTexCoords0) mesh.texCoords[0].resize(size.vertices);
  if (size.attributes & kTexCoords1) mesh.texCoords[1].resize(size.vertices);
  if (size.attributes & kColors) mesh.colors.resize(size.vertices);
  mesh.triangles.resize(size.triangles);
}

/// Gives every instance its place in the mesh of its material and attributes, in the order of the file.
std::vector<Placement> layOut(const SceneDraft& draft, std::vector<Mesh>& meshes) {
  std::map<std::pair<MaterialId, std::uint8_t>, std::size_t> meshOf;
  std::vector<MeshSize> sizes;
  std::vector<Placement> placements;
  placements.reserve(draft.instances.size());
  for (const PartInstance& instance : draft.instances) {
    const Part& part = draft.parts[instance.part];
    if (part.triangles.empty()) continue;
    const auto [entry, isNew] = meshOf.try_emplace({part.material, attributesOf(part)}, sizes.size());
    if (isNew) sizes.push_back({part.material, attributesOf(part)});
    MeshSize& size = sizes[entry->second];
    placements.push_back({&instance, entry->second, size.vertices, size.triangles});
    size.vertices += part.positions.size();
    size.triangles += part.triangles.size();
  }
  meshes.resize(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) allocate(sizes[i], meshes[i]);
  return placements;
}

/// How directions of a part turn into the scene's.
struct DirectionTransform {
  glm::dmat3 tangents;
  glm::dmat3 normals;  ///< a positive multiple of the inverse transpose, defined for flattening transforms, too
  bool mirrored;

  explicit DirectionTransform(const glm::dmat4& world) : tangents(world) {
    const glm::dvec3 x = tangents[0], y = tangents[1], z = tangents[2];
    mirrored = glm::dot(x, glm::cross(y, z)) < 0;
    normals = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * (mirrored ? -1.0 : 1.0);
  }
};

/// Unit length, or zero where there is no direction.
Vec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(0);
}

void writeVertices(const Part& part, const Placement& place, const glm::dvec3& centre, Mesh& mesh) {
  glm::dmat4 world = place.instance->world;
  world[3] -= glm::dvec4(centre, 0);
  const DirectionTransform turn(world);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.positions.size(), kVerticesPerTask),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const std::size_t to = place.firstVertex + i;
                        mesh.positions[to] = Vec3(world * glm::dvec4(glm::dvec3(part.positions[i]), 1));
                        if (!part.normals.empty())
                          mesh.normals[to] = unitOrZero(turn.normals * glm::dvec3(part.normals[i]));
                        if (!part.tangents.empty()) {
                          // A reflection turns cross(n, t) around; the handedness takes it back.
                          const float w = (part.tangents[i].w < 0) != turn.mirrored ? -1.0f : 1.0f;
                          mesh.tangents[to] = {unitOrZero(turn.tangents * glm::dvec3(part.tangents[i])), w};
                        }
                        for (std::size_t set = 0; set < 2; ++set) {
                          if (!part.texCoords[set].empty()) mesh.texCoords[set][to] = part.texCoords[set][i];
                        }
                        if (!part.colors.empty()) mesh.colors[to] = part.colors[i];
                      }
                    });
  const auto first = static_cast<std::uint32_t>(place.firstVertex);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.triangles.size(), kVerticesPerTask),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        Triangle triangle = part.triangles[i] + first;
                        if (turn.mirrored) std::swap(triangle.y, triangle.z);  // so that the front stays the front
                        mesh.triangles[place.firstTriangle + i] = triangle;
                      }
                    });
}

bool isDegenerate(const Mesh& mesh, const Triangle& triangle) {
  const double doubleArea = glm::length(facetNormal(mesh, triangle));
  return !(doubleArea > 0 && std::isfinite(doubleArea));
}

/// Gives vertices whose normal is of no use that of a facet at which they are.
void repairNormals(Mesh& mesh) {
  if (mesh.normals.empty()) return;
  for (const Triangle& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      Vec3& normal = mesh.normals[triangle[i]];
      if (isBlack(normal)) normal = Vec3(glm::normalize(facetNormal(mesh, triangle)));
    }
  }
}

void repairTangents(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    const bool isMissing = isBlack(Vec3(mesh.tangents[i]));
    if (isMissing && !isBlack(mesh.normals[i])) mesh.tangents[i] = {Frame(mesh.normals[i]).x, mesh.tangents[i].w};
  }
}

/// Returns how many triangles were dropped.
std::size_t finishMesh(const std::vector<Material>& materials, Mesh& mesh) {
  const std::size_t dropped = std::erase_if(mesh.triangles, [&](const Triangle& t) { return isDegenerate(mesh, t); });
  repairNormals(mesh);
  repairTangents(mesh);
  const Material& material = materials[indexOf(mesh.material)];
  for (std::uint8_t set = 0; set < 2; ++set) {
    if (mesh.texCoords[set].empty() && usesTexCoords(material, set)) mesh.texCoords[set].resize(mesh.positions.size());
  }
  const TextureSlot& normalMap = material.slot(TextureUse::kNormal);
  if (normalMap.texture && mesh.tangents.empty()) computeTangents(mesh, normalMap);
  return dropped;
}

void finishMeshes(Scene& scene) {
  std::vector<std::size_t> dropped(scene.meshes.size());
  tbb::parallel_for(std::size_t{0}, scene.meshes.size(),
                    [&](std::size_t i) { dropped[i] = finishMesh(scene.materials, scene.meshes[i]); });
  for (const std::size_t count : dropped) scene.counts.degenerateTriangles += count;
  std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.triangles.empty(); });
  if (scene.counts.degenerateTriangles > 0) {
    warnOnce(scene, std::to_string(scene.counts.degenerateTriangles) +
                        " triangles without area or with coordinates that are not finite were skipped");
  }
}

Vec3 placed(const glm::dvec3& position, const SceneDraft& draft, const char* what, const std::string& name = {}) {
  const Vec3 p(position - draft.scene.origin);
  if (!isFinite(p))
    throw InputError(draft.name,
                     std::string(what) + name + " is too far away to be placed; move it or scale the scene down");
  return p;
}

void placeLightsAndCameras(SceneDraft& draft) {
  Scene& scene = draft.scene;
  for (std::size_t i = 0; i < scene.pointLights.size(); ++i) {
    scene.pointLights[i].position = placed(draft.pointPositions[i], draft, "a point light");
  }
  for (std::size_t i = 0; i < scene.spotLights.size(); ++i) {
    scene.spotLights[i].position = placed(draft.spotPositions[i], draft, "a spot light");
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    scene.cameras[i].position = placed(draft.cameraPositions[i], draft, "camera ", printable(scene.cameras[i].name));
  }
}

Bounds sceneBounds(const Scene& scene) {
  Bounds bounds;
  for (const Mesh& mesh : scene.meshes) {
    for (const Triangle& triangle : mesh.triangles) {
      for (int i = 0; i < 3; ++i) bounds.add(mesh.positions[triangle[i]]);
    }
  }
  for (const PointLight& light : scene.pointLights) bounds.add(light.position);
  for (const SpotLight& light : scene.spotLights) bounds.add(light.position);
  return bounds;
}

/// Floats at 1e4 radii from zero are 1e-3 radii apart: beyond, the file itself no longer holds the shape.
constexpr double kCoarseOffset = 1e4;

void warnOfCoarsePositions(SceneDraft& draft, double radius) {
  for (const PartInstance& instance : draft.instances) {
    const Part& part = draft.parts[instance.part];
    if (part.positions.empty() || !isFinite(part.positions[0])) continue;
    const glm::dmat3 linear(instance.world);
    const double offset = glm::length(linear * glm::dvec3(part.positions[0]));
    if (!(offset > kCoarseOffset * radius)) continue;
    warnOnce(
        draft.scene,
        "the file's vertices lie more than 10,000 scene radii from their node's origin, where its floats are coarse; "
        "move the origin to the object and the offset into the node");
    return;
  }
}

}  // namespace

void warnOnce(Scene& scene, const std::string& warning) {
  constexpr std::size_t kMaxWarnings = 100;
  if (scene.warnings.size() >= kMaxWarnings) return;
  if (std::find(scene.warnings.begin(), scene.warnings.end(), warning) == scene.warnings.end()) {
    scene.warnings.push_back(warning);
  }
}

bool usesTexCoords(const Material& material, std::uint8_t set) {
  return material.slots && std::any_of(material.slots->begin(), material.slots->end(),
                                       [&](const TextureSlot& slot) { return slot.texture && slot.texCoord == set; });
}

Scene flatten(SceneDraft draft) {
  const DoubleBounds bounds = draftBounds(draft);
  Scene& scene = draft.scene;
  scene.origin = bounds.centre();
  warnOfCoarsePositions(draft, bounds.radius());

  const std::vector<Placement> placements = layOut(draft, scene.meshes);
  tbb::parallel_for(std::size_t{0}, placements.size(), [&](std::size_t i) {
    const Placement& place = placements[i];
    writeVertices(draft.parts[place.instance->part], place, scene.origin, scene.meshes[place.mesh]);
  });
  draft.parts.clear();
  finishMeshes(scene);
  placeLightsAndCameras(draft);
  scene.bounds = sceneBounds(scene);
  if (scene.cameras.empty()) scene.cameras.push_back(defaultCamera(scene.bounds));
  return std::move(draft.scene);
}

}  // namespace cellcut
