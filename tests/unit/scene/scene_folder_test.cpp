#include "renderer/scene/scene_folder.h"

#include "tests/support/gltf_builder.h"
#include "tests/support/hostile_budget.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class SceneFolderTest : public testing::Test {
 protected:
  SceneFolderTest() {
    fs::create_directories(root / "scene/below");
    test::writeFile(root / "secret.bin", "secret");
    test::writeFile(root / "scene/a b.bin", "beside");
    test::writeFile(root / "scene/below/b.bin", "below");
  }
  std::string refusalOf(const std::string& reference) const {
    return test::refusalOf([&] { folder.read(reference); });
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
  for (const std::string reference : {"../secret.bin", "below/../../secret.bin", ".."}) {
    EXPECT_EQ(refusalOf(reference),
              "a.gltf: \"" + reference + "\": leads out of the scene's folder; put the file beside the scene");
  }
  for (const std::string& reference :
       {std::string("/etc/passwd"), std::string("//host/share"), (root / "scene/a b.bin").string()}) {
    EXPECT_THAT(refusalOf(reference), StartsWith("a.gltf: \"" + reference.substr(0, 80)));
    EXPECT_THAT(refusalOf(reference), HasSubstr("is an absolute path; name files relative to the scene"));
  }
  for (const std::string reference : {"file:///etc/passwd", "http://a/b", "C:/secret.bin"}) {
    EXPECT_EQ(refusalOf(reference),
              "a.gltf: \"" + reference + "\": has a scheme that is not read; put the file beside the scene");
  }
}

TEST_F(SceneFolderTest, RefusesReferencesThatAreNoFileNames) {
  EXPECT_EQ(refusalOf(""), "a.gltf: \"\": names no file; export the scene again");
  EXPECT_THAT(refusalOf("."), StartsWith("a.gltf: "));
  EXPECT_EQ(refusalOf("below/\n.bin"),
            "a.gltf: \"below/?.bin\": has control characters in a file name; rename the file");
  EXPECT_EQ(refusalOf(std::string("a b.bin\0x", 9)),
            "a.gltf: \"a b.bin?x\": has control characters in a file name; rename the file");
}

TEST_F(SceneFolderTest, FollowsLinksInsideAndRefusesThoseOutside) {
  fs::create_symlink(root / "secret.bin", root / "scene/out.bin");
  fs::create_directory_symlink(root.path(), root / "scene/up");
  fs::create_symlink(root / "scene/below/b.bin", root / "scene/in.bin");
  fs::create_symlink("loop.bin", root / "scene/loop.bin");
  for (const std::string reference : {"out.bin", "up/secret.bin"}) {
    EXPECT_EQ(
        refusalOf(reference),
        "a.gltf: \"" + reference + "\": is a link out of the scene's folder; put the file itself beside the scene");
  }
  EXPECT_THAT(refusalOf("loop.bin"), testing::AllOf(StartsWith("a.gltf: \"loop.bin\": cannot be found ("),
                                                    HasSubstr("; put the file itself")));
  EXPECT_EQ(folder.read("in.bin").size(), 5u);
}

TEST_F(SceneFolderTest, RefusesWhatIsNoFile) {
  ASSERT_EQ(mkfifo((root / "scene/pipe").c_str(), 0600), 0);
  const test::HostileBudget budget("pipe");  // into which nobody writes
  EXPECT_THAT(refusalOf("pipe"), testing::AllOf(StartsWith("a.gltf: "), HasSubstr("pipe: is no regular file")));
  EXPECT_THAT(refusalOf("below"), testing::AllOf(StartsWith("a.gltf: "), HasSubstr("below: is a folder")));
  EXPECT_THAT(refusalOf("missing.bin"),
              testing::AllOf(StartsWith("a.gltf: "), HasSubstr("missing.bin: does not exist")));
}

TEST_F(SceneFolderTest, ShowsNoControlCharactersOfAReference) {
  const std::string text = refusalOf("\x1b[2J" + std::string(1000, 'x'));
  EXPECT_THAT(text, StartsWith("a.gltf: \"?[2Jxxx"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_LT(text.size(), 300u);
}

}  // namespace
}  // namespace cellcut::test
