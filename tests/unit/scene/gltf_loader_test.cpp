#include "renderer/lights/lights.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/bytes.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/vectors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using test::GltfBuilder;
using Json = nlohmann::json;
using testing::HasSubstr;

class GltfLoader : public testing::Test {
 protected:
  Scene load(const GltfBuilder& file) { return loadScene(file.writeGlb(folder / "test.glb")); }

  test::TemporaryDirectory folder;
};

Vec3 filePosition(const Scene& scene, const Mesh& mesh, std::uint32_t vertex) {
  return Vec3(glm::dvec3(mesh.positions[vertex]) + scene.origin);
}

Vec3 facet(const Mesh& mesh, const Triangle& t) {
  return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
}

TEST_F(GltfLoader, ReadsATriangleOfEitherContainer) {
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}});
  for (const auto& path : {file.writeGlb(folder / "a.GLB"), file.writeGltf(folder / "a.gltf")}) {
    const Scene scene = loadScene(path);
    ASSERT_EQ(scene.triangleCount(), 1u);
    const Mesh& mesh = scene.meshes[0];
    expectNear(filePosition(scene, mesh, mesh.triangles[0].x), {0, 0, 0});
    expectNear(filePosition(scene, mesh, mesh.triangles[0].y), {1, 0, 0});
    expectNear(filePosition(scene, mesh, mesh.triangles[0].z), {0, 1, 0});
    expectNear(scene.bounds.centre(), Vec3(0));
    EXPECT_EQ(scene.materials[indexOf(mesh.material)].metallic, 1);  // glTF's default material
    EXPECT_EQ(scene.generator, "test");
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST_F(GltfLoader, ASceneWithoutAnythingIsEmptyAndValid) {
  const Scene scene = load(GltfBuilder());
  EXPECT_EQ(scene.triangleCount(), 0u);
  EXPECT_TRUE(scene.bounds.empty());
  EXPECT_EQ(scene.cameras.size(), 1u);
}

TEST_F(GltfLoader, CutsStripsAndFansWithTheirWinding) {
  const std::vector<glm::vec3> strip{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const std::vector<glm::vec3> fan{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& [mode, positions, count] : {std::tuple(5, strip, 3u), std::tuple(6, fan, 2u)}) {
    GltfBuilder file;
    Json primitive = file.primitive(positions);
    primitive["mode"] = mode;
    file.addRoot({{"mesh", file.addMesh(primitive)}});
    const Scene scene = load(file);
    ASSERT_EQ(scene.triangleCount(), count);
    for (const Triangle& t : scene.meshes[0].triangles) EXPECT_GT(facet(scene.meshes[0], t).z, 0);
  }
}

TEST_F(GltfLoader, WarnsOfPointsAndLinesAndShowsTheRest) {
  GltfBuilder file;
  Json points = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Json triangles = points;
  points["mode"] = 0;
  file.add("meshes", {{"primitives", {points, triangles}}});
  file.addRoot({{"mesh", 0}});
  const Scene scene = load(file);
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("points and lines")));
}

