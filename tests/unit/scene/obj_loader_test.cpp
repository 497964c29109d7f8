#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/vectors.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

class ObjLoader : public testing::Test {
 protected:
  Scene load(const std::string& text) { return loadScene(test::writeFile(folder / "test.obj", text)); }
  std::string refusalOf(const std::string& text) {
    return test::refusalOf([&] { load(text); });
  }
  test::TemporaryDirectory folder;
};

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(ObjLoader, ReadsPolygonsAndBothKindsOfIndices) {
  const Scene scene = load("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -4 -3 -2\n");
  EXPECT_EQ(scene.triangleCount(), 3u);
  for (const Triangle& t : scene.meshes[0].triangles) {
    const auto& p = scene.meshes[0].positions;
    EXPECT_GT(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z, 0);
  }
  EXPECT_TRUE(scene.meshes[0].normals.empty());
}

TEST_F(ObjLoader, RefusesIndicesThatDoNotExist) {
  const struct {
    const char* face;
    const char* refusal;
  } faces[] = {{"f 1 2 4", "vertex 4 does not exist; export"},
               {"f 1 2 0", "vertex 0 does not exist; OBJ counts from 1"},
               {"f -1 -2 -4", "vertex -4 does not exist; export"},
               {"f 1 2 99999999999", "does not exist; export"},  // what is left of the number is the parser's matter
               {"f 1/1 2/1 3/1", "texture coordinate 1 does not exist; export"},
               {"f 1//2 2//1 3//1", "normal 2 does not exist; export"},
               {"f a b c", "vertex 0 does not exist; OBJ counts from 1"},
               {"f 1 2 3 4 5 6 7", "vertex 4 does not exist; export"}};
  for (const auto& [face, refusal] : faces) {
    // The face before it is sound.
    EXPECT_THAT(refusalOf(kTriangle + "f 1 2 3\n" + face + "\n"),
                testing::AllOf(testing::StartsWith("test.obj: face 2: "), HasSubstr(refusal)))
        << face;
  }
}

TEST_F(ObjLoader, RefusesFacesOfThousandsOfCorners) {
  std::string face = "f";
  for (int i = 0; i < 5000; ++i) face += " 1";
  EXPECT_EQ(refusalOf(kTriangle + face + "\n"), "test.obj: face 1: has more than 4096 corners; cut it up");
}

/// 4096 vertices, and one face of all of them.
std::string vertices(const std::function<glm::dvec2(double)>& at) {
  std::string text;
  for (int i = 0; i < 4096; ++i) {
    const glm::dvec2 p = at(i / 4096.0);
    text += "v " + std::to_string(p.x) + ' ' + std::to_string(p.y) + " 0\n";
  }
  return text;
}
std::string faceOfAll() {
  std::string text = "f";
  for (int i = 1; i <= 4096; ++i) text += ' ' + std::to_string(i);
  return text + '\n';
}
std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST_F(ObjLoader, DiscsOfThousandsOfCornersLoad) {
  const std::string disc = vertices([](double part) {
    const double angle = 2 * kPi * part;
    return glm::dvec2(std::cos(angle), std::sin(angle));
  });
  const test::HostileBudget budget("discs");
  EXPECT_EQ(load(disc + repeated(faceOfAll(), 20)).triangleCount(), 20u * 4094);
}

TEST_F(ObjLoader, RefusesFacesThatTakeTooLongToCutUp) {
  // A line and back takes the square of its corners.
  const std::string line = vertices([](double part) { return glm::dvec2(part, 0); });
  const test::HostileBudget budget("lines");
  EXPECT_EQ(refusalOf(line + faceOfAll()), "was not refused");
  EXPECT_THAT(refusalOf(line + repeated(faceOfAll(), 20)),
              testing::AllOf(testing::StartsWith("test.obj: face "), HasSubstr("too long to cut up; make triangles")));
}

