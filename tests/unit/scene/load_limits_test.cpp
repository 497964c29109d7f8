#include "renderer/base/image_codecs.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

/// Two triangles under two pictures of 16 texels of 4 bytes each.
class LoadLimits : public testing::Test {
 protected:
  LoadLimits() {
    for (const char* name : {"a.png", "b.png"}) {
      test::writeFile(folder / name, encodePng(ImageRgba8(4, 4, {9, 8, 7, 255})));
    }
    // Libraries of their own: the limit is that of the whole scene.
    test::writeFile(folder / "a.mtl", "newmtl a\nmap_Kd a.png\n");
    test::writeFile(folder / "b.mtl", "newmtl b\nmap_Kd b.png\n");
    test::writeFile(folder / "scene.obj",
                    "mtllib a.mtl\nmtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                    "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3/1 2/1 1/1\n");
    const std::string json =
        R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"},{"uri":"b.png"}],
            "textures":[{"source":0},{"source":1}],
            "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
                         {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}}],
            "buffers":[{"byteLength":36,"uri":"corners.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]},
                      {"primitives":[{"attributes":{"POSITION":0},"material":1}]}],
            "nodes":[{"mesh":0},{"mesh":1}],"scenes":[{"nodes":[0,1]}],"scene":0})";
    test::writeFile(folder / "scene.gltf", json);
    constexpr std::array corners{0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f};
    test::writeFile(folder / "corners.bin", std::as_bytes(std::span(corners)));
  }

  std::string refusalOf(const char* file, const cellcut::LoadLimits& limits) const {
    return test::refusalOf([&] { loadScene(folder / file, {.limits = limits}); });
  }

  static constexpr std::array kFiles{"scene.obj", "scene.gltf"};
  test::TemporaryDirectory folder;
};

TEST_F(LoadLimits, LetThroughWhatJustFits) {
  for (const char* file : kFiles) {
    const Scene scene = loadScene(folder / file, {.limits = {.maxTriangles = 2, .maxTextureBytes = 128}});
    EXPECT_EQ(scene.triangleCount(), 2u) << file;
    EXPECT_EQ(scene.texels.size(), 2u) << file;
  }
}

TEST_F(LoadLimits, RefuseOneTriangleMoreAndNameTheOption) {
  for (const char* file : kFiles) EXPECT_THAT(refusalOf(file, {.maxTriangles = 1}), HasSubstr("--max-triangles"));
}

TEST_F(LoadLimits, RefuseOneTexelMoreAndNameTheOption) {
  for (const char* file : kFiles) {
    EXPECT_THAT(refusalOf(file, {.maxTextureBytes = 127}), HasSubstr("--max-texture-bytes"));
  }
}

TEST_F(LoadLimits, HoldForTheEnvironment) {
  test::GltfBuilder builder;
  const std::size_t view = builder.addBufferView(encodePfm(ImageRgb(4, 2, Vec3(1))));
  builder.json["extensions"]["CELLCUT_environment"] = {{"bufferView", view}};
  builder.writeGlb(folder / "sky.glb");
  EXPECT_EQ(refusalOf("sky.glb", {.maxTextureBytes = 96}), "was not refused");
  EXPECT_EQ(refusalOf("sky.glb", {.maxTextureBytes = 95}),
            "sky.glb: CELLCUT_environment: 4 x 2 pixels have 96 bytes decoded, more than 95, the limit "
            "(--max-texture-bytes)");
}

TEST(LoadLimitsByDefault, LetEveryPictureThroughThatIsReadAtAll) {
  EXPECT_GE(cellcut::LoadLimits{}.maxTextureBytes, kMaxImageBytes);
}

}  // namespace
}  // namespace cellcut::test
