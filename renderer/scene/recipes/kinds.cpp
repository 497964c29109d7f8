#include "renderer/base/image_io.h"
#include "renderer/scene/recipes/builders.h"
#include "renderer/scene/recipes/furniture.h"
#include "renderer/scene/recipes/lamps.h"

#include <algorithm>
#include <cmath>

namespace cellcut {

namespace {

// A terrace of 9 m × 7 m with a wall behind (−z) and one on the left (−x), a pergola over its back half and a basin.
constexpr float kHalfWidth = 4.5f;
constexpr float kRear = -3.5f;
constexpr float kFrontEdge = 3.5f;
constexpr float kWallHeight = 2.9f;
constexpr float kBeamHeight = 2.75f;
constexpr float kPergolaFront = 0.4f;
constexpr std::size_t kMostPunctual = 20'000;  ///< of points and of spots: a node each
const Vec3 kSunAxis{-0.80f, -0.30f, -0.52f};   ///< low over the right front: long shadows

/// How N lights are shared out.
struct Shares {
  std::size_t points = 0, spots = 0, triangles = 0, directional = 0;
};

Shares shareOut(std::size_t lights) {
  Shares s;
  if (lights < 8) {  // in turn, so that each kind exists as early as possible
    s.points = (lights + 3) / 4;
    s.triangles = (lights + 2) / 4;
    s.spots = (lights + 1) / 4;
    s.directional = lights / 4;
    return s;
  }
  s.directional = 1;
  s.points = std::min(lights / 5, kMostPunctual);
  s.spots = std::min(lights / 5, kMostPunctual);
  s.triangles = lights - s.directional - s.points - s.spots;
  return s;
}

/// The sky after sunset, as a picture that wraps around: warm and bright where the sun is, deep blue overhead.
std::vector<std::byte> duskSky() {
  constexpr int kWidth = 128, kHeight = 64;
  LayeredImage image{kWidth, kHeight, {{"", {"R", "G", "B"}, {}}}, {}};
  const Vec3 toSun = -glm::normalize(kSunAxis);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float theta = kPi * (static_cast<float>(y) + 0.5f) / kHeight;
      const float phi = 2 * kPi * ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f);  // see environment.h
      const Vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      Vec3 sky(0.012f, 0.011f, 0.012f);  // below the horizon: dark land
      if (d.y > 0) {
        const float towards =
            0.5f + 0.5f * glm::dot(glm::normalize(Vec3(d.x, 0, d.z)), glm::normalize(Vec3(toSun.x, 0, toSun.z)));
        const float low = std::exp(-5 * d.y), glow = std::exp(-11 * d.y) * towards * towards;
        sky = Vec3(0.065f, 0.110f, 0.280f) + low * Vec3(0.22f, 0.18f, 0.26f) + glow * Vec3(2.0f, 0.80f, 0.26f);
      }
      for (int c = 0; c < 3; ++c) image.layers[0].values.push_back(sky[c]);
    }
  }
  return encodeExr(image);
}

/// A glowing picture: a red sun behind hills.
std::vector<std::byte> posterPng() {
  constexpr int kWidth = 160, kHeight = 96;
  ImageRgba8 image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float u = static_cast<float>(x) / kWidth, v = static_cast<float>(y) / kHeight;
      Vec3 c = glm::mix(Vec3(40, 60, 140), Vec3(255, 170, 80), v);
      const Vec2 fromSun((u - 0.62f) * 1.67f, v - 0.52f);
      if (glm::dot(fromSun, fromSun) < 0.045f && static_cast<int>(v * 40) % 4 != 0) c = {255, 80, 50};
      if (v > 0.62f + 0.10f * std::sin(7 * u)) c = {110, 40, 90};
      if (v > 0.76f + 0.07f * std::sin(11 * u + 2)) c = {40, 18, 60};
      image.at(x, y) = {static_cast<std::uint8_t>(c.x), static_cast<std::uint8_t>(c.y), static_cast<std::uint8_t>(c.z),
                        255};
    }
  }
  return encodePng(image);
}

class Terrace {
 public:
  Terrace(GlbBuilder& builder, std::uint64_t seed)
      : builder_(builder), palette_(builder), rng_(hashOf(seed, 0x71d5u)) {}
  void addStructure();
  void addFurniture();
  void addPoints(std::size_t count, float flux);
  void addSpots(std::size_t count, float flux);
  void addTriangles(std::size_t count, float flux);

