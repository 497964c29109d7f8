/// Files that lie. Each is a valid file with one thing broken, so that the test fails if that one check goes.
#include "renderer/scene/gltf_container.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/bytes.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

#include <functional>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using test::GltfBuilder;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class HostileGltf : public testing::Test {
 protected:
  /// An indexed triangle with normals under two nodes.
  static GltfBuilder sound() {
    GltfBuilder file;
    Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    primitive["indices"] = file.addAccessor(std::vector<std::uint32_t>{0, 1, 2});
    primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    const std::size_t child = file.add("nodes", {{"mesh", file.addMesh(primitive)}});
    file.addRoot({{"children", {child}}});
    return file;
  }
  std::string refusalOf(const std::filesystem::path& file) {
    return test::refusalOf([&] { loadScene(file); });
  }
  /// What the loader says of the sound file after `damage`.
  std::string refusalOf(const std::function<void(Json&)>& damage) {
    GltfBuilder file = sound();
    file.json["buffers"] = {{{"byteLength", 84}}};
    damage(file.json);
    return refusalOf(file.writeGlb(folder / "test.glb"));
  }
  std::string refusalOf(const std::vector<std::byte>& bytes) {
    return refusalOf(test::writeFile(folder / "test.glb", bytes));
  }
  test::TemporaryDirectory folder;
};

TEST_F(HostileGltf, TheSoundFileLoads) {
  EXPECT_EQ(refusalOf([](Json&) {}), "was not refused");
}

TEST_F(HostileGltf, RefusesBufferViewsPastTheirBuffer) {
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["byteLength"] = 85; }), HasSubstr("bufferViews[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][2]["byteOffset"] = 49; }), HasSubstr("bufferViews[2]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["byteOffset"] = ~0ull - 8; }), HasSubstr("bufferViews[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["buffer"] = 1; }), HasSubstr("bufferViews[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["buffer"] = -1; }), HasSubstr("bufferViews[0]"));
}

TEST_F(HostileGltf, RefusesBuffersOfAnotherLengthThanTheirData) {
  for (const unsigned long long length : {85ull, 1ull << 31, (1ull << 32) + 84, 1ull << 63, ~0ull - 83, ~0ull}) {
    GltfBuilder file = sound();
    file.json["buffers"] = {{{"byteLength", length}}};
    const test::HostileBudget budget(std::to_string(length));
    EXPECT_THAT(refusalOf(file.writeGlb(folder / "test.glb")), StartsWith("test.glb: ")) << length;
    EXPECT_THAT(refusalOf(file.writeGltf(folder / "test.gltf")), StartsWith("test.gltf: ")) << length;
  }
}

TEST_F(HostileGltf, RefusesAccessorsPastTheirBufferView) {
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["count"] = 4; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["count"] = ~0ull; }), HasSubstr("accessors[0]"));
  // 12 · count wraps around to 4 bytes in 64 bits.
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["count"] = 1537228672809129302ull; }),
              HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["byteOffset"] = 4; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["byteOffset"] = ~0ull - 3; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["bufferView"] = 7; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["bufferView"] = -2; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["byteStride"] = 16; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["bufferViews"][0]["byteStride"] = 8; }), HasSubstr("accessors[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["componentType"] = 5130; }), HasSubstr("accessors[0]"));
}

TEST_F(HostileGltf, RefusesAccessorsThatHoldNothingAtLength) {
  EXPECT_THAT(refusalOf([](Json& j) {
                j["accessors"][0].erase("bufferView");
                j["accessors"][0]["count"] = 1'000'000'000;
              }),
              HasSubstr("accessors[0]"));
}

TEST_F(HostileGltf, RefusesIndicesPastTheVertices) {
  for (const std::uint32_t index : {3u, 0xFFFFFFFFu}) {
    GltfBuilder file;
    Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    primitive["indices"] = file.addAccessor(std::vector<std::uint32_t>{0, 1, index});
    file.addRoot({{"mesh", file.addMesh(primitive)}});
    EXPECT_THAT(refusalOf(file.glb()), HasSubstr("meshes[0]: index"));
  }
}

TEST_F(HostileGltf, RefusesIndicesAndAttributesOfWrongTypes) {
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][1]["componentType"] = 5126; }), HasSubstr("indices"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][0]["type"] = "VEC2"; }), HasSubstr("POSITION"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][2]["type"] = "SCALAR"; }), HasSubstr("NORMAL"));
  EXPECT_THAT(refusalOf([](Json& j) { j["accessors"][2]["count"] = 2; }), HasSubstr("different numbers"));
}

