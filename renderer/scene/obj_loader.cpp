#include "renderer/scene/obj_loader.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/obj_lines.h"
#include "renderer/scene/obj_materials.h"
#include "renderer/scene/triangulate.h"

#include <algorithm>
#include <istream>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include <glm/gtc/matrix_transform.hpp>
// As in obj_materials.cpp.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

namespace cellcut {
namespace {

/// Most corners of a face: cutting it up may take the square of them.
constexpr std::size_t kMaxCorners = 4096;
/// Most looks at corners to cut up the faces of a file: half a second, and about what it takes to read a corner for each.
/// Convex faces need one for a corner, others of a hundred corners 10 to 50.
constexpr std::size_t kMaxLooks = std::size_t{1} << 26;
constexpr std::size_t kMaxLooksPerCorner = 64;

/// Most names of material libraries: looking for one takes 20 µs.
constexpr std::size_t kMaxLibraries = 1000;

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// A corner of a face: 0-based indices, kNone where the file gives none.
struct Corner {
  std::uint32_t position, texCoord, normal;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    // Fibonacci hashing of each index in turn (Knuth, TAOCP 3, section 6.4).
    constexpr std::uint64_t kPhi = 0x9E3779B97F4A7C15;
    std::uint64_t h = (c.position + 1) * kPhi;
    h = ((h ^ (h >> 32)) + c.texCoord) * kPhi;
    h = ((h ^ (h >> 32)) + c.normal) * kPhi;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

/// A part while faces are added to it.
struct PartBuilder {
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertexOf;
  std::vector<Corner> vertices;
  std::vector<Triangle> triangles;

  std::uint32_t vertex(const Corner& corner) {
    const auto [entry, isNew] = vertexOf.try_emplace(corner, static_cast<std::uint32_t>(vertices.size()));
    if (isNew) vertices.push_back(corner);
    return entry->second;
  }
};

/// Material, with normals, with texture coordinates.
using PartKey = std::tuple<std::optional<MaterialId>, bool, bool>;

/// Collects what the parser finds, in the order of the file.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, SceneDraft& draft) : folder_(file), draft_(draft) {}

  void addPosition(const glm::dvec3& p) { positions_.push_back(p); }
  void addNormal(const glm::dvec3& n) { normals_.push_back(Vec3(n)); }
  /// OBJ counts v from the bottom of the picture, the scene from its top.
  void addTexCoord(const glm::dvec2& uv) { texCoords_.emplace_back(uv.x, 1 - uv.y); }
  void addFace(std::span<const tinyobj::index_t> indices);
  void useMaterial(std::string_view name);
  void readLibraries(std::string names);
  void finish();

 private:
  std::uint32_t resolved(int index, std::size_t count, const char* what) const;
  MaterialId materialOrDefault(std::optional<MaterialId> id);
  bool readLibrary(const std::string& reference);
  Part partOf(const PartKey& key, const PartBuilder& builder, const glm::dvec3& centre);

