#include "renderer/lights/environment_light.h"

#include "renderer/base/rng.h"
#include "renderer/lights/lights.h"
#include "renderer/lights/scalar_emission.h"
#include "tests/support/depth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

#include <functional>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

struct Sky {
  const char* name;
  int width;
  int height;
  std::function<Vec3(int x, int y, Rng& rng)> texel;

  Environment environment() const {
    Rng rng(9);
    Environment result;
    result.radiance = ImageRgb(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) result.radiance.at(x, y) = texel(x, y, rng);
    }
    result.rotation = 1.1f;
    return result;
  }
};

void PrintTo(const Sky& sky, std::ostream* out) {
  *out << sky.name;
}

const Sky kSkies[] = {
    {"One", 1, 1, [](int, int, Rng&) { return Vec3(2); }},
    {"Even", 64, 32, [](int, int, Rng&) { return Vec3(1); }},
    {"Odd", 37, 19, [](int, int, Rng& rng) { return Vec3(rng.uniform()); }},
    {"Column", 1, 17, [](int, int y, Rng&) { return Vec3(static_cast<float>(y)); }},
    {"Row", 33, 1, [](int x, int, Rng&) { return Vec3(static_cast<float>(x)); }},
    {"Sun", 64, 32, [](int x, int y, Rng&) { return x == 40 && y == 9 ? Vec3(1e6f) : Vec3(1e-3f); }},
    {"LoneSun", 64, 32, [](int x, int y, Rng&) { return x == 40 && y == 9 ? Vec3(1e6f) : Vec3(0); }},
    {"PoleAndSeam", 64, 32,
     [](int x, int y, Rng&) { return y == 0 || y == 31 || x == 0 ? Vec3(50, 5, 1) : Vec3(0.01f); }},
    {"Decades", 48, 24, [](int, int, Rng& rng) { return Vec3(std::pow(10.0f, rng.uniform(-5, 5))); }},
    {"SixtyDecades", 48, 24, [](int, int, Rng& rng) { return Vec3(std::pow(10.0f, rng.uniform(-30, 30))); }},
    {"Gradient", 41, 24, [](int x, int, Rng&) { return Vec3(std::pow(10.0f, static_cast<float>(x - 20))); }},
};

class Skies : public testing::TestWithParam<Sky> {
 protected:
  Skies() : environment_(GetParam().environment()), light_(environment_) {}

  Vec3 randomDirection(Rng& rng) const {
    const float z = rng.uniform(-1, 1), azimuth = rng.uniform(0, 2 * kPi), r = safeSqrt(1 - z * z);
    return {r * std::cos(azimuth), z, r * std::sin(azimuth)};
  }
  Environment environment_;
  EnvironmentLight light_;
};

TEST_P(Skies, TilesPartitionTheLitSky) {
  Rng rng(1);
  std::size_t lit = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = randomDirection(rng);
    const Vec2 uv = latLongFromDirection(environment_, direction);
    const auto tile = light_.tileAt(uv);
    const Vec3 radiance = environmentRadiance(environment_, uv);
    if (!tile) {
      ASSERT_EQ(radiance, Vec3(0));
      continue;
    }
    ++lit;
    ASSERT_LT(*tile, light_.tiles().size());
    const EnvironmentTile& t = light_.tiles()[*tile];
    ASSERT_GT(t.weight, 0);
    // Half a chord: an arc cosine would not tell small angles. 10⁻⁶: rounding of the two directions.
    const double chord = 0.5 * glm::length(glm::dvec3(direction) - glm::dvec3(t.axis));
    ASSERT_LE(2 * std::asin(std::min(1.0, chord)), static_cast<double>(t.halfAngle) + 1e-6);
    if (!isBlack(radiance)) {
      ASSERT_GT(light_.pdf(*tile, uv), 0) << "a lit direction that is never sampled";
    }
  }
  EXPECT_GT(lit, 0u);
}

TEST_P(Skies, EveryLitTexelHasATileAndADensity) {
  for (int y = 0; y < environment_.radiance.height(); ++y) {
    for (int x = 0; x < environment_.radiance.width(); ++x) {
      if (isBlack(environment_.radiance.at(x, y))) continue;
      const Vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(environment_.radiance.width()),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(environment_.radiance.height()));
      const auto tile = light_.tileAt(uv);
      ASSERT_TRUE(tile) << x << " " << y;
      ASSERT_GT(light_.pdf(*tile, uv), 0);
    }
  }
}

