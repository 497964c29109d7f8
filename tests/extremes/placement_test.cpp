// Extremes of place together: scenes of a micrometre and of a thousand kilometres, 10,000 of their radii from the
// origin.
#include "renderer/scene/load_scene.h"
#include "renderer/scene/recipes/recipe.h"
#include "renderer/trace/prepared_scene.h"
#include "tests/support/depth.h"
#include "tests/support/glb_reader.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/images.h"
#include "tests/support/nightly.h"
#include "tests/support/probabilities.h"
#include "tests/support/shading_points.h"
#include "tests/support/temporary_directory.h"

namespace cellcut::test {
namespace {

/// The recipe `kinds`, all five kinds of light, and the same as a node places it.
class FarScenes {
 public:
  explicit FarScenes(std::size_t lights) : file_(readGlb(generateRecipe(Recipe::kKinds, lights, 1))) {
    plain_ = load(file_);
  }
  const Scene& plain() const { return plain_; }

  /// Of this radius in metres, and at 10⁴ radii from the origin. Lights at points have the intensities that light it as
  /// before.
  Scene placed(double radius) const {
    const double scale = radius / static_cast<double>(plain_.bounds.radius());
    const glm::dvec3 at = 1e4 * radius * glm::normalize(glm::dvec3(1, 0.7, -0.4));
    Glb file = file_;
    auto& roots = file.json["scenes"][0]["nodes"];
    file.json["nodes"].push_back(
        {{"children", roots}, {"scale", {scale, scale, scale}}, {"translation", {at.x, at.y, at.z}}});
    roots = {file.json["nodes"].size() - 1};
    for (auto& light : file.json["extensions"]["KHR_lights_punctual"]["lights"]) {
      if (light["type"] != "directional") light["intensity"] = light.value("intensity", 1.0) * scale * scale;
    }
    return load(file);
  }

 private:
  Scene load(const Glb& file) const {
    return loadScene(writeFile(folder_ / "scene.glb", glbBytes(file.json, file.binary)));
  }

