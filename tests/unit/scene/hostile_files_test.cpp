/// Scenes and their pictures that are no files, that may not be read, that are too large or gone.
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/restrictions.h"
#include "tests/support/temporary_directory.h"

#include <atomic>
#include <fstream>
#include <sys/stat.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kSceneKinds[] = {".glb", ".gltf", ".obj"};

TEST(HostileBudget, SeesMemoryThatWasGivenBack) {
  const test::HostileBudget budget("nothing");
  constexpr std::size_t kBytes = std::size_t{100} << 20;
  EXPECT_EQ(std::vector<char>(kBytes, 'x').back(), 'x');
  EXPECT_GT(budget.bytes(), kBytes * 9 / 10);
}

class HostileFiles : public testing::Test {
 protected:
  std::string refusalOfScene(const fs::path& file) const {
    const test::HostileBudget budget(file.filename());
    return refusalOf([&] { loadScene(file); });
  }
  fs::path giant(const std::string& name) const {
    test::writeFile(folder / name, "");
    fs::resize_file(folder / name, std::uintmax_t{10} << 30);
    return folder / name;
  }
  /// A triangle whose corners lie in corners.bin and whose picture is color.png.
  fs::path sceneOfThreeFiles() const {
    constexpr std::array corners{0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f};
    test::writeFile(folder / "corners.bin", std::as_bytes(std::span(corners)));
    test::writeFile(folder / "color.png", encodePng(ImageRgba8(4, 4, {9, 8, 7, 255})));
    test::GltfBuilder file;
    file.json["buffers"] = {{{"byteLength", 36}, {"uri", "corners.bin"}}};
    file.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    file.json["images"] = {{{"uri", "color.png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
    file.addRoot({{"mesh", file.addMesh({{"attributes", {{"POSITION", 0}}}, {"material", 0}})}});
    return file.writeGltf(folder / "scene.gltf");
  }
  test::TemporaryDirectory folder;
};

TEST_F(HostileFiles, ScenesOfTenGigabytesAreRefusedByTheirSize) {
  for (const std::string kind : kSceneKinds) {
    EXPECT_THAT(refusalOfScene(giant("a" + kind)), HasSubstr("a" + kind + ": has 10737418240 bytes, more than"));
  }
}

TEST_F(HostileFiles, PicturesOfTenGigabytesAreRefusedByTheirSize) {
  for (const std::string kind : {".exr", ".hdr", ".pfm"}) {
    const fs::path file = giant("a" + kind);
    const test::HostileBudget budget(kind);
    EXPECT_THAT(refusalOf([&] { readImage(file); }), HasSubstr("a" + kind + ": has 10737418240 bytes, more than"));
  }
}

TEST_F(HostileFiles, BuffersAndTexturesOfTenGigabytesAreRefusedByTheirSize) {
  for (const char* name : {"corners.bin", "color.png"}) {
    const fs::path scene = sceneOfThreeFiles();
    giant(name);
    EXPECT_THAT(refusalOfScene(scene),
                testing::AllOf(StartsWith("scene.gltf: "), HasSubstr(std::string(name) + ": has 10737418240 bytes")));
  }
}

TEST_F(HostileFiles, AFileThatIsNamedByManyBuffersIsRefused) {
  constexpr std::size_t kBytes = 4'000'000;
  test::writeFile(folder / "corners.bin", "");
  fs::resize_file(folder / "corners.bin", kBytes);
  test::GltfBuilder file;
  file.json["buffers"] = nlohmann::json(2, {{"byteLength", kBytes}, {"uri", "corners.bin"}});
  EXPECT_EQ(refusalOfScene(file.writeGltf(folder / "scene.gltf")), "was not refused");
  file.json["buffers"] = nlohmann::json(300, {{"byteLength", kBytes}, {"uri", "corners.bin"}});
  file.json["buffers"][7]["uri"] = "./corners.bin";
  EXPECT_THAT(refusalOfScene(file.writeGltf(folder / "scene.gltf")),
              "scene.gltf: \"corners.bin\": is named by too many buffers; let their views share one");
}

TEST_F(HostileFiles, AFileThatIsNamedByManyImagesIsReadAndDecodedOnce) {
  sceneOfThreeFiles();
  fs::resize_file(folder / "color.png", 8'000'000);  // what comes after its end is read and of no use
  nlohmann::json scene = nlohmann::json::parse(std::ifstream(folder / "scene.gltf"));
  for (std::size_t i = 0; i < 1000; ++i) {
    scene["images"].push_back({{"uri", i % 2 ? "color.png" : "./color.png"}});
    scene["textures"].push_back({{"source", i + 1}});
    scene["materials"].push_back({{"emissiveTexture", {{"index", i + 1}}}});
  }
  const fs::path file = test::writeFile(folder / "scene.gltf", scene.dump());
  const test::HostileBudget budget("images");
  const Scene loaded = loadScene(file);
  EXPECT_EQ(loaded.texels.size(), 1u);
  EXPECT_EQ(loaded.textures.size(), 1001u);
  EXPECT_EQ(loaded.texels[0].at(0, 0), (glm::vec<4, std::uint8_t>(9, 8, 7, 255)));
}

TEST_F(HostileFiles, FifosAreRefusedAsScenes) {
  for (const std::string kind : kSceneKinds) {
    const fs::path file = folder / ("a" + kind);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    EXPECT_THAT(refusalOfScene(file), HasSubstr("a" + kind + ": is no regular file but a pipe"));
  }
}

TEST_F(HostileFiles, FoldersAreRefusedAsScenes) {
  for (const std::string kind : kSceneKinds) {
    fs::create_directory(folder / ("a" + kind));
    EXPECT_THAT(refusalOfScene(folder / ("a" + kind)), HasSubstr("a" + kind + ": is a folder; name"));
  }
}

TEST_F(HostileFiles, ScenesThatMayNotBeReadAreRefused) {
  fs::permissions(folder.path(), fs::perms::all);
  for (const std::string kind : kSceneKinds) {
    const fs::path file = test::writeFile(folder / ("a" + kind), "secret");
    fs::permissions(file, fs::perms::none);
    const test::OrdinaryUser user;
    EXPECT_THAT(refusalOfScene(file), HasSubstr("a" + kind + ": cannot be opened (Permission denied); change"));
  }
}

TEST_F(HostileFiles, BuffersAndTexturesThatMayNotBeReadAreRefused) {
  fs::permissions(folder.path(), fs::perms::all);
  for (const char* name : {"corners.bin", "color.png"}) {
    const fs::path scene = sceneOfThreeFiles();
    fs::permissions(folder / name, fs::perms::none);
    {
      const test::OrdinaryUser user;
      EXPECT_THAT(
          refusalOfScene(scene),
          testing::AllOf(StartsWith("scene.gltf: "), HasSubstr(std::string(name) + ": cannot be opened (Permission")));
    }
    fs::remove(folder / name);
  }
}

TEST_F(HostileFiles, LinksThatLeadNowhereAreRefused) {
  for (const char* name : {"corners.bin", "color.png"}) {
    const fs::path scene = sceneOfThreeFiles();
    fs::remove(folder / name);
    fs::create_symlink("gone", folder / name);
    EXPECT_THAT(refusalOfScene(scene),
                testing::AllOf(StartsWith("scene.gltf: "),
                               HasSubstr(std::string(name) + ": is a link to a file that does not")));
    fs::remove(folder / name);
  }
  fs::create_symlink("gone.glb", folder / "link.glb");
  EXPECT_THAT(refusalOfScene(folder / "link.glb"), HasSubstr("link.glb: is a link to a file that does not exist"));
}

TEST_F(HostileFiles, AFileThatVanishesWhileItsSceneIsReadIsNamed) {
  const fs::path scene = sceneOfThreeFiles();
  for (const char* name : {"corners.bin", "color.png"}) {
    std::atomic<bool> done = false;
    std::thread other([&] {
      while (!done) {
        fs::rename(folder / name, folder / "elsewhere");
        fs::rename(folder / "elsewhere", folder / name);
      }
    });
    int loaded = 0, refused = 0;
    while (loaded < 20 || refused < 20) {
      try {
        EXPECT_EQ(loadScene(scene).triangleCount(), 1u);
        ++loaded;
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(StartsWith("scene.gltf: "), HasSubstr(name)));
        EXPECT_THAT(error.what(), testing::AnyOf(HasSubstr(": does not exist"), HasSubstr(": cannot be found (")));
        ++refused;
      }
    }
    done = true;
    other.join();
  }
}

}  // namespace
}  // namespace cellcut::test
