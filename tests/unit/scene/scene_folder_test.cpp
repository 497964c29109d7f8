#include "renderer/scene/scene_folder.h"

#include "renderer/base/error.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_directory.h"

#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

class SceneFolderTest : public testing::Test {
 protected:
  SceneFolderTest() {
    fs::create_directories(root / "scene/below");
    test::writeFile(root / "secret.bin", "secret");
    test::writeFile(root / "scene/a b.bin", "beside");
    test::writeFile(root / "scene/below/b.bin", "below");
  }
  test::TemporaryDirectory root;
  SceneFolder folder{root / "scene/a.gltf"};
};

TEST_F(SceneFolderTest, ReadsFilesBesideAndBelow) {
  EXPECT_EQ(folder.read("a b.bin").size(), 6u);
  EXPECT_EQ(folder.read("below/b.bin").size(), 5u);
  EXPECT_EQ(folder.read("./below/b.bin").size(), 5u);
}

TEST_F(SceneFolderTest, RefusesReferencesThatLeadOut) {
  for (const std::string reference :
       {"../secret.bin", "below/../../secret.bin", "..", ".", "", "/etc/passwd", "file:///etc/passwd", "http://a/b",
        "C:/secret.bin", "below/\n.bin", "//host/share"}) {
    EXPECT_THROW(folder.read(reference), InputError) << reference;
  }
  EXPECT_THROW(folder.read(std::string("a b.bin\0x", 9)), InputError);
  EXPECT_THROW(folder.read((root / "scene/a b.bin").string()), InputError);
}

TEST_F(SceneFolderTest, FollowsLinksInsideAndRefusesThoseOutside) {
  fs::create_symlink(root / "secret.bin", root / "scene/out.bin");
  fs::create_directory_symlink(root.path(), root / "scene/up");
  fs::create_symlink(root / "scene/below/b.bin", root / "scene/in.bin");
  EXPECT_THROW(folder.read("out.bin"), InputError);
  EXPECT_THROW(folder.read("up/secret.bin"), InputError);
  EXPECT_EQ(folder.read("in.bin").size(), 5u);
}

TEST_F(SceneFolderTest, RefusesWhatIsNoFile) {
  ASSERT_EQ(mkfifo((root / "scene/pipe").c_str(), 0600), 0);
  EXPECT_THROW(folder.read("pipe"), InputError);  // and does not wait for a writer
  EXPECT_THROW(folder.read("below"), InputError);
  EXPECT_THROW(folder.read("missing.bin"), InputError);
}

TEST_F(SceneFolderTest, ShowsNoControlCharactersOfAReference) {
  try {
    folder.read("\x1b[2J" + std::string(1000, 'x'));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_LT(text.size(), 300u);
  }
}

}  // namespace
}  // namespace cellcut