TEST_F(HostileGltf, RefusesSparseAccessorsThatDoNotFit) {
  const auto sparse = [&](std::vector<std::uint16_t> indices, const std::function<void(Json&)>& damage) {
    GltfBuilder file;
    Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::size_t indexView = file.addBufferView(std::as_bytes(std::span(indices)));
    const std::size_t valueView = file.addBufferView(bytesOf(std::vector<glm::vec3>(indices.size())));
    Json& s = file.json["accessors"][0]["sparse"];
    s = {{"count", indices.size()},
         {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
         {"values", {{"bufferView", valueView}}}};
    damage(s);
    file.addRoot({{"mesh", file.addMesh(primitive)}});
    return refusalOf(file.glb());
  };
  EXPECT_EQ(sparse({0, 2}, [](Json&) {}), "was not refused");
  EXPECT_THAT(sparse({0, 3}, [](Json&) {}), HasSubstr("past the last"));
  EXPECT_THAT(sparse({1, 1}, [](Json&) {}), HasSubstr("must increase"));
  EXPECT_THAT(sparse({2, 1}, [](Json&) {}), HasSubstr("must increase"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["count"] = 4; }), HasSubstr("more sparse"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["count"] = 3; }), HasSubstr("reaches past"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["count"] = -1; }), HasSubstr("more sparse"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["indices"]["bufferView"] = 9; }), HasSubstr("does not exist"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["count"] = ~0ull; }), HasSubstr("more sparse"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["count"] = ~0ull - 1; }), HasSubstr("more sparse"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["values"]["bufferView"] = 9; }), HasSubstr("does not exist"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["values"]["bufferView"] = -1; }), HasSubstr("does not exist"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["indices"]["byteOffset"] = 1; }), HasSubstr("reaches past"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["indices"]["byteOffset"] = 5; }), HasSubstr("reaches past"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["indices"]["byteOffset"] = 1 << 30; }), HasSubstr("reaches past"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["values"]["byteOffset"] = 4; }), HasSubstr("reaches past"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["values"]["byteOffset"] = 1 << 30; }), HasSubstr("reaches past"));
  // tinygltf 2.9 reads no negative number there and leaves 0.
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["values"]["byteOffset"] = -4; }),
              testing::AnyOf(HasSubstr("negative"), "was not refused"));
  EXPECT_THAT(sparse({0, 2}, [](Json& s) { s["indices"]["componentType"] = 5122; }), HasSubstr("unsigned"));
}

TEST_F(HostileGltf, RefusesReferencesToWhatDoesNotExist) {
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["mesh"] = 5; }), HasSubstr("nodes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["mesh"] = -7; }), HasSubstr("nodes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["camera"] = 0; }), HasSubstr("nodes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][1]["children"] = {9}; }), HasSubstr("nodes[1]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["scenes"][0]["nodes"] = {2}; }), HasSubstr("scenes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["scene"] = 1; }), HasSubstr("scene"));
  EXPECT_THAT(refusalOf([](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }), HasSubstr("meshes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 8; }),
              HasSubstr("meshes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) {
                j["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
              }),
              HasSubstr("materials[0]"));
  EXPECT_THAT(
      refusalOf([](Json& j) {
        j["materials"] = {{{"extensions", {{"KHR_materials_specular", {{"specularTexture", {{"index", 3}}}}}}}}};
      }),
      HasSubstr("materials[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["textures"] = {{{"source", 4}}}; }), HasSubstr("textures[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["textures"] = {{{"sampler", 4}}}; }), HasSubstr("textures[0]"));
  EXPECT_THAT(refusalOf([](Json& j) {
                j["extensions"]["CELLCUT_environment"] = {{"bufferView", 12}};
              }),
              HasSubstr("CELLCUT_environment"));
}

TEST_F(HostileGltf, RefusesNodesThatFormNoTree) {
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["children"] = {1}; }), HasSubstr("ancestor"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["children"] = {0}; }), HasSubstr("nodes[0]"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"].push_back({{"children", {0}}}); }), HasSubstr("more than one parent"));
  EXPECT_THAT(refusalOf([](Json& j) { j["scenes"][0]["nodes"] = {1, 1}; }), HasSubstr("twice"));
  EXPECT_THAT(refusalOf([](Json& j) { j["scenes"][0]["nodes"] = {0}; }), HasSubstr("has a parent"));
}