template <class T>
void addIndexedTriangle(GltfBuilder& file, int componentType) {
  Json primitive = file.primitive({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["indices"] = file.addAccessor(std::vector<T>{3, 1, 2}, "SCALAR", componentType);
  file.addRoot({{"mesh", file.addMesh(primitive)}});
}

TEST_F(GltfLoader, ReadsAllIndexTypesAndLeavesUnusedVerticesOut) {
  for (const int type : {5121, 5123, 5125}) {
    GltfBuilder file;
    if (type == 5121) addIndexedTriangle<std::uint8_t>(file, type);
    if (type == 5123) addIndexedTriangle<std::uint16_t>(file, type);
    if (type == 5125) addIndexedTriangle<std::uint32_t>(file, type);
    const Scene scene = load(file);
    ASSERT_EQ(scene.triangleCount(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 3u);
    expectNear(filePosition(scene, mesh, mesh.triangles[0].x), {0, 1, 0});
    expectNear(filePosition(scene, mesh, mesh.triangles[0].y), {0, 0, 0});
  }
}

TEST_F(GltfLoader, ReadsFewVerticesOutOfAVeryLongAccessor) {
  GltfBuilder file;
  std::vector<glm::vec3> many(100'000, glm::vec3(5));
  many[0] = {0, 0, 0};
  many[50'000] = {1, 0, 0};
  many[99'999] = {0, 1, 0};
  Json primitive = file.primitive(many);
  primitive["indices"] = file.addAccessor(std::vector<std::uint32_t>{0, 50'000, 99'999});
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.meshes[0].positions.size(), 3u);
  expectNear(filePosition(scene, scene.meshes[0], scene.meshes[0].triangles[0].z), {0, 1, 0});
}

TEST_F(GltfLoader, ReadsQuantizedPositionsPlainAndNormalized) {
  for (const bool normalized : {false, true}) {
    GltfBuilder file;
    // Four components each, so that the stride is a multiple of four as glTF wants.
    const std::vector<glm::vec<4, std::int16_t>> values{{0, 0, 0, 0}, {32767, 0, 0, 0}, {0, -32768, 0, 0}};
    const std::size_t view = file.addBufferView(std::as_bytes(std::span(values)), {{"byteStride", 8}});
    const std::size_t accessor = file.add(
        "accessors",
        {{"bufferView", view}, {"componentType", 5122}, {"type", "VEC3"}, {"count", 3}, {"normalized", normalized}});
    file.addRoot({{"mesh", file.addMesh({{"attributes", {{"POSITION", accessor}}}})}});
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = load(file);
    const Mesh& mesh = scene.meshes[0];
    expectNear(filePosition(scene, mesh, 1), {normalized ? 1 : 32767, 0, 0});
    expectNear(filePosition(scene, mesh, 2), {0, normalized ? -1 : -32768, 0});
  }
}

TEST_F(GltfLoader, SparseValuesReplaceThoseOfTheAccessor) {
  GltfBuilder file;
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 9, 0}});
  const std::size_t indices = file.addBufferView(bytesOf(std::vector<std::uint16_t>{2}));
  const std::size_t values = file.addBufferView(bytesOf(std::vector<glm::vec3>{{0, 3, 0}}));
  file.json["accessors"][0]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", values}}}};
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  expectNear(filePosition(scene, scene.meshes[0], 2), {0, 3, 0});
}

TEST_F(GltfLoader, ReadsNormalsTexCoordsAndColors) {
  GltfBuilder file;
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(3, {0, 0, 2}));
  primitive["attributes"]["COLOR_0"] =
      file.addAccessor(std::vector<glm::vec<4, std::uint8_t>>{{255, 0, 51, 255}, {0, 0, 0, 0}, {0, 0, 0, 0}}, "VEC4",
                       5121, {{"normalized", true}});
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.normals.size(), 3u);
  expectNear(mesh.normals[0], {0, 0, 1});
  ASSERT_EQ(mesh.colors.size(), 3u);
  EXPECT_LT(glm::length(mesh.colors[0] - Vec4(1, 0, 0.2f, 1)), kRounding);
  EXPECT_TRUE(mesh.tangents.empty());
}

TEST_F(GltfLoader, UselessNormalsBecomeTheFacets) {
  GltfBuilder file;
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>{{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}});
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  expectNear(scene.meshes[0].normals[0], {0, 0, 1});
  expectNear(scene.meshes[0].normals[1], {0, 0, 1});
  expectNear(scene.meshes[0].normals[2], {0, 1, 0});
}

TEST_F(GltfLoader, ComposesTransformsOfTheHierarchy) {
  GltfBuilder file;
  const std::size_t mesh = file.addTriangle();
  const std::size_t leaf = file.add("nodes", {{"mesh", mesh}, {"translation", {1, 0, 0}}});
  // A quarter about +z, then ×2, then up by 5: (1, 0, 0) → (0, 2, 5).
  file.addRoot({{"children", {leaf}},
                {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}},
                {"scale", {2, 2, 2}},
                {"translation", {0, 0, 5}}});
  const Scene scene = load(file);
  expectNear(filePosition(scene, scene.meshes[0], 0), {0, 2, 5});
  expectNear(filePosition(scene, scene.meshes[0], 1), {0, 4, 5});
}

TEST_F(GltfLoader, ReadsMatricesColumnByColumn) {
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1}}});
  const Scene scene = load(file);
  expectNear(filePosition(scene, scene.meshes[0], 1), {7, 10, 9});
}

