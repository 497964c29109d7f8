#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/material.h"
#include "renderer/scene/texture.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/vectors.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using test::GltfBuilder;
using Json = nlohmann::json;
using testing::HasSubstr;

class GltfMaterials : public testing::Test {
 protected:
  Scene load(const GltfBuilder& file) { return loadScene(file.writeGlb(folder / "test.glb")); }
  Scene loadMaterial(const Json& material) {
    GltfBuilder file;
    file.add("materials", material);
    return load(file);
  }
  /// A file with one 2×2 PNG as image 0 and texture 0.
  static GltfBuilder withTexture() {
    GltfBuilder file;
    ImageRgba8 picture(2, 2, {1, 2, 3, 4});
    const std::size_t view = file.addBufferView(encodePng(picture));
    file.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    return file;
  }
  test::TemporaryDirectory folder;
};

TEST_F(GltfMaterials, ReadsAllFactors) {
  const Scene scene =
      loadMaterial({{"name", "m"},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
                    {"emissiveFactor", {0.25, 0.5, 1}},
                    {"alphaMode", "MASK"},
                    {"alphaCutoff", 0.75},
                    {"doubleSided", true},
                    {"extensions",
                     {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
                      {"KHR_materials_specular", {{"specularFactor", 0.7}, {"specularColorFactor", {2, 1, 0.5}}}},
                      {"KHR_materials_ior", {{"ior", 1.8}}}}}});
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.baseColor, Vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.emission, Vec3(2, 4, 8));
  EXPECT_EQ(m.alphaMode, AlphaMode::kMask);
  EXPECT_EQ(m.alphaCutoff, 0.75f);
  EXPECT_TRUE(m.doubleSided);
  EXPECT_EQ(m.specular, 0.7f);
  EXPECT_EQ(m.specularColor, Vec3(2, 1, 0.5f));
  EXPECT_EQ(m.ior, 1.8f);
  EXPECT_FALSE(m.unlit);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfMaterials, DefaultsAreThoseOfTheSpecification) {
  const Material m = loadMaterial(Json::object()).materials[0];
  EXPECT_EQ(m.baseColor, Vec4(1));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emission, Vec3(0));
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.alphaMode, AlphaMode::kOpaque);
  EXPECT_EQ(m.alphaCutoff, 0.5f);
  EXPECT_FALSE(m.doubleSided);
}

TEST_F(GltfMaterials, UnlitIsKnownByItsEmptyExtension) {
  EXPECT_TRUE(loadMaterial({{"extensions", {{"KHR_materials_unlit", Json::object()}}}}).materials[0].unlit);
}

TEST_F(GltfMaterials, ClampsFactorsOutOfRangeWithAWarning) {
  const Scene scene =
      loadMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {2, -1, 0, 1}}, {"roughnessFactor", 7}}},
                    {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}});
  EXPECT_EQ(scene.materials[0].baseColor, Vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.materials[0].roughness, 1);
  EXPECT_EQ(scene.materials[0].ior, 1);
  EXPECT_EQ(scene.warnings.size(), 3u);
}

TEST_F(GltfMaterials, RefusesEmissionThatIsNoneByName) {
  const auto refusal = [&](const Json& material) -> std::string {
    return test::refusalOf([&] { loadMaterial(material); });
  };
  const auto strength = [](double s) -> Json {
    return {{"KHR_materials_emissive_strength", {{"emissiveStrength", s}}}};
  };
  EXPECT_THAT(refusal({{"name", "anti"}, {"emissiveFactor", {1, 1, 1}}, {"extensions", strength(-2)}}),
              HasSubstr("anti"));
  EXPECT_THAT(refusal({{"name", "anti"}, {"emissiveFactor", {-1, 1, 1}}}), HasSubstr("anti"));
  EXPECT_THAT(refusal({{"name", "nova"}, {"emissiveFactor", {1, 1, 1}}, {"extensions", strength(1e39)}}),
              HasSubstr("nova"));
}

TEST_F(GltfMaterials, DecodesEachPictureOnceAndOnlyThoseInUse) {
  GltfBuilder file = withTexture();
  file.add("images",
           {{"bufferView", file.addBufferView(std::as_bytes(std::span("no picture")))}, {"mimeType", "image/png"}});
  file.add("textures", {{"source", 1}});
  file.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  file.add("materials", {{"emissiveTexture", {{"index", 0}}}, {"normalTexture", {{"index", 2}, {"scale", 0.5}}}});
  const Scene scene = load(file);
  EXPECT_EQ(scene.texels.size(), 1u);
  EXPECT_EQ(scene.texels[0].at(0, 0), (glm::vec<4, std::uint8_t>(1, 2, 3, 4)));
  ASSERT_EQ(scene.textures.size(), 2u);
  const Texture& emission = scene.textures[indexOf(*scene.materials[0].slot(TextureUse::kEmission).texture)];
  const Texture& normal = scene.textures[indexOf(*scene.materials[0].slot(TextureUse::kNormal).texture)];
  EXPECT_EQ(emission.wrapS, Wrap::kRepeat);
  EXPECT_FALSE(emission.nearest);
  EXPECT_EQ(normal.wrapS, Wrap::kClamp);
  EXPECT_EQ(normal.wrapT, Wrap::kMirror);
  EXPECT_TRUE(normal.nearest);
  EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
}

TEST_F(GltfMaterials, RefusesAPictureThatCannotBeDecoded) {
  GltfBuilder file = withTexture();
  file.json["bufferViews"][0]["byteLength"] = 40;
  file.add("materials", {{"emissiveTexture", {{"index", 0}}}});
  EXPECT_THROW(load(file), InputError);
}

