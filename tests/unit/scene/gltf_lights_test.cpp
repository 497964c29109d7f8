#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"
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

class GltfLights : public testing::Test {
 protected:
  Scene load(const GltfBuilder& file, double scale = 1) {
    return loadScene(file.writeGlb(folder / "test.glb"), {.punctualScale = scale});
  }
  /// A scene whose only light is this.
  Scene loadLight(const Json& light, Json node = Json::object(), double scale = 1) {
    GltfBuilder file;
    node["extensions"] = file.addLight(light);
    file.addRoot(node);
    return load(file, scale);
  }
  std::string refusalOf(const Json& light) {
    return test::refusalOf([&] { loadLight(light); });
  }
  test::TemporaryDirectory folder;
};

TEST_F(GltfLights, PointLightsHaveColorTimesIntensityWhateverTheirNodesScale) {
  const Scene scene = loadLight({{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}},
                                {{"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}});
  ASSERT_EQ(scene.pointLights.size(), 1u);
  EXPECT_EQ(scene.pointLights[0].intensity, Vec3(8, 4, 2));
  EXPECT_EQ(glm::dvec3(scene.pointLights[0].position) + scene.origin, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(scene.bounds.empty());
}

TEST_F(GltfLights, ShineAlongMinusZOfTheirNode) {
  // A quarter about +y turns −z into −x.
  const Json turned = {{"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}, {"scale", {2, 2, 2}}};
  const Scene sun = loadLight({{"type", "directional"}, {"intensity", 3}}, turned);
  ASSERT_EQ(sun.directionalLights.size(), 1u);
  EXPECT_LT(glm::length(sun.directionalLights[0].axis - Vec3(-1, 0, 0)), kRounding);
  EXPECT_EQ(sun.directionalLights[0].irradiance, Vec3(3));
  const Scene spot = loadLight({{"type", "spot"}, {"spot", Json::object()}}, turned);
  ASSERT_EQ(spot.spotLights.size(), 1u);
  EXPECT_LT(glm::length(spot.spotLights[0].axis - Vec3(-1, 0, 0)), kRounding);
}

TEST_F(GltfLights, SpotConesComeFromTheFileOrTheSpecification) {
  const Scene own = loadLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}});
  EXPECT_NEAR(own.spotLights[0].cosInner, std::cos(0.2), kRounding);
  EXPECT_NEAR(own.spotLights[0].cosOuter, std::cos(0.6), kRounding);
  const Scene standard = loadLight({{"type", "spot"}, {"spot", Json::object()}});
  EXPECT_EQ(standard.spotLights[0].cosInner, 1);
  EXPECT_NEAR(standard.spotLights[0].cosOuter, std::cos(std::numbers::pi / 4), kRounding);
}

TEST_F(GltfLights, SpotConesAreClampedToWhereTheFalloffIsDefined) {
  for (const auto& [inner, outer, warnings] :
       {std::tuple(0.5, 0.5, 1u), std::tuple(0.9, 0.5, 1u), std::tuple(0.1, 2.0, 1u), std::tuple(0.0, 1e-6, 0u),
        std::tuple(0.0, std::numbers::pi / 2, 0u)}) {
    const Scene scene = loadLight({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}});
    EXPECT_LT(scene.spotLights[0].cosOuter, scene.spotLights[0].cosInner);
    EXPECT_GE(scene.spotLights[0].cosOuter, 0);
    EXPECT_LE(scene.spotLights[0].cosInner, 1);
    EXPECT_EQ(scene.warnings.size(), warnings) << inner << ' ' << outer;
  }
  EXPECT_THAT(refusalOf({{"type", "spot"}, {"name", "dark"}, {"spot", {{"outerConeAngle", 0}}}}), HasSubstr("dark"));
  EXPECT_THAT(refusalOf({{"type", "spot"}, {"spot", {{"innerConeAngle", -1}}}}), HasSubstr("negative"));
}

TEST_F(GltfLights, RefusesPowersThatAreNoneByTheLightsName) {
  EXPECT_THAT(refusalOf({{"type", "point"}, {"name", "lamp 7"}, {"intensity", -1}}), HasSubstr("lamp 7"));
  EXPECT_THAT(refusalOf({{"type", "directional"}, {"name", "sun"}, {"color", {1, -0.1, 1}}}), HasSubstr("sun"));
  EXPECT_THAT(refusalOf({{"type", "point"}, {"name", "nova"}, {"intensity", 1e39}}), HasSubstr("nova"));
  EXPECT_THAT(refusalOf({{"type", "point"}, {"color", {1, 1}}}), HasSubstr("3 numbers"));
  EXPECT_THAT(refusalOf({{"type", "laser"}, {"name", "beam"}}), HasSubstr("beam"));
}

TEST_F(GltfLights, RefusesALightThatDoesNotExist) {
  GltfBuilder file;
  file.addLight({{"type", "point"}});
  file.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  EXPECT_THROW(load(file), InputError);
}

TEST_F(GltfLights, ThatAreSwitchedOffAreLeftOut) {
  for (const char* type : {"point", "spot", "directional"}) {
    for (Json off : {Json{{"type", type}, {"intensity", 0}}, Json{{"type", type}, {"color", {0, 0, 0}}}}) {
      if (off["type"] == "spot") off["spot"] = Json::object();
      const Scene scene = loadLight(off);
      EXPECT_EQ(scene.pointLights.size() + scene.spotLights.size() + scene.directionalLights.size(), 0u) << off;
    }
  }
  EXPECT_EQ(loadLight({{"type", "point"}, {"intensity", 1e-45}}).pointLights.size(), 1u);
}

TEST_F(GltfLights, WarnOfARangeThatTheyDoNotKeep) {
  EXPECT_THAT(loadLight({{"type", "point"}, {"range", 2}}).warnings, testing::ElementsAre(HasSubstr("range")));
  EXPECT_THAT(loadLight({{"type", "point"}}).warnings, testing::IsEmpty());
}

TEST_F(GltfLights, KeepTinyAndHugePowers) {
  EXPECT_EQ(loadLight({{"type", "point"}, {"intensity", 1e-30}}).pointLights[0].intensity, Vec3(1e-30f));
  EXPECT_EQ(loadLight({{"type", "point"}, {"intensity", 1e30}}).pointLights[0].intensity, Vec3(1e30f));
}

TEST_F(GltfLights, PunctualScaleMultipliesLightsAndNotEmitters) {
  GltfBuilder file;
  file.add("materials", {{"emissiveFactor", {1, 1, 1}}});
  Json primitive = file.primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  primitive["material"] = 0;
  file.addRoot({{"mesh", file.addMesh(primitive)}});
  file.addRoot({{"extensions", file.addLight({{"type", "point"}, {"intensity", 6}})}});
  file.addRoot({{"extensions", file.addLight({{"type", "directional"}, {"intensity", 4}})}});
  const Scene scene = load(file, 0.5);
  EXPECT_EQ(scene.pointLights[0].intensity, Vec3(3));
  EXPECT_EQ(scene.directionalLights[0].irradiance, Vec3(2));
  EXPECT_EQ(scene.materials[0].emission, Vec3(1));
  EXPECT_THROW(load(file, -1), InputError);
  EXPECT_THROW(load(file, std::numeric_limits<double>::quiet_NaN()), InputError);
}

TEST_F(GltfLights, SaysThatBlenderWritesLumensUntilAScaleIsGiven) {
  GltfBuilder file;
  file.json["asset"]["generator"] = "Khronos glTF Blender I/O v4.3.47";
  EXPECT_TRUE(load(file).warnings.empty());  // nothing to scale
  file.addRoot({{"extensions", file.addLight({{"type", "point"}})}});
  EXPECT_THAT(load(file).warnings, testing::ElementsAre(HasSubstr("--punctual-scale blender")));
  EXPECT_TRUE(load(file, 1.0 / 683).warnings.empty());
}

}  // namespace
}  // namespace cellcut::test