TEST_F(HostileGltf, AChainOf200000NodesLoads) {
  constexpr int kDepth = 200'000;
  GltfBuilder file;
  Json nodes = Json::array();
  for (int i = 0; i + 1 < kDepth; ++i) nodes.push_back({{"children", {i + 1}}, {"translation", {0, 0, 1}}});
  nodes.push_back({{"mesh", file.addTriangle()}});
  file.json["nodes"] = std::move(nodes);
  file.json["scenes"][0]["nodes"] = {0};
  for (const auto& path : {file.writeGlb(folder / "chain.glb"), file.writeGltf(folder / "chain.gltf")}) {
    // A second where nothing else runs. Most of it is memory's first touch, which beside other programs takes twice that.
    const test::HostileBudget budget(path.filename(), 4);
    const Scene scene = loadScene(path);
    EXPECT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(scene.origin.z, kDepth - 1);
  }
}

TEST_F(HostileGltf, RefusesInstancesWithoutEnd) {
  GltfBuilder file;
  Json primitive;
  primitive["attributes"]["POSITION"] =
      file.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3'000'000}});
  const std::size_t mesh = file.addMesh(primitive);
  for (int i = 0; i < 200; ++i) file.addRoot({{"mesh", mesh}});
  EXPECT_THAT(refusalOf(file.glb()), HasSubstr("instances"));
}

/// As many nodes, each with a mesh of as many of these primitives.
GltfBuilder nodesTimesPrimitives(GltfBuilder file, std::size_t count, const Json& primitive) {
  file.json["meshes"] = {{{"primitives", Json(count, primitive)}}};
  file.json["nodes"] = Json(count, {{"mesh", 0}});
  std::vector<std::size_t> roots(count);
  std::iota(roots.begin(), roots.end(), std::size_t{0});
  file.json["scenes"][0]["nodes"] = roots;
  return file;
}

TEST_F(HostileGltf, PrimitivesWithoutTrianglesTakeNothingWhereverTheyAre) {
  const Json primitive = {{"attributes", Json::object()}, {"mode", 0}};
  const auto path = nodesTimesPrimitives(GltfBuilder(), 5000, primitive).writeGltf(folder / "test.gltf");
  const test::HostileBudget budget("nodes times primitives");
  const Scene scene = loadScene(path);
  EXPECT_EQ(scene.triangleCount(), 0u);
  EXPECT_EQ(scene.counts.instances, 5000u);
  EXPECT_THAT(scene.warnings, testing::ElementsAre("points and lines are not shown"));
}

TEST_F(HostileGltf, RefusesMorePlacedPrimitivesThanMemoryHolds) {
  GltfBuilder file;
  const Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const auto path = nodesTimesPrimitives(file, 4097, primitive).writeGlb(folder / "test.glb");
  const test::HostileBudget budget("nodes times primitives");
  EXPECT_THAT(refusalOf(path),
              HasSubstr("test.glb: more than 16777216 primitives with all instances written out; join"));
}

TEST_F(HostileGltf, CornersOfPointsAreNotRead) {
  GltfBuilder file;
  const std::size_t corners =
      file.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", std::size_t{1} << 22}});
  const Json primitive = {{"attributes", {{"POSITION", corners}}}, {"mode", 0}};
  file.addRoot({{"mesh", file.add("meshes", {{"primitives", Json(1000, primitive)}})}});
  const auto path = file.writeGltf(folder / "test.gltf");
  const test::HostileBudget budget("points");
  EXPECT_EQ(loadScene(path).triangleCount(), 0u);
}