 private:
  void addPoster(float flux);
  void addSheet(float flux);
  void addBulbs(std::size_t bulbs, float flux);

  GlbBuilder& builder_;
  Palette palette_;
  Rng rng_;
};

void Terrace::addStructure() {
  // The ground is open where the terrace stands, so that nothing lies in anything else.
  addQuad(palette_.flat(Paint::kGround), {-60, -0.3f, 60}, {60, -0.3f, 60}, {60, -0.3f, -60}, {-60, -0.3f, -60});
  addBox(palette_.flat(Paint::kConcrete), {}, {-kHalfWidth, -0.3f, kRear}, {kHalfWidth, 0, kFrontEdge}, kTop | kBottom);
  constexpr int kAcross = 12, kDeep = 10;
  const float w = 2 * kHalfWidth / kAcross, d = (kFrontEdge - kRear) / kDeep;
  for (int i = 0; i < kAcross; ++i) {
    for (int k = 0; k < kDeep; ++k) {
      const float x = -kHalfWidth + static_cast<float>(i) * w, z = kRear + static_cast<float>(k) * d;
      const Paint paint = (i + k) % 2 == 0 ? Paint::kStone : Paint::kTerracotta;
      addQuad(palette_.flat(paint), {x, 0, z + d}, {x + w, 0, z + d}, {x + w, 0, z}, {x, 0, z});
    }
  }
  constexpr float kThick = 0.25f;
  addBox(palette_.flat(Paint::kPlaster), {}, {-kHalfWidth - kThick, -0.3f, kRear - kThick},
         {kHalfWidth, kWallHeight, kRear}, kBottom);
  addBox(palette_.flat(Paint::kOchre), {}, {-kHalfWidth - kThick, -0.3f, kRear + 0.001f},
         {-kHalfWidth, kWallHeight, kPergolaFront + 1}, kBottom);
  Surface& wood = palette_.flat(Paint::kWalnut);
  addBox(wood, {}, {-kHalfWidth, kBeamHeight, kPergolaFront - 0.06f},
         {kHalfWidth, kBeamHeight + 0.16f, kPergolaFront + 0.06f});
  for (const float x : {0.75f, kHalfWidth - 0.1f}) {
    addBox(wood, {}, {x - 0.06f, 0, kPergolaFront - 0.05f}, {x + 0.06f, kBeamHeight, kPergolaFront + 0.05f},
           kTop | kBottom);
  }
  for (int i = 0; i < 10; ++i) {
    const float x = -kHalfWidth + 0.4f + 0.9f * static_cast<float>(i);
    addBox(wood, {}, {x - 0.035f, kBeamHeight + 0.161f, kRear + 0.01f},
           {x + 0.035f, kBeamHeight + 0.30f, kPergolaFront + 0.35f});
  }
  // The basin: a rim around water.
  const Pose basin{{2.3f, 0, 2.0f}};
  for (int k = 0; k < 4; ++k) {
    const float half = k % 2 == 0 ? 1.5f : 0.9f, across = k % 2 == 0 ? 0.9f : 1.5f;
    addBox(palette_.flat(Paint::kSandstone), basin.at({0, 0, 0}, 0.5f * kPi * static_cast<float>(k)),
           {-half + 0.001f, 0, across - 0.2f}, {half - 0.201f, 0.32f, across}, kBottom);
  }
  addQuad(palette_.flat(Paint::kWater), basin.point({-1.4f, 0.24f, 0.8f}), basin.point({1.4f, 0.24f, 0.8f}),
          basin.point({1.4f, 0.24f, -0.8f}), basin.point({-1.4f, 0.24f, -0.8f}));
}