TEST_F(GltfLoader, MirroredInstancesKeepTheirFrontAndTheirNormals) {
  GltfBuilder file;
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(3, glm::normalize(Vec3(1, 0, 1))));
  const std::size_t mesh = file.addMesh(primitive);
  for (const Json& scale : {Json{-1, 1, 1}, Json{1, 1, -1}, Json{-1, -1, -1}, Json{-3, 0.5, 2}}) {
    GltfBuilder mirrored = file;
    mirrored.addRoot({{"mesh", mesh}, {"scale", scale}});
    const Scene scene = load(mirrored);
    const Mesh& m = scene.meshes[0];
    const Vec3 s{scale[0], scale[1], scale[2]};
    // The front was where +z was, and stays there under the inverse transpose.
    EXPECT_GT(facet(m, m.triangles[0]).z * s.z, 0) << scale;
    expectNear(m.normals[0], glm::normalize(Vec3(1, 0, 1) / s));
  }
}

TEST_F(GltfLoader, FlattenedInstancesKeepTheNormalOfTheirPlane) {
  GltfBuilder file;
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
  file.addRoot({{"mesh", file.addMesh(primitive)}, {"scale", {1, 1, 0}}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.triangleCount(), 1u);
  expectNear(scene.meshes[0].normals[0], {0, 0, 1});
}

TEST_F(GltfLoader, InstancesOfOneMaterialShareAMesh) {
  GltfBuilder file;
  const std::size_t mesh = file.addTriangle();
  for (int i = 0; i < 10; ++i) file.addRoot({{"mesh", mesh}, {"translation", {2 * i, 0, 0}}});
  const Scene scene = load(file);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.triangleCount(), 10u);
  EXPECT_EQ(scene.counts.instances, 10u);
  EXPECT_EQ(scene.counts.meshes, 1u);
}

TEST_F(GltfLoader, FarFromTheOriginIsAsAtTheOrigin) {
  const auto at = [&](double x) {
    GltfBuilder file;
    const std::size_t child = file.add("nodes", {{"mesh", file.addTriangle()}, {"scale", {0.3, 0.3, 0.3}}});
    const std::size_t second = file.add("nodes", {{"mesh", 0}, {"translation", {0.7, 0.1, 0}}});
    file.addRoot({{"translation", {x, -x, x}}, {"children", {child, second}}});
    return load(file);
  };
  const Scene here = at(0), far = at(1e4);
  EXPECT_NEAR(far.origin.x - here.origin.x, 1e4, 1e-9);
  EXPECT_TRUE(far.warnings.empty());
  for (std::size_t i = 0; i < 6; ++i) {
    // Sums near 1e4 are rounded in double, 2e-12 apart; in float a few of the positions may fall to the other side.
    expectNear(here.meshes[0].positions[i], far.meshes[0].positions[i], 1.2e-7f);
  }
}

TEST_F(GltfLoader, AFarLightTakesNoDigitsOfTheTriangles) {
  for (const double distance : {1e7, 1e11, 1e30}) {
    GltfBuilder file;
    file.addRoot({{"mesh", file.addTriangle()}});
    file.addRoot({{"translation", {0, distance, 0}}, {"extensions", file.addLight({{"type", "point"}})}});
    const Scene scene = load(file);
    EXPECT_EQ(scene.origin, glm::dvec3(0.5, 0.5, 0));
    ASSERT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[0], Vec3(-0.5f, -0.5f, 0));
    EXPECT_EQ(scene.pointLights.at(0).position, Vec3(glm::dvec3(-0.5, distance - 0.5, 0)));
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST_F(GltfLoader, LightsWithoutTrianglesHaveAMiddleOfTheirOwn) {
  GltfBuilder file;
  const Json light = file.addLight({{"type", "point"}});
  for (const double x : {1e9, 1e9 + 1}) file.addRoot({{"translation", {x, 0, 0}}, {"extensions", light}});
  const Scene scene = load(file);
  EXPECT_EQ(scene.pointLights.at(0).position, Vec3(-0.5f, 0, 0));
  EXPECT_EQ(scene.pointLights.at(1).position, Vec3(0.5f, 0, 0));
}

TEST_F(GltfLoader, VerticesThatNoTriangleUsesDoNotMoveIt) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e30f, 0, 0}};
  for (const std::vector<std::uint32_t>& indices : {std::vector<std::uint32_t>{}, {0, 1, 2}, {0, 1, 2, 3}}) {
    GltfBuilder file;
    auto primitive = file.primitive(positions);
    if (!indices.empty()) primitive["indices"] = file.addAccessor(indices);
    file.addRoot({{"mesh", file.addMesh(primitive)}});
    const Scene scene = load(file);
    ASSERT_EQ(scene.triangleCount(), 1u) << indices.size();
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u) << indices.size();
    EXPECT_EQ(scene.origin, glm::dvec3(0.5, 0.5, 0)) << indices.size();
  }
}