TEST_F(ObjLoader, ReadsMaterialsRoughly) {
  test::writeFile(folder / "m.mtl",
                  "newmtl wood\nKd 0.5 0.25 0.125\nKs 0 0 0\nmap_Kd maps\\wood.png\n"
                  "newmtl lamp\nKd 0 0 0\nKe 10 20 30\n"
                  "newmtl glaze\nKd 1 1 1\nKs 0.5 0.5 0.5\nNs 98\nd 0.5\n");
  std::filesystem::create_directory(folder / "maps");
  test::writeFile(folder / "maps/wood.png", encodePng(ImageRgba8(2, 2, {9, 8, 7, 255})));
  const Scene scene =
      load("mtllib m.mtl\n" + kTriangle +
           "vt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\nusemtl lamp\nf 1 2 3\nusemtl glaze\nf 1 2 3\n");
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_TRUE(scene.warnings.empty());
  const Material& wood = scene.materials[0];
  EXPECT_EQ(wood.baseColor, Vec4(0.5f, 0.25f, 0.125f, 1));
  EXPECT_EQ(wood.specular, 0);
  EXPECT_EQ(wood.roughness, 1);
  EXPECT_TRUE(wood.doubleSided);
  ASSERT_TRUE(wood.slot(TextureUse::kBaseColor).texture);
  EXPECT_EQ(scene.texels.at(0).at(0, 0), (glm::vec<4, std::uint8_t>(9, 8, 7, 255)));
  const Material& lamp = scene.materials[1];
  EXPECT_EQ(lamp.emission, Vec3(10, 20, 30));
  EXPECT_FALSE(lamp.doubleSided);
  const Material& glaze = scene.materials[2];
  EXPECT_EQ(glaze.specular, 0.5f);
  EXPECT_NEAR(glaze.roughness, std::sqrt(std::sqrt(0.02f)), kRounding);
  EXPECT_EQ(glaze.alphaMode, AlphaMode::kBlend);
  EXPECT_EQ(glaze.baseColor.w, 0.5f);
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[0].texCoords[0][0], Vec2(0, 1));  // OBJ counts v from the bottom
}

TEST_F(ObjLoader, MissingLibrariesPicturesAndMaterialsAreWarnings) {
  test::writeFile(folder / "m.mtl", "newmtl a\nmap_Kd gone.png\n");
  const Scene scene = load("mtllib gone.mtl\nmtllib m.mtl\n" + kTriangle + "usemtl b\nf 1 2 3\n");
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_THAT(scene.warnings,
              testing::UnorderedElementsAre(HasSubstr("gone.mtl"), HasSubstr("gone.png"), HasSubstr("material b")));
}

/// A lamp of Ke 5, under a name that has blanks.
const std::string kLamp = "newmtl a lamp\nKe 5 5 5\n";

TEST_F(ObjLoader, FindsLibrariesAndMaterialsHoweverTheyAreNamed) {
  test::writeFile(folder / "m.mtl", kLamp);
  test::writeFile(folder / "my lamps.mtl", kLamp);
  test::writeFile(folder / "other.mtl", "newmtl other\nnewmtl a lamp\nKe 1 1 1\n");
  std::string many;
  for (int i = 0; i < 60; ++i) many += " gone" + std::to_string(i) + ".mtl";
  const std::string use = kTriangle + "usemtl a lamp\nf 1 2 3\n";
  for (const std::string& text : {
           "mtllib m.mtl\n" + use,
           "mtllib   my lamps.mtl \n" + use,
           "mtllib \"my lamps.mtl\"\n" + use,
           "mtllib m.mtl other.mtl\n" + use,
           "mtllib gone.mtl m.mtl\n" + use,
           std::string("mtllib").append(many).append(" m.mtl\n") + use,
           "\xEF\xBB\xBFmtllib m.mtl\n" + use,
           "mtllib m.mtl\nmtllib m.mtl\nmtllib other.mtl\n" + use,
           "mtllib m.mtl\n" + kTriangle + "usemtl  a lamp \nf 1 2 3\n",
           use + "mtllib m.mtl\n",
       }) {
    const Scene scene = load(text);
    EXPECT_EQ(scene.materials.at(indexOf(scene.meshes.at(0).material)).emission, Vec3(5)) << text;
  }
}

TEST_F(ObjLoader, RefusesThousandsOfLibraries) {
  std::string text = kTriangle;
  for (int i = 0; i < 20'000; ++i) text += "mtllib a.mtl b" + std::to_string(i) + ".mtl\n";
  const test::HostileBudget budget("libraries");
  EXPECT_EQ(refusalOf(text), "test.obj: names more than 1000 material libraries; join them");
}

TEST_F(ObjLoader, JoinsContinuedLinesAndSkipsComments) {
  const Scene plain = load("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  for (const char* text : {
           "v 0 0 0\nv 1 \\\n0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\r\n3 4\n",
           "v 0 0 0 # a\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 # 7 8\n",
           "# D:\\models\\\nv 0 0 0 # of D:\\\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\\",
       }) {
    const Scene scene = load(text);
    ASSERT_EQ(scene.triangleCount(), 2u) << text;
    EXPECT_TRUE(std::equal(scene.meshes[0].positions.begin(), scene.meshes[0].positions.end(),
                           plain.meshes[0].positions.begin(), plain.meshes[0].positions.end()))
        << text;
  }
}

