#include "renderer/scene/bsdf.h"

#include "renderer/base/rng.h"
#include "renderer/base/srgb.h"
#include "renderer/scene/material.h"
#include "tests/support/depth.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// The BSDF of a material without textures.
Bsdf bsdfOf(const Material& material) {
  Scene scene;
  addTriangle(scene, addMaterial(scene, material), Vec3(0), {1, 0, 0}, {0, 1, 0});
  return bsdfAt(scene, {scene.meshes.data(), 0, Vec2(0.3f)});
}

Material dielectric(float roughness) {
  Material material;
  material.metallic = 0;
  material.roughness = roughness;
  return material;
}

Vec3 direction(float cosine, float azimuth = 0.4f) {
  const float sine = safeSqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// Albedo for a direction by sampling the BSDF.
Moments albedo(const Bsdf& bsdf, const Vec3& wo, std::size_t samples) {
  Rng rng(1);
  Moments moments;
  for (std::size_t i = 0; i < samples; ++i) {
    const float lobe = rng.uniform(), u = rng.uniform();
    const auto sample = bsdf.sample(wo, lobe, {u, rng.uniform()});
    moments.add(sample ? static_cast<double>(sample->value.y * sample->wi.z / sample->pdf) : 0.0);
  }
  return moments;
}

constexpr std::array kRoughnesses{0.0f, 0.03f, 0.1f, 0.25f, 0.5f, 0.8f, 1.0f};
constexpr std::array kCosines{0.01f, 0.1f, 0.4f, 0.8f, 1.0f};

std::vector<std::pair<std::string, Material>> materials() {
  std::vector<std::pair<std::string, Material>> result{{"Lambert", lambertian(Vec3(1))}};
  for (const float roughness : kRoughnesses) {
    result.emplace_back("metal " + std::to_string(roughness), metal(Vec3(1), roughness));
    result.emplace_back("dielectric " + std::to_string(roughness), dielectric(roughness));
  }
  Material half = metal(Vec3(0.9f, 0.5f, 0.2f), 0.5f);
  half.metallic = 0.5f;
  result.emplace_back("half metal", half);
  Material diamond = dielectric(0.6f);
  diamond.ior = 2.4f;
  result.emplace_back("high index", diamond);
  return result;
}

TEST(Bsdf, LambertianIsExactlyItsAlbedo) {
  const Bsdf bsdf = bsdfOf(lambertian({0.2f, 0.5f, 1.0f}));
  for (const float cosine : kCosines) {
    for (const Vec3& wi : {direction(0.3f), direction(0.9f, 2)}) {
      const Vec3 f = bsdf.eval(direction(cosine), wi).value * kPi;
      EXPECT_NEAR(f.x, 0.2f, 1e-7);
      EXPECT_NEAR(f.y, 0.5f, 1e-7);
      EXPECT_NEAR(f.z, 1.0f, 1e-6);
    }
    // Cosine sampling has no variance: one sample is the answer.
    const Moments white = albedo(bsdfOf(lambertian(Vec3(1))), direction(cosine), 1000);
    EXPECT_NEAR(white.mean(), 1, 1e-4);
  }
}

TEST(Bsdf, IsLambertianExactlyWhereTheMaterialCannotReflect) {
  for (const auto& [name, material] : materials()) {
    const Bsdf bsdf = bsdfOf(material);
    const Vec3 across = bsdf.eval(direction(1), direction(1)).value;
    const Vec3 grazing = bsdf.eval(direction(0.1f), direction(0.1f, 2)).value;
    EXPECT_EQ(canReflect(material), across != grazing) << name;
  }
  Material unlit = metal(Vec3(1), 0.5f);
  unlit.unlit = true;
  EXPECT_FALSE(canReflect(unlit));
}

TEST(Bsdf, IsReciprocal) {
  Rng rng(2);
  for (const auto& [name, material] : materials()) {
    const Bsdf bsdf = bsdfOf(material);
    for (int i = 0; i < 200; ++i) {
      const Vec3 a = direction(rng.uniform(0.02f, 1), rng.uniform(0, 6)),
                 b = direction(rng.uniform(0.02f, 1), rng.uniform(0, 6));
      const float there = bsdf.eval(a, b).value.y, back = bsdf.eval(b, a).value.y;
      // Roundings of the half vector, relative to a lobe at least 10⁻³ wide.
      ASSERT_NEAR(there, back, 1e-4f * (there + back)) << name;
    }
  }
}

TEST(Bsdf, ReflectsNoMoreThanItReceives) {
  const std::size_t samples = sampleShare(byDepth(40'000, 1'000'000));
  for (const auto& [name, material] : materials()) {
    const Bsdf bsdf = bsdfOf(material);
    for (const float cosine : kCosines) {
      const Moments moments = albedo(bsdf, direction(cosine), samples);
      EXPECT_LE(moments.mean() - 3 * std::sqrt(moments.meanVariance()), 1.01) << name << " at cosine " << cosine;
    }
  }
}

TEST(Bsdf, SmoothMirrorReflectsEverything) {
  for (const float cosine : {0.2f, 0.7f, 1.0f}) {
    EXPECT_NEAR(albedo(bsdfOf(metal(Vec3(1), 0)), direction(cosine), 20'000).mean(), 1, 1e-3);
  }
}

TEST(Bsdf, WhiteDielectricOfAnyRoughnessReflectsEverything) {
  // What the layer does not reflect, the white base does: to the table's 0.5 %.
  for (const float ior : {1.5f, 2.4f}) {
    for (const float roughness : {0.03f, 0.17f, 0.3f, 0.5f, 0.72f, 1.0f}) {
      Material material = dielectric(roughness);
      material.ior = ior;
      for (const float cosine : {0.1f, 0.4f, 1.0f}) {
        const Moments moments = albedo(bsdfOf(material), direction(cosine), sampleShare(200'000));
        EXPECT_NEAR(moments.mean(), 1, 0.005 + 3 * std::sqrt(moments.meanVariance()))
            << "roughness " << roughness << ", cosine " << cosine << ", ior " << ior;
      }
    }
  }
}

TEST(Bsdf, SampleCarriesWhatEvalAndPdfSay) {
  Rng rng(3);
  for (const auto& [name, material] : materials()) {
    const Bsdf bsdf = bsdfOf(material);
    for (int i = 0; i < 500; ++i) {
      const Vec3 wo = direction(rng.uniform(0.01f, 1), rng.uniform(0, 6));
      const float lobe = rng.uniform(), u = rng.uniform();
      const auto sample = bsdf.sample(wo, lobe, {u, rng.uniform()});
      if (!sample) continue;
      ASSERT_GT(sample->pdf, 0) << name;
      ASSERT_GT(sample->wi.z, 0) << name;
      ASSERT_NEAR(glm::length(sample->wi), 1, 1e-4) << name;
      ASSERT_EQ(sample->pdf, bsdf.eval(wo, sample->wi).pdf) << name;
      ASSERT_EQ(sample->value, bsdf.eval(wo, sample->wi).value) << name;
    }
  }
}

TEST(Bsdf, SamplesAreDistributedByThePdf) {
  // Bins over the hemisphere, even in azimuth and cosine, the density integrated in each; the share below the horizon
  // gives no sample.
  constexpr int kRows = 10, kColumns = 20, kCells = 32;
  std::vector<std::pair<std::string, Material>> broad;
  for (auto& m : materials()) {
    // Lobes narrower than the quadrature's cells are left to the albedo tests.
    if (m.second.roughness >= 0.5f) broad.push_back(m);
  }
  for (const auto& [name, material] : broad) {
    const Bsdf bsdf = bsdfOf(material);
    for (const float cosine : {0.15f, 0.6f, 1.0f}) {
      const Vec3 wo = direction(cosine);
      std::vector<double> expected(kRows * kColumns + 1);
      for (int y = 0; y < kRows * kCells; ++y) {
        for (int x = 0; x < kColumns * kCells; ++x) {
          const Vec3 wi = direction((static_cast<float>(y) + 0.5f) / (kRows * kCells),
                                    2 * kPi * (static_cast<float>(x) + 0.5f) / (kColumns * kCells));
          const double cell = 2 * std::numbers::pi / (kRows * kCells) / (kColumns * kCells);
          expected[static_cast<std::size_t>(y / kCells) * kColumns + static_cast<std::size_t>(x / kCells)] +=
              static_cast<double>(bsdf.eval(wo, wi).pdf) * cell;
        }
      }
      double inside = 0;
      for (const double e : expected) inside += e;
      ASSERT_LE(inside, 1 + 1e-3) << name << " at cosine " << cosine;
      expected.back() = std::max(0.0, 1 - inside);
      std::vector<std::uint64_t> counts(expected.size());
      Rng rng(4);
      const std::size_t n = sampleShare(50'000);
      for (std::size_t i = 0; i < n; ++i) {
        const float lobe = rng.uniform(), u = rng.uniform();
        const auto sample = bsdf.sample(wo, lobe, {u, rng.uniform()});
        if (!sample) {
          ++counts.back();
          continue;
        }
        float turn = std::atan2(sample->wi.y, sample->wi.x) / (2 * kPi);
        if (turn < 0) ++turn;
        const int row = std::min(static_cast<int>(sample->wi.z * kRows), kRows - 1);
        const int column = std::min(static_cast<int>(turn * kColumns), kColumns - 1);
        ++counts[static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)];
      }
      // What falls below the horizon is known to the quadrature's 10⁻³ only: it is not tested when it is less than 1 %.
      if (expected.back() < 0.01) {
        counts.pop_back();
        expected.pop_back();
      }
      const ChiSquare test = chiSquareTest(counts, expected);
      EXPECT_GT(test.p, sidak(kAlpha, 3 * broad.size()))
          << name << " at cosine " << cosine << ", chi square " << test.statistic << " of " << test.degreesOfFreedom;
    }
  }
}

TEST(Bsdf, IsBlackThroughTheSurface) {
  const Bsdf bsdf = bsdfOf(dielectric(0.5f));
  EXPECT_EQ(bsdf.eval(direction(0.5f), direction(-0.5f)).value, Vec3(0));
  EXPECT_EQ(bsdf.eval(direction(0.5f), direction(-0.5f)).pdf, 0);
  EXPECT_EQ(bsdf.eval(direction(-0.5f), direction(0.5f)).pdf, 0);
  EXPECT_FALSE(bsdf.sample(direction(-0.5f), 0.5f, Vec2(0.5f)));
}

TEST(Bsdf, IsFiniteAtGrazingAngles) {
  for (const auto& [name, material] : materials()) {
    const Bsdf bsdf = bsdfOf(material);
    // A cosine is a dot product of unit vectors: smaller than the square of their rounding it is 0.
    for (const float out : {1e-18f, 1e-7f, 1e-3f}) {
      for (const float in : {1e-18f, 1e-7f, 1e-3f, 1.0f}) {
        for (const float azimuth : {0.4f, 0.4f + kPi}) {
          const Vec3 f = bsdf.eval(direction(out), direction(in, azimuth)).value * in;
          EXPECT_TRUE(isFinite(f)) << name << " " << out << " " << in;
          EXPECT_FALSE(std::isnan(bsdf.eval(direction(out), direction(in, azimuth)).pdf))
              << name << " " << out << " " << in;
        }
      }
      for (const Vec2& u : {Vec2(0), Vec2(0.5f), Vec2(0x1.fffffep-1f), Vec2(0, 0x1.fffffep-1f)}) {
        for (const float lobe : {0.0f, 0x1.fffffep-1f}) {
          const auto sample = bsdf.sample(direction(out), lobe, u);
          if (sample) {
            EXPECT_TRUE(isFinite(sample->value * (sample->wi.z / sample->pdf))) << name << " " << out;
          }
        }
      }
    }
  }
}

TEST(BsdfAt, TexelsMultiplyTheFactorsOfTheirNames) {
  const glm::vec<4, std::uint8_t> texel(200, 120, 90, 160);
  const Vec4 linear = Vec4(texel) / 255.0f;
  const Vec3 decoded(srgbToLinear(linear.x), srgbToLinear(linear.y), srgbToLinear(linear.z));
  Material factors = dielectric(0.8f);
  factors.baseColor = {0.9f, 0.8f, 0.7f, 1};
  factors.metallic = 0.6f;
  factors.specular = 0.9f;
  factors.specularColor = {2, 4, 6};
  const std::pair<TextureUse, std::function<void(Material&)>> uses[] = {
      {TextureUse::kBaseColor, [&](Material& m) { m.baseColor *= Vec4(decoded, linear.w); }},
      {TextureUse::kMetallicRoughness, [&](Material& m) { m.metallic *= linear.z, m.roughness *= linear.y; }},
      {TextureUse::kSpecular, [&](Material& m) { m.specular *= linear.w; }},
      {TextureUse::kSpecularColor, [&](Material& m) { m.specularColor *= decoded; }}};
  const Vec3 wo = direction(0.6f), wi = direction(0.5f, 3);
  const Vec3 without = bsdfOf(factors).eval(wo, wi).value;
  for (const auto& [use, multiply] : uses) {
    Scene scene;
    scene.texels.emplace_back(1, 1, texel);
    scene.textures.push_back({TexelsId{0}});
    Material textured = factors, multiplied = factors;
    textured.setSlot(use, {TextureId{0}});
    multiply(multiplied);
    addTriangle(scene, addMaterial(scene, textured), Vec3(0), {1, 0, 0}, {0, 1, 0});
    const Vec3 value = bsdfAt(scene, {scene.meshes.data(), 0, Vec2(0.3f)}).eval(wo, wi).value;
    const Vec3 expected = bsdfOf(multiplied).eval(wo, wi).value;
    EXPECT_LT(glm::length(value - expected), 1e-5f * glm::length(expected)) << static_cast<int>(use);
    EXPECT_GT(glm::length(value - without), 1e-3f * glm::length(without)) << static_cast<int>(use);
  }
}

}  // namespace
}  // namespace cellcut::test