  SceneFolder folder_;
  SceneDraft& draft_;
  std::vector<glm::dvec3> positions_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> texCoords_;
  std::map<std::string, bool> isLibrary_;  ///< names that were asked for
  std::set<std::string> libraries_;        ///< files that have been read
  std::map<std::string, MaterialId> materials_;
  std::optional<MaterialId> current_, default_;
  std::map<PartKey, PartBuilder> parts_;
  std::size_t faces_ = 0, triangles_ = 0, corners_ = 0, looks_ = 0;
};

/// 0-based index of what OBJ counts from 1, or from the end if negative. 0 stands for "not given".
std::uint32_t ObjReader::resolved(int index, std::size_t count, const char* what) const {
  if (index == 0) return kNone;
  const std::int64_t n = static_cast<std::int64_t>(count);
  const std::int64_t zeroBased = index > 0 ? std::int64_t{index} - 1 : n + index;
  if (zeroBased < 0 || zeroBased >= n) {
    throw InputError(draft_.name + ": face " + std::to_string(faces_),
                     std::string(what) + ' ' + std::to_string(index) + " does not exist; export the file again");
  }
  return static_cast<std::uint32_t>(zeroBased);
}

void ObjReader::addFace(std::span<const tinyobj::index_t> indices) {
  ++faces_;
  const std::string place = draft_.name + ": face ";
  if (indices.size() < 3) return warnOnce(draft_.scene, "faces of fewer than three corners are not shown");
  if (indices.size() > kMaxCorners) {
    throw InputError(place + std::to_string(faces_),
                     "has more than " + std::to_string(kMaxCorners) + " corners; cut it up");
  }
  std::vector<Corner> corners;
  std::vector<glm::dvec3> polygon;
  bool hasNormals = true, hasTexCoords = true;
  for (const tinyobj::index_t& index : indices) {
    const Corner corner{resolved(index.vertex_index, positions_.size(), "vertex"),
                        resolved(index.texcoord_index, texCoords_.size(), "texture coordinate"),
                        resolved(index.normal_index, normals_.size(), "normal")};
    if (corner.position == kNone)
      throw InputError(place + std::to_string(faces_), "vertex 0 does not exist; OBJ counts from 1");
    hasTexCoords &= corner.texCoord != kNone;
    hasNormals &= corner.normal != kNone;
    corners.push_back(corner);
    polygon.push_back(positions_[corner.position]);
  }
  for (Corner& corner : corners) {  // an attribute that not every corner has is of no use
    if (!hasTexCoords) corner.texCoord = kNone;
    if (!hasNormals) corner.normal = kNone;
  }
  triangles_ += corners.size() - 2;
  if (triangles_ > draft_.limits.maxTriangles) {
    throw InputError(draft_.name, "has more than " + std::to_string(draft_.limits.maxTriangles) +
                                      " triangles, the limit (--max-triangles)");
  }
  PartBuilder& part = parts_[{current_, hasNormals, hasTexCoords}];
  for (const auto& [a, b, c] : triangulate(polygon, looks_)) {
    const std::uint32_t first = part.vertex(corners[a]), second = part.vertex(corners[b]),
                        third = part.vertex(corners[c]);
    part.triangles.emplace_back(first, second, third);
  }
  corners_ += corners.size();
  if (looks_ > kMaxLooks + kMaxLooksPerCorner * corners_) {
    throw InputError(place + std::to_string(faces_),
                     "it and the faces before take too long to cut up; make triangles of faces of many corners");
  }
}

void ObjReader::useMaterial(std::string_view name) {
  const std::string material(unquoted(name));
  const auto found = materials_.find(material);
  current_ = found == materials_.end() ? std::nullopt : std::optional(found->second);
  if (!current_) warnOnce(draft_.scene, "material " + printable(material) + " is missing; a grey one takes its place");
}

/// One name that has blanks, or several; of materials with the same name the first counts.
void ObjReader::readLibraries(std::string names) {
  std::replace(names.begin(), names.end(), '\\', '/');
  constexpr std::size_t kLongestName = 255;
  std::string_view rest = names;
  const std::string first(takeWord(rest));
  if (!rest.empty() && names.size() <= kLongestName && !readLibrary(first) && readLibrary(names)) return;
  rest = names;
  for (std::string name(takeWord(rest)); !name.empty(); name = takeWord(rest)) {
    if (!readLibrary(name)) warnOnce(draft_.scene, "material library " + printable(name) + " is missing");
  }
}

/// False if there is none.
bool ObjReader::readLibrary(const std::string& reference) {
  const auto [asked, isNew] = isLibrary_.try_emplace(reference, false);
  if (!isNew) return asked->second;
  if (isLibrary_.size() > kMaxLibraries) {
    throw InputError(draft_.name,
                     "names more than " + std::to_string(kMaxLibraries) + " material libraries; join them");
  }
  const std::filesystem::path file = folder_.resolve(reference);
  if (!std::filesystem::exists(file)) return false;
  if (libraries_.insert(file.string()).second)
    materials_.merge(readMtl(folder_, reference, draft_.limits.maxTextureBytes, draft_.scene));
  return asked->second = true;
}

MaterialId ObjReader::materialOrDefault(std::optional<MaterialId> id) {
  if (id) return *id;
  if (!default_) {
    default_ = MaterialId{static_cast<std::uint32_t>(draft_.scene.materials.size())};
    Material grey;
    grey.name = "default";
    grey.baseColor = {0.8f, 0.8f, 0.8f, 1};
    grey.metallic = 0;
    grey.specular = 0;
    grey.doubleSided = true;
    draft_.scene.materials.push_back(grey);
  }
  return *default_;
}

Part ObjReader::partOf(const PartKey& key, const PartBuilder& builder, const glm::dvec3& centre) {
  const auto [material, hasNormals, hasTexCoords] = key;
  Part part;
  part.material = materialOrDefault(material);
  const bool needsTexCoords = hasTexCoords && usesTexCoords(draft_.scene.materials[indexOf(part.material)], 0);
  for (const Corner& corner : builder.vertices) {
    part.positions.emplace_back(positions_[corner.position] - centre);
    if (hasNormals) part.normals.push_back(normals_[corner.normal]);
    if (needsTexCoords) part.texCoords[0].push_back(texCoords_[corner.texCoord]);
  }
  part.triangles = builder.triangles;
  return part;
}

void ObjReader::finish() {
  // The file has decimals; as floats they keep them only around the middle of the model.
  DoubleBounds bounds;
  for (const auto& [key, builder] : parts_) {
    for (const Corner& corner : builder.vertices) {
      const glm::dvec3& p = positions_[corner.position];
      if (isFinite(Vec3(p))) bounds.add(p);
    }
  }
  const glm::dvec3 centre = bounds.centre();
  const glm::dmat4 world = glm::translate(glm::dmat4(1), centre);
  for (const auto& [key, builder] : parts_) {
    draft_.instances.push_back({draft_.parts.size(), world});
    draft_.parts.push_back(partOf(key, builder, centre));
  }
  draft_.scene.counts.meshes = draft_.scene.counts.instances = draft_.parts.size();
}

ObjReader& readerOf(void* user) {
  return *static_cast<ObjReader*>(user);
}

/// Read-only stream over bytes that outlive it.
class ByteStream : private std::streambuf, public std::istream {
 public:
  explicit ByteStream(std::span<char> bytes) : std::istream(static_cast<std::streambuf*>(this)) {
    setg(bytes.data(), bytes.data(), bytes.data() + bytes.size());
  }
};

}  // namespace

SceneDraft loadObj(const std::filesystem::path& file, const LoadLimits& limits) {
  SceneDraft draft;
  draft.name = file.filename().string();
  draft.limits = limits;
  ObjReader reader(file, draft);
  std::vector<std::byte> bytes = readFile(file, kMaxSceneFileBytes);
  const std::span text(reinterpret_cast<char*>(bytes.data()), bytes.size());
  joinContinuedLines(text);
  const ObjOutline outline = readOutline(text);
  if (!outline.hasVertices) throw InputError(draft.name, "has no vertices; it is no OBJ file, or an empty one");
  if (!outline.unreadable.empty())
    throw InputError(draft.name,
                     printable(outline.unreadable) + ": has words that are no numbers; export the file again");
  if (!outline.doubtful.empty())
    warnOnce(draft.scene, printable(outline.doubtful) + ": is not read as it stands; surfaces there may look wrong");
  for (const std::string& names : outline.libraries) reader.readLibraries(names);

  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, double x, double y, double z, double) { readerOf(user).addPosition({x, y, z}); };
  callbacks.normal_cb = [](void* user, double x, double y, double z) { readerOf(user).addNormal({x, y, z}); };
  callbacks.texcoord_cb = [](void* user, double u, double v, double) { readerOf(user).addTexCoord({u, v}); };
  callbacks.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    readerOf(user).addFace({indices, static_cast<std::size_t>(count)});
  };
  callbacks.usemtl_cb = [](void* user, const char* name, int) { readerOf(user).useMaterial(name); };
  ByteStream stream(text);
  std::string warnings, errors;
  tinyobj::LoadObjWithCallback(stream, callbacks, &reader, nullptr, &warnings, &errors);
  if (!errors.empty())
    throw InputError(draft.name, printable(errors.substr(0, errors.find('\n'))) + "; export the file again");
  reader.finish();
  const auto isFlat = [](const Part& part) { return part.normals.empty(); };
  if (outline.hasSmoothingGroups && std::any_of(draft.parts.begin(), draft.parts.end(), isFlat))
    warnOnce(draft.scene, "smoothing groups are not read; faces without normals are flat");
  return draft;
}

}  // namespace cellcut