TEST_F(GltfLoader, WarnsWhenTheFilesOwnFloatsAreCoarse) {
  for (const float offset : {100.0f, 1e5f}) {
    GltfBuilder file;
    file.addRoot({{"mesh", file.addMesh(file.primitive({{offset, 0, 0}, {offset + 1, 0, 0}, {offset, 1, 0}}))}});
    EXPECT_EQ(load(file).warnings.size(), offset > 1e4f ? 1u : 0u);
  }
}

TEST_F(GltfLoader, SkipsAndCountsDegenerateTriangles) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  GltfBuilder file;
  auto primitive = file.primitive({{0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},  // sound
                                   {0, 0, 0},
                                   {1, 1, 1},
                                   {2, 2, 2},  // a line
                                   {1, 1, 1},
                                   {1, 1, 1},
                                   {0, 1, 0},  // two corners alike
                                   {nan, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},  // not a number
                                   {0, 0, 0},
                                   {1, inf, 0},
                                   {0, 1, 0},  // infinite
                                   {0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, -inf}});
  // Lights are no other triangles.
  primitive["material"] = file.add("materials", {{"emissiveFactor", {1, 1, 1}}});
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_EQ(scene.counts.degenerateTriangles, 5u);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("5 triangles")));
  EXPECT_EQ(Lights(scene).size(), 1u);
  EXPECT_TRUE(isFinite(scene.bounds.lower) && isFinite(scene.bounds.upper));
}

TEST_F(GltfLoader, TinyTrianglesAreNotDegenerate) {
  for (const float scale : {1e-18f, 1e-6f, 1e6f, 1e18f}) {
    GltfBuilder file;
    file.addRoot({{"mesh", file.addMesh(file.primitive({{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}}))}});
    EXPECT_EQ(load(file).triangleCount(), 1u) << scale;
  }
}

TEST_F(GltfLoader, ShowsOnlyTheActiveScene) {
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}});
  const std::size_t other = file.add("nodes", {{"mesh", 0}});
  file.json["scenes"].push_back({{"nodes", {other, file.add("nodes", {{"mesh", 0}})}}});
  EXPECT_EQ(load(file).triangleCount(), 1u);
  file.json["scene"] = 1;
  EXPECT_EQ(load(file).triangleCount(), 2u);
  file.json.erase("scene");
  EXPECT_EQ(load(file).triangleCount(), 1u);
}

TEST_F(GltfLoader, ShowsAllNodesOfAFileWithoutScenes) {
  GltfBuilder file;
  const std::size_t mesh = file.addTriangle();
  const std::size_t child = file.add("nodes", {{"mesh", mesh}});
  file.add("nodes", {{"mesh", mesh}, {"translation", {0, 0, 1}}, {"children", {child}}});
  file.json.erase("scenes");
  file.json.erase("scene");
  const Scene scene = load(file);
  EXPECT_EQ(scene.triangleCount(), 2u) << "each once";
  EXPECT_EQ(scene.bounds.upper.z - scene.bounds.lower.z, 0) << "the child is placed by its parent";
}

TEST_F(GltfLoader, ReadsMatricesWhoseLastRowIsRounded) {
  const auto rowsOf = [](double corner) {
    return GltfBuilder::Json{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1e-8, 5, 0, 0, corner};
  };
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}, {"matrix", rowsOf(0.99999994)}});
  EXPECT_EQ(load(file).origin.x, 5.5);
  file.json["nodes"][0]["matrix"] = rowsOf(0.999);
  EXPECT_THAT(refusalOf([&] { load(file); }), HasSubstr("nodes[0]"));
}

