#include "renderer/scene/recipes/palette.h"

#include <string>

namespace cellcut {

namespace {

constexpr float kLevelsPerDecade = 5;

/// Exactly Lambertian.
GlbMaterial matte(const char* name, Vec3 color) {
  return {.name = name, .baseColor = color};
}
GlbMaterial cloth(const char* name, Vec3 color) {
  return {.name = name, .baseColor = color, .doubleSided = true};
}
GlbMaterial glossy(const char* name, Vec3 color, float roughness) {
  return {.name = name, .baseColor = color, .roughness = roughness, .specular = 1};
}
GlbMaterial metal(const char* name, Vec3 color, float roughness) {
  return {.name = name, .baseColor = color, .metallic = 1, .roughness = roughness, .specular = 1};
}

GlbMaterial describe(Paint paint) {
  switch (paint) {
    case Paint::kCeiling:
      return matte("ceiling", {0.78f, 0.77f, 0.74f});
    case Paint::kPlaster:
      return matte("plaster", {0.72f, 0.70f, 0.66f});
    case Paint::kCream:
      return matte("cream wall", {0.72f, 0.62f, 0.46f});
    case Paint::kSage:
      return matte("sage wall", {0.36f, 0.46f, 0.34f});
    case Paint::kSky:
      return matte("sky wall", {0.36f, 0.50f, 0.62f});
    case Paint::kRose:
      return matte("rose wall", {0.66f, 0.38f, 0.34f});
    case Paint::kOchre:
      return matte("ochre wall", {0.64f, 0.42f, 0.16f});
    case Paint::kSlate:
      return matte("slate wall", {0.22f, 0.26f, 0.34f});
    case Paint::kBrick:
      return matte("brick", {0.42f, 0.18f, 0.12f});
    case Paint::kSandstone:
      return matte("sandstone", {0.56f, 0.46f, 0.34f});
    case Paint::kConcrete:
      return matte("concrete", {0.40f, 0.40f, 0.39f});
    case Paint::kDarkWall:
      return matte("dark wall", {0.16f, 0.15f, 0.16f});
    case Paint::kOak:
      return matte("oak", {0.50f, 0.32f, 0.17f});
    case Paint::kWalnut:
      return matte("walnut", {0.22f, 0.12f, 0.07f});
    case Paint::kStone:
      return matte("stone", {0.46f, 0.44f, 0.41f});
    case Paint::kTerracotta:
      return matte("terracotta", {0.52f, 0.23f, 0.13f});
    case Paint::kParquet:
      return glossy("parquet", {0.34f, 0.19f, 0.09f}, 0.38f);
    case Paint::kMarble:
      return glossy("polished marble", {0.42f, 0.39f, 0.36f}, 0.22f);
    case Paint::kBlackCloth:
      return cloth("black cloth", {0.06f, 0.06f, 0.07f});
    case Paint::kRedCloth:
      return cloth("red cloth", {0.50f, 0.07f, 0.06f});
    case Paint::kBlueCloth:
      return cloth("blue cloth", {0.08f, 0.16f, 0.42f});
    case Paint::kGreenCloth:
      return cloth("green cloth", {0.08f, 0.28f, 0.16f});
    case Paint::kMustardCloth:
      return cloth("mustard cloth", {0.60f, 0.38f, 0.07f});
    case Paint::kWhiteCloth:
      return cloth("white cloth", {0.74f, 0.72f, 0.68f});
    case Paint::kShade:
      return cloth("lamp shade", {0.70f, 0.64f, 0.54f});
    case Paint::kLeaf:
      return cloth("leaf", {0.10f, 0.30f, 0.07f});
    case Paint::kBark:
      return matte("bark", {0.18f, 0.12f, 0.08f});
    case Paint::kSoil:
      return matte("soil", {0.08f, 0.05f, 0.03f});
    case Paint::kPaper:
      return matte("paper", {0.76f, 0.73f, 0.66f});
    case Paint::kGround:
      return matte("ground", {0.14f, 0.14f, 0.13f});
    case Paint::kRoof:
      return matte("roof", {0.12f, 0.10f, 0.10f});
    case Paint::kGlaze:
      return glossy("white glaze", {0.70f, 0.69f, 0.66f}, 0.15f);
    case Paint::kGlazeBlue:
      return glossy("blue glaze", {0.05f, 0.15f, 0.40f}, 0.15f);
    case Paint::kGlazeRed:
      return glossy("red glaze", {0.42f, 0.05f, 0.04f}, 0.2f);
    case Paint::kGold:
      return metal("gold", {1.00f, 0.77f, 0.34f}, 0.28f);
    case Paint::kSteel:
      return metal("brushed steel", {0.56f, 0.57f, 0.58f}, 0.42f);
    case Paint::kCopper: {
      GlbMaterial copper = metal("copper", {0.95f, 0.64f, 0.54f}, 0.35f);
      copper.doubleSided = true;  // lamp shades are a thin sheet of it
      return copper;
    }
    case Paint::kBlackMetal:
      return metal("black iron", {0.10f, 0.10f, 0.10f}, 0.5f);
    case Paint::kWetAsphalt:
      return glossy("wet asphalt", {0.045f, 0.046f, 0.05f}, 0.24f);
    case Paint::kDarkGlass:
      return glossy("dark window", {0.012f, 0.014f, 0.018f}, 0.12f);
    case Paint::kWater:
      return glossy("water", {0.01f, 0.04f, 0.05f}, 0.08f);
    case Paint::kCount:
      break;
  }
  return {};
}

constexpr std::array<const char*, static_cast<std::size_t>(Tint::kCount)> kTintNames{
    "candle", "warm", "soft", "neutral", "cool", "amber", "red", "green", "teal", "blue", "magenta"};

int levelOf(float value) {
  return static_cast<int>(std::lround(kLevelsPerDecade * std::log10(value)));
}
float valueOf(int level) {
  return std::pow(10.0f, static_cast<float>(level) / kLevelsPerDecade);
}

}  // namespace

Vec3 tintColor(Tint tint) {
  // Not black bodies, which on a display without white balance are far too orange: pleasant lamps.
  static constexpr std::array<Vec3, static_cast<std::size_t>(Tint::kCount)> kColors{
      Vec3{1, 0.52f, 0.18f},   Vec3{1, 0.68f, 0.38f}, Vec3{1, 0.80f, 0.58f}, Vec3{1, 0.92f, 0.82f},
      Vec3{0.78f, 0.9f, 1},    Vec3{1, 0.42f, 0.05f}, Vec3{1, 0.10f, 0.06f}, Vec3{0.2f, 1, 0.3f},
      Vec3{0.08f, 0.8f, 0.9f}, Vec3{0.12f, 0.28f, 1}, Vec3{1, 0.12f, 0.62f}};
  const Vec3 color = kColors[static_cast<std::size_t>(tint)];
  return color / luminance(color);
}

GlbMaterialId Palette::material(Paint paint) {
  std::optional<GlbMaterialId>& id = paints_[static_cast<std::size_t>(paint)];
  if (!id) id = builder_.addMaterial(describe(paint));
  return *id;
}

Surface& Palette::emitter(Tint tint, float radiance, bool bothSides) {
  const int level = levelOf(radiance);
  const auto [entry, isNew] = emitters_.try_emplace({tint, level, bothSides});
  if (isNew) {
    entry->second = builder_.addMaterial({.name = std::string(kTintNames[static_cast<std::size_t>(tint)]) + " light",
                                          .baseColor = Vec3(0.2f),
                                          .emission = tintColor(tint) * valueOf(level),
                                          .doubleSided = bothSides});
  }
  return builder_.flat(entry->second);
}

Vec3 Palette::intensity(Tint tint, float intensity) const {
  return tintColor(tint) * valueOf(levelOf(intensity));
}

}  // namespace cellcut