TEST_P(Skies, WeightsAreTheEnergyOfTheirTiles) {
  // The sum of the tiles against quadrature over the sphere.
  double sum = 0;
  for (const EnvironmentTile& tile : light_.tiles()) sum += tile.weight;
  constexpr int kSide = 600;
  double energy = 0;
  for (int y = 0; y < kSide; ++y) {
    const double polar = std::numbers::pi * (y + 0.5) / kSide;
    for (int x = 0; x < 2 * kSide; ++x) {
      const double azimuth = std::numbers::pi * (x + 0.5) / kSide;
      const glm::dvec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                 std::sin(polar) * std::sin(azimuth));
      energy += scalarEmission(referenceEnvironment(environment_, direction)) * std::sin(polar);
    }
  }
  energy *= std::numbers::pi / kSide * std::numbers::pi / kSide;
  // A weight takes the solid angle as even over its texel, which at the poles it is not: up to 4 % where a pole is all
  // there is to see. The density corrects it.
  EXPECT_NEAR(sum / energy, 1, 0.05);
}

TEST_P(Skies, SamplesCarryTheDensityThatIsQueried) {
  Rng rng(2);
  std::size_t mismatches = 0;
  constexpr std::size_t kSamples = 20000;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const std::size_t tile = rng.below(static_cast<std::uint32_t>(light_.tiles().size()));
    const float u = rng.uniform();
    const EnvironmentLight::Sample sample = light_.sample(tile, {u, rng.uniform()});
    ASSERT_NEAR(glm::length(sample.direction), 1, 1e-5);
    ASSERT_GT(sample.pdf, 0);
    ASSERT_LT(glm::length(directionFromLatLong(environment_, sample.uv) - sample.direction), 1e-6f);
    const Vec2 uv = latLongFromDirection(environment_, sample.direction);
    const auto found = light_.tileAt(uv);
    if (!found || *found != tile || std::abs(light_.pdf(tile, uv) / sample.pdf - 1) > 1e-5f) ++mismatches;
  }
  // A direction within a rounding of a texel's border is its neighbour's: 10⁻⁵ of texels 1/64 of the circle wide.
  EXPECT_LE(mismatches, kSamples / 1000);
}