TEST_F(HostileGltf, TwentyThousandNodesOfOneCameraHaveNamesOfTheirOwn) {
  GltfBuilder file;
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  file.addRoot({{"camera", 0}, {"name", "camera.3"}});
  for (int i = 1; i < 20'000; ++i) file.addRoot({{"camera", 0}});
  const auto path = file.writeGltf(folder / "test.gltf");
  const test::HostileBudget budget("cameras");
  const Scene scene = loadScene(path);
  std::set<std::string> names;
  for (const Camera& camera : scene.cameras) names.insert(camera.name);
  EXPECT_EQ(names.size(), 20'000u);
  EXPECT_EQ(scene.cameras[3].name, "camera.4");
}

TEST_F(HostileGltf, NamesAreShownWithoutControlCharactersAndHalfCharacters) {
  std::string name = "\x1b[31m\n\xc2\x9b";
  for (int i = 0; i < 60; ++i) name += "ü";
  std::string shown = "?[31m???";
  for (int i = 0; i < 36; ++i) shown += "ü";
  shown += "…";
  EXPECT_THAT(refusalOf([&](Json& j) { j["extensionsRequired"] = {name}; }), HasSubstr("the extension " + shown + ","));
  EXPECT_THAT(refusalOf([&](Json& j) {
                j["materials"] = {{{"name", name}, {"emissiveFactor", {-1, 0, 0}}}};
              }),
              HasSubstr('"' + shown + "\" emits negative light"));
  EXPECT_THAT(
      refusalOf([&](Json& j) {
        j["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", name}, {"intensity", -1}}};
        j["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
      }),
      HasSubstr("light \"" + shown + "\" has a negative intensity"));
  GltfBuilder file = sound();
  file.json["extensionsUsed"] = {name};
  EXPECT_THAT(loadScene(file.writeGltf(folder / "test.gltf")).warnings,
              testing::ElementsAre("the extension " + shown + " is not supported and ignored"));
}

TEST_F(HostileGltf, RefusesTransformsThatAreNone) {
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["matrix"] = {1, 2, 3}; }), HasSubstr("16 numbers"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["rotation"] = {0, 0, 0, 0}; }), HasSubstr("quaternion"));
  EXPECT_THAT(refusalOf([](Json& j) { j["nodes"][0]["scale"] = {1, 2}; }), HasSubstr("3 numbers"));
  EXPECT_THAT(refusalOf([](Json& j) {
                j["nodes"][0]["scale"] = {1e300, 1, 1};
                j["nodes"][1]["scale"] = {1e300, 1, 1};
              }),
              HasSubstr("not finite"));
}