  TemporaryDirectory folder_;
  Glb file_;
  Scene plain_;
};

constexpr std::array kRadii{1e-6, 1e6};

bool looksAtPlaces(const SamplerVariant& variant) {
  return variant.strategy != Strategy::kUniform && variant.strategy != Strategy::kPower;
}

RenderSettings settingsOf(const SamplerVariant& variant) {
  RenderSettings settings;
  settings.width = settings.height = 48;
  settings.maxDepth = 2;
  settings.strategy = variant.strategy;
  settings.sampler = variant.settings;
  return settings;
}

TEST(PlacementOfAScene, KeepsItsTrianglesLightsAndSize) {
  const FarScenes scenes(60);
  for (const double radius : kRadii) {
    const Scene scene = scenes.placed(radius);
    EXPECT_NEAR(static_cast<double>(scene.bounds.radius()) / radius, 1, 1e-5);  // a few roundings to floats
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_EQ(scene.triangleCount(), scenes.plain().triangleCount());
    EXPECT_EQ(Lights(scene).size(), Lights(scenes.plain()).size());
  }
}

/// Sound probabilities at a vertex of a path, and a finite picture, of each of them.
std::vector<Image<LuminanceEstimate>> expectSound(const Scene& scene, std::uint64_t seed) {
  const PreparedScene prepared(scene);
  const ShadingPoint point = pathVertices(scene, 1, 7)[0];
  std::vector<Image<LuminanceEstimate>> pictures;
  for (const SamplerVariant& variant : kFastVariants) {
    SCOPED_TRACE(variant.name);
    const RenderSettings settings = settingsOf(variant);
    const auto sampler = makeLightSampler(prepared, settings);
    expectSoundPmfs(variant, *sampler, prepared.lights, point, kReach);
    const PathContext context{scene, prepared.accel, prepared.lights, *sampler, settings.maxDepth, true};
    PathCounts counts;
    const Film film = renderPasses(context, {settings.width, settings.height}, 32, seed, counts);
    EXPECT_EQ(film.badSamples().nan + film.badSamples().inf, 0u);
    pictures.push_back(estimatesOf(film));
  }
  return pictures;
}

TEST(PlacementOfAScene, KeepsTheProbabilitiesAndThePictureOfAMillionLights) {
  const FarScenes scenes(sampleShare(1'000'000));
  const auto small = expectSound(scenes.placed(kRadii[0]), 1), large = expectSound(scenes.placed(kRadii[1]), 2);
  for (std::size_t i = 0; !isSixteenth() && i < small.size(); ++i) {
    EXPECT_EQ(difference(small[i], large[i], kFastVariants.size()), "") << kFastVariants[i].name;
  }
}

TEST(PlacementOfAScene, TurnsNoPathOfTheSameNumbers) {
  // These choices of a light do not look at where it is, so that only a hit or a surface could differ.
  const FarScenes scenes(60);
  for (const SamplerVariant& variant : kSamplerVariants) {
    if (looksAtPlaces(variant)) continue;
    const auto render = [&](const Scene& scene) {
      Renderer renderer(scene, settingsOf(variant));
      return renderPasses(renderer, 4);
    };
    const ImageRgb plain = render(scenes.plain());
    for (const double radius : kRadii) {
      const ImageRgb picture = render(scenes.placed(radius));
      std::size_t different = 0;
      for (std::size_t i = 0; i < plain.size(); ++i) {
        different += !(glm::length(picture[i] - plain[i]) <= 1e-3f * glm::length(plain[i]));
      }
      // Positions are rounded another way, and a path that passes an edge by less than that goes elsewhere.
      EXPECT_LE(different, plain.size() / 100)
          << "pixels of " << plain.size() << ", " << variant.name << ", radius " << radius;
    }
  }
}

class Placement : public testing::TestWithParam<SamplerVariant> {
 protected:
  static void expectSamePictures(const FarScenes& scenes, std::size_t passes) {
    RenderSettings settings = settingsOf(GetParam());
    const auto plain = renderEstimates(scenes.plain(), settings, passes);
    for (const double radius : kRadii) {
      ++settings.seed;
      const auto placed = renderEstimates(scenes.placed(radius), settings, passes);
      if (isSixteenth()) continue;  // rendered; the tails of a sixteenth of the paths are not normal
      EXPECT_EQ(difference(placed, plain, kComparisons), "") << "radius " << radius;
    }
  }

  /// Enough for a quarter of the tiles. To look at all lights, or to find a long cut at every vertex, takes many times
  /// as long.
  static std::size_t passes() {
    const SamplerVariant& variant = GetParam();
    const bool isSlow = variant.strategy == Strategy::kProportional || variant.strategy == Strategy::kPointCut;
    return isSlow ? byDepth(variant.settings.maxCut < 10 ? 32 : 8, 64) : byDepth(64, 1024);
  }

 private:
  static constexpr std::size_t kComparisons = kRadii.size() * kSamplerVariants.size();
};

/// The others are compared number by number; their noise is too much for a comparison by tiles.
std::vector<SamplerVariant> thoseThatLookAtPlaces() {
  std::vector<SamplerVariant> result;
  std::copy_if(kSamplerVariants.begin(), kSamplerVariants.end(), std::back_inserter(result), looksAtPlaces);
  return result;
}

TEST_P(Placement, OfAMicrometreOrAThousandKilometresFarFromTheOriginKeepsThePicture) {
  expectSamePictures(FarScenes(60), sampleShare(passes()));
}

TEST_P(Placement, KeepsThePictureOfAMillionLights) {
  if (!isNightly()) GTEST_SKIP() << "a minute and more: ./dev nightly";
  if (GetParam().strategy == Strategy::kProportional) GTEST_SKIP() << "a million lights at every vertex: hours";
  expectSamePictures(FarScenes(1'000'000), 64);
}

INSTANTIATE_TEST_SUITE_P(Every, Placement, testing::ValuesIn(thoseThatLookAtPlaces()), variantName);

}  // namespace
}  // namespace cellcut::test