void Terrace::addFurniture() {
  addDiningTable(palette_, Pose::turned({-1.6f, 0, -0.6f}, 0.25f), rng_);
  addPlant(palette_, {{-4.0f, 0, -3.0f}}, 1.9f, rng_);
  addPlant(palette_, {{4.0f, 0, -3.0f}}, 1.6f, rng_);
  addPlant(palette_, {{-3.9f, 0, 2.4f}}, 1.1f, rng_);
  addPedestal(palette_, {{1.9f, 0, -2.8f}}, rng_);
  addBox(palette_.flat(Paint::kPlaster), {{3.5f, 0, -0.9f}}, {-0.2f, 0, -0.2f}, {0.2f, 0.7f, 0.2f}, kBottom);
  addSphere(palette_.smooth(Paint::kGold), {3.5f, 0.701f + 0.3f, -0.9f}, 0.3f, 24, 48);
  addSphere(palette_.smooth(Paint::kGlaze), {-0.3f, 0.22f, 2.3f}, 0.22f, 20, 40);
  addSphere(palette_.smooth(Paint::kGlazeBlue), {-0.95f, 0.15f, 2.6f}, 0.15f, 20, 40);
  addSphere(palette_.smooth(Paint::kPaper), {-0.5f, 0.1f, 2.85f}, 0.1f, 16, 32);
}

/// The first few hang in lanterns, further ones are fireflies.
void Terrace::addPoints(std::size_t count, float flux) {
  static constexpr std::array<Vec2, 5> kLanterns{Vec2{-3.2f, -2.2f}, Vec2{2.6f, -1.6f}, Vec2{-0.5f, -2.4f},
                                                 Vec2{-3.4f, 0.2f}, Vec2{1.2f, -0.4f}};
  static constexpr std::array kTints{Tint::kGreen, Tint::kAmber, Tint::kTeal, Tint::kSoft};
  const std::size_t lanterns = std::min(count, kLanterns.size());
  const float each = 0.8f * flux / static_cast<float>(kLanterns.size());
  for (std::size_t i = 0; i < lanterns; ++i) {
    const Pose beam{{kLanterns[i].x, kBeamHeight, kLanterns[i].y}};
    addLantern(palette_, beam, 0.75f, {i == 2 ? Tint::kCool : Tint::kWarm, each});
  }
  const std::size_t rest = count - lanterns;
  for (std::size_t i = 0; i < rest; ++i) {
    const Vec3 at(rng_.uniform(-4.2f, 4.4f), rng_.uniform(0.45f, 2.4f), rng_.uniform(0.8f, 3.4f));
    const float share = 0.2f * flux / static_cast<float>(rest) * std::pow(10.0f, rng_.uniform(-1.5f, 0.4f));
    builder_.addPoint(at, palette_.intensity(kTints[rng_.below(kTints.size())], share / (4 * kPi)));
  }
}

/// Cans under the pergola that wash the walls; from the ninth on bare spots along its beams.
void Terrace::addSpots(std::size_t count, float flux) {
  constexpr std::size_t kCans = 8;
  static constexpr std::array kTints{Tint::kSoft, Tint::kMagenta, Tint::kSoft, Tint::kTeal,
                                     Tint::kWarm, Tint::kBlue,    Tint::kSoft, Tint::kAmber};
  const std::size_t cans = std::min(count, kCans);
  for (std::size_t i = 0; i < cans; ++i) {
    const float x = -3.7f + 1.05f * static_cast<float>((3 * i) % kCans);  // spread however few there are
    const Pose beam{{x, kBeamHeight, kRear + 0.75f}};
    addSpotCan(palette_, beam, {x, 0.9f, kRear}, {kTints[i], 0.7f * flux / static_cast<float>(kCans)});
  }
  const std::size_t rest = count - cans;
  for (std::size_t i = 0; i < rest; ++i) {
    const Vec3 at(rng_.uniform(-kHalfWidth + 0.2f, kHalfWidth - 0.2f), kBeamHeight - 0.03f,
                  rng_.uniform(kRear + 0.3f, kPergolaFront - 0.1f));
    const Vec3 axis(rng_.uniform(-0.7f, 0.7f), -1, rng_.uniform(-0.7f, 0.7f));
    const float share = 0.3f * flux / static_cast<float>(rest) * std::pow(10.0f, rng_.uniform(-1.5f, 0.4f));
    builder_.addSpot(at, axis, palette_.intensity(kTints[rng_.below(kTints.size())], share), 0.15f, 0.45f);
  }
}

