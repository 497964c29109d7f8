/// The loaders on real files, sound and broken.
#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/hostile_budget.h"

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = CELLCUT_CORPUS;

/// Error codes by file, as the validator's authors list them.
std::map<std::string, std::set<std::string>> readManifest() {
  std::map<std::string, std::set<std::string>> manifest;
  std::ifstream lines(kCorpus / "gltf/manifest.tsv");
  std::string line;
  std::getline(lines, line);  // head
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string file, count, code;
    fields >> file >> count;
    auto& codes = manifest[file];
    while (fields >> code) codes.insert(code);
  }
  return manifest;
}

/// Errors that mean data outside of the file, whoever uses it.
bool mustBeRefused(const std::set<std::string>& codes) {
  for (const char* code : {"ACCESSOR_TOO_LONG", "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "ACCESSOR_SMALL_BYTESTRIDE",
                           "BUFFER_VIEW_TOO_LONG", "BUFFER_VIEW_INVALID_BYTE_STRIDE", "GLB_CHUNK_TOO_BIG", "NODE_LOOP",
                           "INVALID_JSON", "GLB_UNEXPECTED_END_OF_HEADER", "GLB_UNEXPECTED_END_OF_CHUNK_HEADER"}) {
    if (codes.contains(code)) return true;
  }
  return false;
}

/// True if a folder's unresolved references concern what is drawn; skins and animations are never looked at.
bool hasUsedReference(const std::string& file, const std::set<std::string>& codes) {
  if (!codes.contains("UNRESOLVED_REFERENCE") || file.find("morph") != std::string::npos) return false;
  for (const char* folder : {"accessor", "image", "material", "mesh", "node", "scene", "texture"}) {
    if (file.starts_with(std::string("base/") + folder + '/')) return true;
  }
  return false;
}

TEST(Corpus, EveryGltfLoadsOrIsRefusedInItsBudget) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no corpus beside the checkout";
  const auto manifest = readManifest();
  ASSERT_GT(manifest.size(), 100u);
  for (const auto& [file, codes] : manifest) {
    const test::HostileBudget budget(file);
    bool refused = false;
    try {
      loadScene(kCorpus / "gltf" / file);
    } catch (const InputError& error) {
      refused = true;
      EXPECT_THAT(error.what(), testing::HasSubstr(fs::path(file).filename().string()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    if (mustBeRefused(codes) || hasUsedReference(file, codes)) {
      EXPECT_TRUE(refused) << file;
    }
  }
}

TEST(Corpus, NearlyAllValidGltfLoad) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no corpus beside the checkout";
  std::set<std::string> refused;
  for (const auto& [file, codes] : readManifest()) {
    if (!codes.empty()) continue;
    try {
      loadScene(kCorpus / "gltf" / file);
    } catch (const InputError& error) {
      refused.insert(file);
    }
  }
  // Buffers without data, which hold nothing that could be shown.
  EXPECT_THAT(refused,
              testing::UnorderedElementsAre("base/buffer/custom_property.gltf", "base/buffer/valid_placeholder.glb",
                                            "base/json/integer_written_as_float.gltf"));
}

TEST(Corpus, TheLoungeIsWhatItsAuthorMade) {
  const fs::path file = kCorpus / "scenes/lounge.glb";
  if (!fs::exists(file)) GTEST_SKIP() << "no corpus beside the checkout";
  const Scene scene = loadScene(file);
  EXPECT_EQ(scene.counts.meshes, 30u);
  EXPECT_EQ(scene.counts.instances, 345u);
  EXPECT_EQ(scene.counts.degenerateTriangles, 0u);
  EXPECT_EQ(scene.pointLights.size(), 6u);
  EXPECT_EQ(scene.spotLights.size(), 4u);
  EXPECT_EQ(scene.directionalLights.size(), 1u);
  EXPECT_EQ(scene.textures.size(), 3u);
  EXPECT_THAT(scene.cameras, testing::ElementsAre(testing::Field(&Camera::name, "camera")));
  EXPECT_THAT(scene.warnings, testing::ElementsAre(testing::HasSubstr("Blender")));
}

TEST(Corpus, MirroredBulbsOfTheLoungeFaceOutwards) {
  const fs::path file = kCorpus / "scenes/lounge.glb";
  if (!fs::exists(file)) GTEST_SKIP() << "no corpus beside the checkout";
  const Scene scene = loadScene(file);
  std::size_t bulbTriangles = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (!scene.materials[indexOf(mesh.material)].name.starts_with("bulb")) continue;
    ASSERT_FALSE(mesh.normals.empty());
    for (const Triangle& t : mesh.triangles) {
      const auto& p = mesh.positions;
      const Vec3 facet = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
      // Smooth bulbs: the shading normal at each corner is on the facet's front side.
      EXPECT_GT(glm::dot(facet, mesh.normals[t.x]), 0);
      ++bulbTriangles;
    }
  }
  EXPECT_EQ(bulbTriangles % 320, 0u);
  EXPECT_GT(bulbTriangles, 0u);
}

}  // namespace
}  // namespace cellcut
