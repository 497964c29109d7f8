#include "app/command_line.h"
#include "renderer/base/image_io.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_directory.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

using Json = nlohmann::json;
using test::GltfBuilder;

/// Files that are valid, with lights where or as bright as nobody puts them.
class HostileLights : public testing::Test {
 protected:
  /// A triangle seen from the front; lights are still to be added.
  HostileLights() {
    file.addRoot({{"mesh", file.addTriangle()}});
    const std::size_t camera =
        file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}});
    file.addRoot({{"camera", camera}, {"translation", {0.3, 0.3, 2}}});
  }
  void addPoints(const std::vector<float>& xs) {
    for (const float x : xs) {
      file.addRoot({{"translation", {x, 1, 1}}, {"extensions", file.addLight({{"type", "point"}, {"intensity", 10}})}});
    }
  }
  /// A triangle as in addTriangle, that shines on it from in front.
  void addEmitter(float x, float strength) {
    Json primitive = file.primitive({{x, 0, 1}, {x, 1, 1}, {x + 1, 0, 1}});
    primitive["material"] = file.add(
        "materials", {{"emissiveFactor", {1, 1, 1}},
                      {"doubleSided", true},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}});
    file.addRoot({{"mesh", file.addMesh(primitive)}});
  }
  /// Renders the file and expects a finite picture.
  void expectRenders(const std::vector<const char*>& options) {
    const std::string scene = file.writeGltf(folder / "scene.gltf").string();
    const std::string picture = (folder / "out.pfm").string(), report = (folder / "report.json").string();
    std::vector<const char*> arguments{"cellcut",  "render",       scene.c_str(), "-o",    picture.c_str(),
                                       "--report", report.c_str(), "--size",      "32x32", "--spp",
                                       "4"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::ostringstream out, err;
    ASSERT_EQ(runCommandLine(arguments, out, err, false), 0) << err.str();
    for (const Vec3& pixel : readImage(picture)) ASSERT_TRUE(isFinite(pixel));
    std::ifstream in(report);
    const Json samples = Json::parse(in).at("samples");
    EXPECT_EQ(samples.at("nan"), 0);
    EXPECT_EQ(samples.at("inf"), 0);
  }
  GltfBuilder file;
  test::TemporaryDirectory folder;
};

TEST_F(HostileLights, ADenormalDistanceApart) {
  addPoints({0, 1e-39f, 0});
  for (const char* strategy : {"cell-cut", "point-cut", "light-tree"}) expectRenders({"--strategy", strategy});
}

TEST_F(HostileLights, AsFarApartAsFloatsGo) {
  addPoints({-3e38f, 3e38f, 0});
  for (const char* strategy : {"cell-cut", "point-cut", "light-tree"}) expectRenders({"--strategy", strategy});
}

TEST_F(HostileLights, TwentyDecadesFainterThanAnother) {
  addEmitter(-1.5f, 1e20f);
  addEmitter(0.5f, 1);
  addEmitter(0.6f, 1);
  for (const char* quality : {"preview", "balanced"}) expectRenders({"--quality", quality});
}

}  // namespace
}  // namespace cellcut