/// The textured emitter. Lights: 2.
void Terrace::addPoster(float flux) {
  const Vec2 half(1.0f, 0.6f);
  const Pose wall{{-1.4f, 1.5f, kRear}};
  addBox(palette_.flat(Paint::kBlackMetal), wall, {-half.x - 0.05f, -half.y - 0.05f, 0},
         {half.x + 0.05f, half.y + 0.05f, 0.06f}, kBack);
  constexpr float kMeanTexel = 0.2f;  // of the poster's luminance, about
  const GlbMaterialId glow = builder_.addMaterial({.name = "poster",
                                                   .baseColor = Vec3(0.05f),
                                                   .emission = Vec3(radianceOf(flux, 4 * half.x * half.y) / kMeanTexel),
                                                   .emissionTexture = builder_.addPng(posterPng())});
  Surface& s = builder_.flat(glow);
  const auto at = [&](float x, float y) { return wall.point({x, y, 0.064f}); };
  addQuad(s, at(-half.x, -half.y), at(half.x, -half.y), at(half.x, half.y), at(-half.x, half.y));
  s.texCoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
}

/// A hanging sheet of paper that glows to both sides. Lights: 2.
void Terrace::addSheet(float flux) {
  const Pose pose = Pose::turned({1.2f, 1.3f, -1.9f}, 0.5f);
  Surface& wood = palette_.flat(Paint::kWalnut);
  for (const float y : {-0.70f, 0.66f}) addBox(wood, pose, {-0.4f, y, -0.015f}, {0.4f, y + 0.04f, 0.015f});
  Surface& light = palette_.emitter(Tint::kCandle, radianceOf(flux, 2 * 0.7f * 1.3f), true);
  addQuad(light, pose.point({-0.35f, -0.65f, 0}), pose.point({0.35f, -0.65f, 0}), pose.point({0.35f, 0.65f, 0}),
          pose.point({-0.35f, 0.65f, 0}));
}

/// Strings between the wall and the pergola's front. Lights: kFairyLights each.
void Terrace::addBulbs(std::size_t bulbs, float flux) {
  const std::size_t strings = std::clamp<std::size_t>(bulbs / 12, 1, 4000);
  const float radius = std::min(0.028f, 2.0f / std::sqrt(static_cast<float>(bulbs)));
  std::size_t placed = 0;
  for (std::size_t i = 0; i < strings; ++i) {
    const std::size_t here = bulbs * (i + 1) / strings - placed;
    placed += here;
    const float x = -4.2f + 8.4f * (static_cast<float>(i) + 0.5f) / static_cast<float>(strings);
    addFairyString(palette_, {x, kBeamHeight - 0.05f, kRear + 0.1f},
                   {-0.7f * x, kBeamHeight - 0.05f, kPergolaFront - 0.1f}, 0.35f, here, radius,
                   {Tint::kWarm, flux * static_cast<float>(here) / static_cast<float>(bulbs)}, i % 2 == 0);
  }
}

void Terrace::addTriangles(std::size_t count, float flux) {
  if (count >= 2) {
    addPoster(0.45f * flux);
    count -= 2;
  }
  if (count >= 2) {
    addSheet(0.2f * flux);
    count -= 2;
  }
  for (; count % kFairyLights != 0; --count) {
    const Pose wall{{-kHalfWidth, 1.2f + 0.5f * static_cast<float>(count % kFairyLights), -1.5f}, {0, 0, -1}};
    addTriangleLamp(palette_, wall, 0.3f, {Tint::kMagenta, 0.05f * flux});
  }
  if (count > 0) addBulbs(count / kFairyLights, 0.3f * flux);
}

}  // namespace

void buildKinds(GlbBuilder& builder, std::size_t lights, std::uint64_t seed) {
  builder.addCamera("terrace", {1.6f, 1.65f, 6.2f}, {-0.4f, 1.05f, -1.2f}, 0.82f);
  builder.addCamera("basin", {4.3f, 1.1f, 4.6f}, {0.2f, 0.7f, -1}, 0.8f);
  Terrace terrace(builder, seed);
  terrace.addStructure();
  terrace.addFurniture();
  const Shares shares = shareOut(lights);
  if (shares.directional > 0) builder.addDirectional(kSunAxis, Vec3(1.0f, 0.55f, 0.25f) * 1.1f);
  terrace.addPoints(shares.points, 80);
  terrace.addSpots(shares.spots, 70);
  terrace.addTriangles(shares.triangles, 50);
  builder.setEnvironment(duskSky());
}

}  // namespace cellcut
