// Proof 6: a power of two in the unit of length or of radiance changes no digit of any probability and of any picture.
// No absolute epsilon passes this.
#include "renderer/base/rng.h"
#include "renderer/scene/tangents.h"
#include "renderer/trace/renderer.h"
#include "tests/support/depth.h"
#include "tests/support/images.h"
#include "tests/support/scaling.h"
#include "tests/support/shading_points.h"
#include "tests/support/strategies.h"

#include <bit>
#include <vector>

namespace cellcut::test {
namespace {

/// A picture on a wall, a shining one on half-transparent glass, and a metal with bumps.
void addTextured(Scene& scene) {
  Rng rng(6);
  ImageRgba8 texels(8, 8);
  for (auto& texel : texels) {
    const auto byte = [&](std::uint32_t from) { return static_cast<std::uint8_t>(from + rng.below(256 - from)); };
    texel = {byte(0), byte(0), byte(128), byte(0)};  // bumps point outwards
  }
  scene.texels.push_back(std::move(texels));
  scene.textures.push_back({TexelsId{0}, Wrap::kRepeat, Wrap::kMirror});
  const TextureSlot texture{TextureId{0}};
  Material picture = lambertian(Vec3(0.9f));
  picture.setSlot(TextureUse::kBaseColor, texture);
  Material glass = emitter({3, 2, 1}, true);
  for (const TextureUse use : {TextureUse::kEmission, TextureUse::kBaseColor}) glass.setSlot(use, texture);
  glass.baseColor = {0.5f, 0.5f, 0.5f, 0.8f};
  glass.alphaMode = AlphaMode::kBlend;
  Material bumpy = metal({0.8f, 0.7f, 0.6f}, 0.4f);
  bumpy.setSlot(TextureUse::kNormal, texture);
  addQuad(scene, addMaterial(scene, picture), {-1.45f, -0.6f, 0.5f}, {0, 0, -0.9f}, {0, 0.8f, 0});
  addQuad(scene, addMaterial(scene, glass), {-1.1f, 0.3f, -0.6f}, {0.9f, 0, 0}, {0, 0.5f, 0.2f}, 2, 2);
  addQuad(scene, addMaterial(scene, bumpy), {0.3f, -0.5f, -1.4f}, {1, 0, 0}, {0, 0.9f, 0});
  Mesh& wall = scene.meshes.back();
  wall.normals.assign(wall.positions.size(), {0, 0, 1});
  computeTangents(wall, texture);
}

/// Lights of all kinds, surfaces whose mirrored lights are asked for: metals and a dielectric of roughness 0.2 to 0.5;
/// and textures.
Scene glossyStage() {
  Scene scene = stage(LightMix::kAll, 120, 4);
  addTextured(scene);
  Material lacquer;
  lacquer.baseColor = Vec4(0.1f, 0.3f, 0.2f, 1);
  lacquer.metallic = 0;
  lacquer.roughness = 0.3f;
  addQuad(scene, addMaterial(scene, metal({0.8f, 0.8f, 0.9f}, 0.2f)), {-1.4f, -0.99f, 1.4f}, {1.4f, 0, 0}, {0, 0, -2});
  addQuad(scene, addMaterial(scene, lacquer), {0, -0.98f, 1.4f}, {1.4f, 0, 0}, {0, 0, -2});
  addSphere(scene, addMaterial(scene, metal({0.9f, 0.5f, 0.4f}, 0.5f)), {-0.4f, -0.6f, 0.6f}, 0.35f);
  finish(scene);
  return scene;
}

std::uint32_t bitsOf(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

/// How many of the values of one are not 2^exponent times those of the other.
std::size_t differences(const std::vector<float>& scaled, const std::vector<float>& plain, int exponent) {
  EXPECT_EQ(scaled.size(), plain.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    count += bitsOf(scaled[i]) != bitsOf(std::ldexp(plain[i], exponent));
  }
  return count;
}

/// What a unit does to each layer of a film.
struct Exponents {
  int radiance = 0;
  int depth = 0;
};

/// The first of them where a sanitizer looks on.
std::vector<int> share(std::vector<int> exponents) {
  exponents.resize(sampleShare(exponents.size()));
  return exponents;
}

class PowersOfTwo : public testing::TestWithParam<SamplerVariant> {
 protected:
  LayeredImage render(const Scene& scene) const {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 36;
    settings.maxDepth = 5;
    settings.strategy = GetParam().strategy;
    settings.sampler = GetParam().settings;
    settings.auxiliary = true;
    Renderer renderer(scene, settings);
    renderPasses(renderer, 3);
    EXPECT_EQ(renderer.film().badSamples().nan + renderer.film().badSamples().inf, 0u);
    return renderer.film().layers();
  }

  void expectSamePicture(const LayeredImage& scaled, const LayeredImage& plain, const Exponents& exponents) const {
    ASSERT_EQ(scaled.layers.size(), plain.layers.size());
    for (std::size_t i = 0; i < plain.layers.size(); ++i) {
      const std::string& name = plain.layers[i].name;
      const bool isLight = name.empty() || name == "error";
      const int exponent = isLight ? exponents.radiance : name == "depth" ? exponents.depth : 0;
      EXPECT_EQ(differences(scaled.layers[i].values, plain.layers[i].values, exponent), 0u) << "layer '" << name << "'";
    }
  }

  /// Probabilities and draws at points of both, which are found by rays.
  void expectSameChoices(const Scene& scaled, const Scene& plain, int lengthExponent) const {
    constexpr std::size_t kPoints = 24;
    const auto scaledPoints = pathVertices(scaled, kPoints, 5), points = pathVertices(plain, kPoints, 5);
    const Lights scaledLights(scaled), lights(plain);
    const auto positions = [](const std::vector<ShadingPoint>& of) {
      std::vector<Vec3> pilot;
      pilot.reserve(of.size());
      for (const ShadingPoint& point : of) pilot.push_back(point.p);
      return pilot;
    };
    const auto scaledSampler =
        makeLightSampler(GetParam().strategy, scaledLights, GetParam().settings, positions(scaledPoints));
    const auto sampler = makeLightSampler(GetParam().strategy, lights, GetParam().settings, positions(points));
    ASSERT_EQ(scaledPoints.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(scaledPoints[i].p, points[i].p * std::ldexp(1.0f, lengthExponent)) << "hit " << i;
      ASSERT_EQ(scaledPoints[i].n, points[i].n) << "hit " << i;
      for (std::size_t l = 0; l < lights.size(); ++l) {
        const auto light = static_cast<LightId>(l);
        ASSERT_EQ(bitsOf(scaledSampler->pmf(scaledPoints[i], light)), bitsOf(sampler->pmf(points[i], light)))
            << "light " << l << " at point " << i;
      }
      for (const double u : {0.0, 0.1, 0.5, 0.77, 1 - 0x1p-24}) {
        const auto a = scaledSampler->sample(scaledPoints[i], u), b = sampler->sample(points[i], u);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        ASSERT_EQ(a->light, b->light);
        ASSERT_EQ(bitsOf(a->pmf), bitsOf(b->pmf));
      }
    }
  }
};

TEST_P(PowersOfTwo, OfLengthKeepEveryHitAndProbabilityAndThePicture) {
  const Scene plain = glossyStage();
  const LayeredImage picture = render(plain);
  for (const int k : share({-20, -7, 1, 20, 30})) {
    SCOPED_TRACE("lengths times 2^" + std::to_string(k));
    const Scene scaled = withLengthsTimesPowerOf2(plain, k);
    expectSameChoices(scaled, plain, k);
    expectSamePicture(render(scaled), picture, {.depth = k});
  }
}

TEST_P(PowersOfTwo, OfRadianceKeepEveryProbabilityAndScaleThePicture) {
  const Scene plain = glossyStage();
  const LayeredImage picture = render(plain);
  for (const int k : share({-60, -20, 20, 60})) {
    SCOPED_TRACE("radiance times 2^" + std::to_string(k));
    const Scene scaled = withRadianceTimesPowerOf2(plain, k);
    expectSameChoices(scaled, plain, 0);
    expectSamePicture(render(scaled), picture, {.radiance = k});
  }
}

INSTANTIATE_TEST_SUITE_P(Every, PowersOfTwo, testing::ValuesIn(kSamplerVariants), variantName);

}  // namespace
}  // namespace cellcut::test