TEST_F(GltfLoader, PlacesCamerasWithOrthonormalAxesAndNamesOfTheirOwn) {
  GltfBuilder file;
  file.add("cameras", {{"type", "perspective"}, {"name", "lens"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  file.add("cameras",
           {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"zfar", 10}, {"znear", 0.1}}}});
  file.addRoot({{"camera", 0}, {"name", "eye"}, {"scale", {-2, 3, 4}}, {"translation", {1, 2, 3}}});
  file.addRoot({{"camera", 0}, {"name", "eye"}});
  file.addRoot({{"camera", 1}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.cameras.size(), 3u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[1].name, "eye.2");
  EXPECT_EQ(scene.cameras[2].name, "camera");
  expectNear(scene.cameras[0].position, {1, 2, 3});
  expectNear(scene.cameras[0].right, {1, 0, 0});  // a mirrored node does not mirror the picture
  EXPECT_FLOAT_EQ(scene.cameras[0].halfHeight, std::tan(0.25f));
  EXPECT_TRUE(scene.cameras[2].orthographic);
  EXPECT_EQ(scene.cameras[2].halfHeight, 2);
  expectNear(scene.cameras[2].back, {1, 0, 0});
}

TEST_F(GltfLoader, ReadsBuffersAndImagesBesideTheFile) {
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}});
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  test::writeFile(folder / "the data.bin", std::as_bytes(std::span(positions)));
  file.json["buffers"] = {{{"byteLength", 36}, {"uri", "the%20data.bin"}}};
  EXPECT_EQ(loadScene(file.writeGltf(folder / "test.gltf")).triangleCount(), 1u);
}

TEST_F(GltfLoader, IgnoresSkinsMorphTargetsAndAnimationsWithOneWarning) {
  GltfBuilder file;
  const std::size_t mesh = file.addTriangle();
  file.addRoot({{"mesh", mesh}, {"skin", 0}});
  file.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", 0}}};
  file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  const Scene scene = load(file);
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("skins, animations and morph targets are ignored")));
}

TEST_F(GltfLoader, OriginIsTheMiddleOfAllInstancesHoweverThreadsShareThem) {
  GltfBuilder file;
  const std::size_t mesh = file.addTriangle();
  constexpr int kCount = 20'000;  // of which several threads take their share
  for (int i = 0; i < kCount; ++i) file.addRoot({{"mesh", mesh}, {"translation", {i, -i, 0}}});
  EXPECT_EQ(load(file).origin, glm::dvec3(0.5 * kCount, 0.5 * (2 - kCount), 0));
}

TEST_F(GltfLoader, SkinsMayLeaveOutTheirInverseBindMatrices) {
  GltfBuilder file;
  file.addRoot({{"mesh", file.addTriangle()}, {"skin", 0}});
  file.json["skins"] = {{{"joints", {0}}}, {{"joints", {0}}}};
  EXPECT_THAT(load(file).warnings, testing::ElementsAre(HasSubstr("skins, animations and morph targets are ignored")));
}

TEST_F(GltfLoader, WarnsOnceOfEachExtensionThatIsUsedAndUnknown) {
  GltfBuilder file;
  file.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_sheen", "KHR_materials_ior"};
  EXPECT_THAT(load(file).warnings, testing::ElementsAre(HasSubstr("KHR_materials_sheen")));
}

TEST_F(GltfLoader, ReadsTheEnvironmentOutOfTheFile) {
  GltfBuilder file;
  const std::string pfm = "PF\n2 1\n-1.0\n";
  const std::vector<float> texels{1, 2, 3, 4, 5, 6};
  std::vector<std::byte> bytes(reinterpret_cast<const std::byte*>(pfm.data()),
                               reinterpret_cast<const std::byte*>(pfm.data() + pfm.size()));
  const auto raw = std::as_bytes(std::span(texels));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
  file.json["extensions"]["CELLCUT_environment"] = {{"bufferView", file.addBufferView(bytes)}};
  file.json["extensionsUsed"] = {"CELLCUT_environment"};
  const Scene scene = load(file);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->radiance.at(1, 0), Vec3(4, 5, 6));
  EXPECT_TRUE(scene.warnings.empty());
}

}  // namespace
}  // namespace cellcut::test