TEST_F(ObjLoader, OneNumberOfAColorStandsForThree) {
  test::writeFile(folder / "m.mtl", "newmtl a\nKd 0.5 # C:\\\nKe 3\n");
  const Material material = load("mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n").materials.at(0);
  EXPECT_EQ(material.baseColor, Vec4(0.5f, 0.5f, 0.5f, 1));
  EXPECT_EQ(material.emission, Vec3(3));
}

TEST_F(ObjLoader, MaterialsWithoutKdAreGreyOrWhollyTheirPicture) {
  test::writeFile(folder / "t.png", encodePng(ImageRgba8(2, 2, {9, 8, 7, 255})));
  test::writeFile(folder / "m.mtl",
                  "newmtl a\nd -halo 0.5\nnewmtl b\nmap_Kd t.png\nnewmtl c\nmap_Kd t.png\nKd 0 0 0\n");
  const Scene scene = load("mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
  EXPECT_EQ(scene.materials.at(0).baseColor, Vec4(0.8f, 0.8f, 0.8f, 1));
  EXPECT_EQ(scene.materials.at(1).baseColor, Vec4(1));
  EXPECT_EQ(scene.materials.at(2).baseColor, Vec4(0, 0, 0, 1));
}

TEST_F(ObjLoader, PicturesThatAreDamagedAreShownWithAWarning) {
  std::string jpeg{"\xff\xd8\xff\xdb\0\x43\0", 7};
  jpeg += std::string(64, '\1') + std::string("\xff\xc0\0\xb\x8\0\x8\0\x8\1\1\x11\0", 13);
  test::writeFile(folder / "t.jpg", jpeg + std::string("\xff\xda\0\x8\1\1\0\0\x3f\0", 10));
  test::writeFile(folder / "m.mtl", "newmtl a\nmap_Kd t.jpg\n");
  const Scene scene = load("mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "t.jpg is damaged and may show in parts only: Premature end of JPEG file");
  EXPECT_EQ(scene.texels.at(0).at(7, 7), ImageRgba8::value_type(128, 128, 128, 255));
}

TEST_F(ObjLoader, PicturesAreScaledAndMovedAndLieBesideTheirLibrary) {
  std::filesystem::create_directory(folder / "sub");
  test::writeFile(folder / "sub/t 1.png", encodePng(ImageRgba8(2, 2, {9, 8, 7, 255})));
  const auto slotWith = [&](const std::string& options) {
    test::writeFile(folder / "sub/m.mtl", "newmtl a\nmap_Kd " + options + " t 1.png\n");
    const Scene scene = load("mtllib sub/m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
    EXPECT_TRUE(scene.warnings.empty()) << options;
    return scene.materials.at(0).slot(TextureUse::kBaseColor);
  };
  for (const char* options : {"-s 2 3 1 -o 0.25 0.5 0", "-s 2 3 -clamp off -o 0.25 0.5"}) {
    const TextureSlot slot = slotWith(options);
    ASSERT_TRUE(slot.texture) << options;
    const Vec2 uv(0.75f, 0.125f);  // v from the bottom, as in the file
    const Vec2 moved = slot.uvLinear * Vec2(uv.x, 1 - uv.y) + slot.uvOffset;
    EXPECT_EQ(Vec2(moved.x, 1 - moved.y), Vec2(2, 3) * uv + Vec2(0.25f, 0.5f)) << options;
  }
  EXPECT_EQ(slotWith("-s 2").uvLinear, glm::mat2(2, 0, 0, 1));
  EXPECT_EQ(slotWith("-o 0.5").uvOffset, Vec2(0.5f, 0));
  EXPECT_THAT(test::refusalOf([&] { slotWith("-s 1e999"); }), HasSubstr("-s and -o must be finite"));
}

TEST_F(ObjLoader, WarnsOfSmoothingGroupsThatItDoesNotRead) {
  EXPECT_THAT(load(kTriangle + "s 1\nf 1 2 3\n").warnings, testing::ElementsAre(HasSubstr("smoothing groups")));
  EXPECT_THAT(load(kTriangle + "s off\nf 1 2 3\n").warnings, testing::IsEmpty());
  EXPECT_THAT(load(kTriangle + "vn 0 0 1\ns 1\nf 1//1 2//1 3//1\n").warnings, testing::IsEmpty());
}

TEST_F(ObjLoader, RefusesReferencesOutOfTheFolder) {
  EXPECT_THAT(refusalOf("mtllib ../m.mtl\n" + kTriangle), HasSubstr("test.obj: \"../m.mtl\": leads out of"));
  EXPECT_THAT(refusalOf("mtllib /etc/passwd\n" + kTriangle),
              HasSubstr("test.obj: \"/etc/passwd\": is an absolute path"));
  test::writeFile(folder / "m.mtl", "newmtl a\nmap_Ke ..\\secret.png\n");
  EXPECT_THAT(refusalOf("mtllib m.mtl\n" + kTriangle), HasSubstr("test.obj: \"../secret.png\": leads out of"));
}

TEST_F(ObjLoader, KeepsDigitsFarFromTheOrigin) {
  const Scene scene = load("v 1000000.25 0 0\nv 1000001.5 0 0\nv 1000000.25 1.125 0\nf 1 2 3\n");
  EXPECT_EQ(scene.bounds.upper.x - scene.bounds.lower.x, 1.25f);
  EXPECT_EQ(scene.origin.x, 1000000.875);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(ObjLoader, VerticesThatNoFaceUsesDoNotMoveIt) {
  const Scene scene = load(kTriangle + "v 1e30 0 0\nf 1 2 3\n");
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_EQ(scene.origin, glm::dvec3(0.5, 0.5, 0));
}

TEST_F(ObjLoader, ReadsALibraryOnceHoweverItIsWritten) {
  test::writeFile(folder / "m.mtl", "newmtl a\nnewmtl b\n");
  EXPECT_EQ(load("mtllib m.mtl\nmtllib ./m.mtl\nmtllib ././m.mtl\n" + kTriangle + "f 1 2 3\n").materials.size(), 3u)
      << "and the default";
}

TEST_F(ObjLoader, WarningsShowNoControlCharactersAndNoHalfCharacters) {
  const Scene scene = load(kTriangle + "usemtl \x1b[31m" + repeated("ü", 60) + "\nf 1 2 3\n");
  EXPECT_THAT(scene.warnings,
              testing::ElementsAre("material ?[31m" + repeated("ü", 37) + "… is missing; a grey one takes its place"));
}

TEST_F(ObjLoader, NormalsCountOnlyWhereEveryCornerHasOne) {
  const Scene scene = load(kTriangle + "vn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//2\nf 1//1 2 3\n");
  ASSERT_EQ(scene.meshes.size(), 2u);
  const Mesh& smooth = scene.meshes[scene.meshes[0].normals.empty() ? 1 : 0];
  EXPECT_LT(glm::length(smooth.normals[2] - glm::normalize(Vec3(0, 1, 1))), kRounding);
}

TEST_F(ObjLoader, RefusesFilesWithoutVertices) {
  for (const char* text :
       {"", "\n\n", "g\n", "usemtl\nmtllib\n", "f 1 2\n", "\x89PNG\r\n\x1a\n", "Dear diary,\nvery well\n"}) {
    EXPECT_THAT(refusalOf(text), HasSubstr("has no vertices")) << text;
  }
}

TEST_F(ObjLoader, RefusesVerticesThatAreNoNumbersAndWarnsOfOtherSuchLines) {
  for (const std::string line : {"v 1 0 x", "v 1,5 0 0", "v +-5 0 0", "v 1.0f 0 0"})
    EXPECT_THAT(refusalOf(kTriangle + line + "\n"), HasSubstr(line + ": has words that are no numbers"));
  for (const std::string line :
       {"v", "v 1 2", "v nan 0 0", "v 0 -inf 0", "vt", "vt 0,5", "vn 0 1", "vn -1.#IND 0 1", "vn -nan(ind) 0 1"}) {
    EXPECT_THAT(load(kTriangle + line + "\n").warnings, testing::ElementsAre(HasSubstr(line + ": is not read")));
  }
  for (const char* line : {"v +1 -.5 1e400", "vt 1", "v 1 2 3 0.5 0.5 0.5 # grey", "\tvn 0 0 1\t"})
    EXPECT_THAT(load(kTriangle + line + "\n").warnings, testing::IsEmpty()) << line;
}

}  // namespace
}  // namespace cellcut::test