TEST_F(HostileGltf, RefusesCamerasWithoutAnAngle) {
  for (const double yfov : {0.0, -1.0, 3.15}) {
    EXPECT_THAT(refusalOf([&](Json& j) {
                  j["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 1}}}}};
                  j["nodes"][0]["camera"] = 0;
                }),
                HasSubstr("cameras[0]"));
  }
}

TEST_F(HostileGltf, RefusesRequiredExtensionsByName) {
  EXPECT_THAT(refusalOf([](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
              HasSubstr("KHR_draco_mesh_compression"));
  // Compressed files are broken in other ways, too; the extension is the reason.
  EXPECT_THAT(refusalOf([](Json& j) {
                j["extensionsRequired"] = {"KHR_draco_mesh_compression"};
                j["accessors"][1].erase("bufferView");
              }),
              HasSubstr("KHR_draco_mesh_compression"));
}

TEST_F(HostileGltf, RefusesOtherVersions) {
  EXPECT_THAT(refusalOf([](Json& j) { j["asset"]["version"] = "1.0"; }), HasSubstr("version"));
  EXPECT_THAT(refusalOf([](Json& j) { j["asset"]["minVersion"] = "2.1"; }), HasSubstr("version"));
}

TEST_F(HostileGltf, RefusesDeepNestingAndAcceptsBracketsInStrings) {
  const auto nested = [](std::size_t depth) {
    return "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  EXPECT_EQ(refusalOf(test::writeFile(folder / "a.gltf", nested(100))), "was not refused");
  const std::filesystem::path deep = test::writeFile(folder / "a.gltf", nested(1'000'000));
  const test::HostileBudget budget("nested");
  EXPECT_THAT(refusalOf(deep), HasSubstr("a.gltf: JSON nested more than 128 deep; export"));
  EXPECT_NO_THROW(
      checkJsonShape("[\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"]", "a", "mend it"));
}

TEST_F(HostileGltf, RefusesEveryTruncationOfAFile) {
  const std::vector<std::byte> whole = sound().glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THAT(refusalOf(std::vector(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
                StartsWith("test.glb: "))
        << size;
  }
}

TEST_F(HostileGltf, RefusesChunksThatLieAboutTheirLength) {
  const std::vector<std::byte> whole = sound().glb();
  const auto with = [&](std::size_t offset, std::uint32_t word) {
    std::vector<std::byte> bytes = whole;
    for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(word >> (8 * i));
    return refusalOf(bytes);
  };
  std::uint32_t json = 0;
  std::memcpy(&json, whole.data() + 12, 4);
  const std::size_t binary = 20 + json;
  EXPECT_THAT(with(12, 0xFFFFFFF0), HasSubstr("chunk 0"));
  EXPECT_THAT(with(12, static_cast<std::uint32_t>(whole.size())), HasSubstr("chunk 0"));
  EXPECT_THAT(with(binary, 84 + 4), HasSubstr("chunk 1"));  // by less than a chunk's header
  EXPECT_THAT(with(binary, 0xFFFFFFFC), HasSubstr("chunk 1"));
  EXPECT_THAT(with(8, 0xFFFFFFFF), HasSubstr("shorter"));
  EXPECT_THAT(with(4, 1), HasSubstr("version 1"));
  EXPECT_THAT(with(16, 0x004E4942), HasSubstr("JSON"));
  EXPECT_THAT(with(binary + 4, 0x4E4F534A), HasSubstr("chunk 1"));
}

TEST_F(HostileGltf, RefusesBuffersAndImagesOutsideOfTheFolder) {
  test::writeFile(folder / "secret.bin", std::string(84, 'x'));
  std::filesystem::create_directory(folder / "scene");
  const struct {
    const char* uri;
    const char* refusal;
  } references[] = {{"../secret.bin", "\"../secret.bin\": leads out of the scene's folder; put"},
                    {"%2e%2e/secret.bin", "\"../secret.bin\": leads out of the scene's folder; put"},
                    {"..%2Fsecret.bin", "\"../secret.bin\": leads out of the scene's folder; put"},
                    {"%2Fetc%2Fpasswd", "\"/etc/passwd\": is an absolute path; name"},
                    {"/etc/passwd", "\"/etc/passwd\": is an absolute path; name"},
                    {"file:///etc/passwd", "\"file:///etc/passwd\": has a scheme that is not read; put"},
                    {"missing.bin", "missing.bin: does not exist; check"},
                    {"secret.bin%0A.png", "\"secret.bin?.png\": has control characters in a file name; rename"},
                    {"%2e%2e/secret.bin%00.png", "secret.bin"}};  // tinygltf 2.9 ends names at a NUL
  for (const auto& [uri, refusal] : references) {
    const auto named = testing::AllOf(StartsWith("test.gltf: "), HasSubstr(refusal));
    GltfBuilder buffer = sound();
    buffer.json["buffers"] = {{{"byteLength", 84}, {"uri", uri}}};
    EXPECT_THAT(refusalOf(buffer.writeGltf(folder / "scene/test.gltf")), named);
    GltfBuilder image = sound();
    image.json["images"] = {{{"uri", uri}}};
    EXPECT_THAT(refusalOf(image.writeGltf(folder / "scene/test.gltf")), named);
  }
  // An image without a file is an error only where it is used.
  GltfBuilder file = sound();
  file.json["buffers"] = {{{"byteLength", 84}, {"uri", ""}}};
  EXPECT_THAT(refusalOf(file.writeGltf(folder / "scene/test.gltf")),
              testing::AllOf(StartsWith("test.gltf: "), HasSubstr("'uri' is missing")));
}

TEST_F(HostileGltf, RefusesWhatIsNoSceneFile) {
  EXPECT_THAT(refusalOf(folder / "missing.glb"), HasSubstr("missing.glb"));
  EXPECT_THAT(refusalOf(folder.path()), HasSubstr(folder.path().string() + ": is not a scene file; .gltf"));
  EXPECT_THAT(refusalOf(test::writeFile(folder / "empty.glb", "")), HasSubstr("empty.glb: is empty"));
  for (const char* name : {"picture.glb", "picture.gltf"}) {
    EXPECT_THAT(refusalOf(test::writeFile(folder / name, "\x89PNG\r\n\x1a\n")), HasSubstr(": is no glTF file"));
  }
  EXPECT_THAT(refusalOf(test::writeFile(folder / "a.fbx", "x")), HasSubstr(".gltf"));
  for (const char* text :
       {"", "{", "[]", "null", "{}", "{\"asset\":1}", "{\"asset\":{\"version\":2}}", "1e999", "\xFF\xFE"}) {
    EXPECT_THAT(refusalOf(test::writeFile(folder / "a.gltf", text)), StartsWith("a.gltf: ")) << text;
  }
}

}  // namespace
}  // namespace cellcut::test