TEST_P(Skies, SamplesAreDistributedByTheirDensity) {
  // Sum over tiles of L·f/p is the integral: with f a polynomial of the direction that no symmetry of a picture fits.
  const auto f = [](const Vec3& w) { return 1.3f + 0.5f * w.x + 0.3f * w.y * w.z + 0.2f * w.z; };
  Rng rng(3);
  double sum = 0, variance = 0, expected = 0;
  const std::size_t perTile = std::max<std::size_t>(64, sampleShare(200'000) / light_.tiles().size());
  for (std::size_t tile = 0; tile < light_.tiles().size(); ++tile) {
    Moments moments;
    for (std::size_t i = 0; i < perTile; ++i) {
      const float u = rng.uniform();
      const EnvironmentLight::Sample s = light_.sample(tile, {u, rng.uniform()});
      moments.add(
          static_cast<double>(luminance(environmentRadiance(environment_, s.direction)) * f(s.direction) / s.pdf));
    }
    sum += moments.mean();
    variance += moments.meanVariance();
  }
  constexpr int kSide = 800;
  for (int y = 0; y < kSide; ++y) {
    const double polar = std::numbers::pi * (y + 0.5) / kSide;
    for (int x = 0; x < 2 * kSide; ++x) {
      const double azimuth = std::numbers::pi * (x + 0.5) / kSide;
      const glm::dvec3 w(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
      expected += luminance(referenceEnvironment(environment_, w)) * static_cast<double>(f(Vec3(w))) * std::sin(polar);
    }
  }
  expected *= std::numbers::pi / kSide * std::numbers::pi / kSide;
  // The quadrature knows a picture of one bright texel to 10⁻³.
  EXPECT_LT(std::abs(zScore(sum, variance, expected, 1e-6 * expected * expected)), criticalZ(std::size(kSkies)))
      << sum << " against " << expected;
}

TEST_P(Skies, CornersOfTheUnitSquareGiveDirectionsOfTheTile) {
  constexpr float kLast = 0x1.fffffep-1f;
  for (std::size_t tile = 0; tile < light_.tiles().size(); ++tile) {
    for (const Vec2& u : {Vec2(0, 0), Vec2(0, kLast), Vec2(kLast, 0), Vec2(kLast, kLast)}) {
      const EnvironmentLight::Sample sample = light_.sample(tile, u);
      ASSERT_NEAR(glm::length(sample.direction), 1, 1e-5);
      ASSERT_GT(sample.pdf, 0);
      ASSERT_TRUE(std::isfinite(sample.pdf));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Skies, testing::ValuesIn(kSkies), [](const auto& info) { return info.param.name; });

TEST(EnvironmentLight, BlackSkyIsNoLight) {
  Scene scene;
  scene.environment = Environment{ImageRgb(8, 4), 0};
  finish(scene);
  const Lights lights(scene);
  EXPECT_EQ(lights.size(), 0u);
  EXPECT_FALSE(lights.environmentLightAt({0.5f, 0.5f}));
}

TEST(EnvironmentLight, TileThatPeeksOverTheHorizonIsNotLost) {
  // Texels of a large picture are 4e-4 wide: a cone kept as a float's cosine is wrong by a tenth of that.
  for (const int width : {64, 1024, isSixteenth() ? 2048 : 8192}) {
    Scene scene;
    scene.environment = Environment{ImageRgb(width, width / 2), 0.3f};
    const int row = width / 5;
    scene.environment->radiance.at(width / 3, row) = Vec3(1e4f);
    finish(scene);
    const Lights lights(scene);
    Rng rng(4);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (int k = 0; k < 200; ++k) {
        const float u = rng.uniform();
        const auto sample = lights.sample(static_cast<LightId>(i), Vec3(0), {u, rng.uniform()});
        if (!sample) continue;  // the outer halves of the bright texel's neighbours are black
        // The normal of a receiver that sees this direction just above its horizon, and most of the tile below.
        const glm::dvec3 wi(sample->wi), axis(lights.environment()->tiles()[i].axis);
        const glm::dvec3 across = wi - axis * glm::dot(wi, axis);
        if (glm::length(across) < 1e-7) continue;
        const glm::dvec3 n = glm::normalize(glm::normalize(across - wi * glm::dot(across, wi)) + 1e-6 * wi);
        if (!(glm::dot(glm::dvec3(Vec3(n)), wi) > 0)) continue;
        ASSERT_GT(lights.irradiance(static_cast<LightId>(i), Vec3(0), Vec3(n)), 0) << width;
      }
    }
  }
}

TEST(EnvironmentLight, DimTexelAmongBrightOnesKeepsItsDensity) {
  Environment environment{ImageRgb(64, 32, Vec3(1)), 0};
  for (int y = 8; y < 12; ++y) {
    for (int x = 8; x < 12; ++x) environment.radiance.at(x, y) = Vec3(1e-6f);
  }
  const EnvironmentLight light(environment);
  // The 2 by 2 in the middle are dim through and through: 10⁻⁶ of what is around them.
  for (int y = 9; y < 11; ++y) {
    for (int x = 9; x < 11; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5f) / 64, (static_cast<float>(y) + 0.5f) / 32);
      const auto tile = light.tileAt(uv);
      ASSERT_TRUE(tile);
      ASSERT_GT(light.pdf(*tile, uv), 0);
    }
  }
}

TEST(EnvironmentLight, TexelsTooDimForADensityAreNotSampled) {
  // Beside a sun a tile of 57 decades, dimmest where the numbers are 0.
  Scene scene;
  scene.environment = Environment{ImageRgb(64, 32, Vec3(1e-30f)), 0};
  scene.environment->radiance.at(40, 16) = Vec3(1e30f);
  for (int y = 16; y < 24; ++y) {
    for (int x = 8; x < 16; ++x) {
      scene.environment->radiance.at(x, y) = Vec3(std::pow(10.0f, static_cast<float>(8 * (x - 11) - 7)));
    }
  }
  finish(scene);
  const Lights lights(scene);
  std::size_t none = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto sample = lights.sample(static_cast<LightId>(i), Vec3(0), Vec2(0));
    none += !sample;
    EXPECT_TRUE(!sample || sample->pdf > 0);
  }
  EXPECT_GT(none, 0u);
}

TEST(EnvironmentLight, DensitiesOfADimSkyAreThoseOfABrightOne) {
  const auto sky = [](float radiance) {
    Environment environment;
    environment.radiance = ImageRgb(2048, 1024);
    for (Vec3& texel : environment.radiance) texel = Vec3(0);
    // Beside the pole, where a texel's solid angle is smallest, and near the equator.
    environment.radiance.at(100, 1) = environment.radiance.at(1000, 450) = Vec3(radiance);
    return environment;
  };
  const Environment bright = sky(1);
  const EnvironmentLight reference(bright);
  for (const int exponent : {-100, -140, 100}) {
    const Environment scaled = sky(std::ldexp(1.0f, exponent));
    const EnvironmentLight light(scaled);
    ASSERT_EQ(light.tiles().size(), reference.tiles().size());
    for (std::size_t i = 0; i < light.tiles().size(); ++i) {
      const EnvironmentLight::Sample sample = light.sample(i, Vec2(0.5f)), expected = reference.sample(i, Vec2(0.5f));
      EXPECT_EQ(sample.uv, expected.uv);
      EXPECT_EQ(sample.pdf, expected.pdf);
      EXPECT_EQ(light.pdf(i, sample.uv), expected.pdf);
      EXPECT_TRUE(std::isfinite(sample.pdf));
      EXPECT_EQ(light.tiles()[i].weight, std::ldexp(reference.tiles()[i].weight, exponent));
    }
  }
}

}  // namespace
}  // namespace cellcut::test