TEST_F(GltfMaterials, TextureTransformsScaleThenTurnThenShift) {
  GltfBuilder file = withTexture();
  const double quarter = std::numbers::pi / 2;
  file.add("materials", {{"emissiveTexture",
                          {{"index", 0},
                           {"extensions",
                            {{"KHR_texture_transform",
                              {{"offset", {10, 20}}, {"rotation", quarter}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}}});
  const TextureSlot slot = load(file).materials[0].slot(TextureUse::kEmission);
  EXPECT_EQ(slot.texCoord, 1);
  // Counter-clockwise as seen, with v down: u goes up to −v, v goes to +u.
  const Vec2 u = slotUv(slot, {1, 0}), v = slotUv(slot, {0, 1});
  EXPECT_NEAR(u.x, 10, kRounding);
  EXPECT_NEAR(u.y, 18, 2 * kRounding);
  EXPECT_NEAR(v.x, 13, 2 * kRounding);
  EXPECT_NEAR(v.y, 20, 2 * kRounding);
}

TEST_F(GltfMaterials, MissingTextureCoordinatesAreZero) {
  GltfBuilder file = withTexture();
  file.add("materials", {{"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}});
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["material"] = 0;
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  EXPECT_TRUE(scene.meshes[0].texCoords[0].empty());
  EXPECT_EQ(scene.meshes[0].texCoords[1], std::vector<Vec2>(3, Vec2(0)));
}

/// A quad in the plane z = 0 whose picture is upright, with a normal map, under a node with this scale.
GltfBuilder normalMappedQuad(GltfBuilder file, const Json& scale, bool withTangents) {
  file.add("materials", {{"normalTexture", {{"index", 0}}}});
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  primitive["indices"] = file.addAccessor(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
  primitive["attributes"]["TEXCOORD_0"] = file.addAccessor(std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
  if (withTangents) primitive["attributes"]["TANGENT"] = file.addAccessor(std::vector<glm::vec4>(4, {1, 0, 0, 1}));
  primitive["material"] = 0;
  file.addRoot({{"mesh", file.addMesh(primitive)}, {"scale", scale}});
  return file;
}

TEST_F(GltfMaterials, ComputedTangentsAreTheFilesOwnEvenWhenMirrored) {
  for (const Json& scale : {Json{1, 1, 1}, Json{-1, 1, 1}, Json{1, -2, 1}, Json{1, 1, -1}}) {
    const Scene given = load(normalMappedQuad(withTexture(), scale, true));
    const Scene computed = load(normalMappedQuad(withTexture(), scale, false));
    const Vec3 s{scale[0], scale[1], scale[2]};
    for (const Scene* scene : {&given, &computed}) {
      const Mesh& mesh = scene->meshes[0];
      ASSERT_EQ(mesh.tangents.size(), 4u);
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 tangent(mesh.tangents[i]);
        EXPECT_LT(glm::length(tangent - glm::normalize(s * Vec3(1, 0, 0))), kRounding) << scale;
        // The top of the picture is where +y went.
        const Vec3 bitangent = glm::cross(mesh.normals[i], tangent) * mesh.tangents[i].w;
        EXPECT_LT(glm::length(bitangent - glm::normalize(s * Vec3(0, 1, 0))), kRounding) << scale;
      }
    }
  }
}

TEST_F(GltfMaterials, TangentsOfAMirroredPictureAreNotAveragedWithThoseBesideIt) {
  // Two quads that share the edge x = 1, where u turns around.
  GltfBuilder file = withTexture();
  file.add("materials", {{"normalTexture", {{"index", 0}}}});
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}});
  primitive["indices"] = file.addAccessor(std::vector<std::uint32_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4});
  primitive["attributes"]["NORMAL"] = file.addAccessor(std::vector<glm::vec3>(6, glm::vec3(0, 0, 1)));
  primitive["attributes"]["TEXCOORD_0"] =
      file.addAccessor(std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}});
  primitive["material"] = 0;
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  const Scene scene = load(file);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 8u);
  for (std::size_t i = 0; i < 4; ++i) {
    const float side = i < 2 ? 1.0f : -1.0f;
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_LT(glm::length(mesh.tangents[mesh.triangles[i][corner]] - Vec4(side, 0, 0, side)), kRounding) << i;
  }
}

TEST_F(GltfMaterials, NormalMapsBendFlatFacesAsTheyBendSmoothOnes) {
  for (const Json& scale : {Json{1, 1, 1}, Json{-1, 1, 1}}) {
    GltfBuilder smooth = normalMappedQuad(withTexture(), scale, false), flat = smooth;
    flat.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const Scene smoothScene = load(smooth), flatScene = load(flat);
    for (const Vec3& towardsViewer : {Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
      for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
        const auto normalOf = [&](const Scene& scene) {
          return shadingNormal(scene, {&scene.meshes[0], triangle, Vec2(0.25f)}, towardsViewer);
        };
        EXPECT_LT(glm::length(normalOf(flatScene) - normalOf(smoothScene)), kRounding) << scale;
        EXPECT_GT(glm::length(normalOf(flatScene) - towardsViewer), 0.1f) << scale;  // the map is one that bends
      }
    }
  }
}

TEST_F(GltfMaterials, TangentsOfADegenerateMappingAreValid) {
  GltfBuilder file = normalMappedQuad(withTexture(), {1, 1, 1}, false);
  file.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const Scene scene = load(file);
  for (const Vec4& tangent : scene.meshes[0].tangents) {
    EXPECT_NEAR(glm::length(Vec3(tangent)), 1, kRounding);
    EXPECT_NEAR(tangent.z, 0, kRounding);
    EXPECT_EQ(std::abs(tangent.w), 1);
  }
}

}  // namespace
}  // namespace cellcut::test
