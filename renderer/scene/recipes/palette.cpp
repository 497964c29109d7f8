#include "renderer/scene/recipes/palette.h"

#include <cassert>
#include <string>

namespace cellcut {

namespace {

constexpr float kLevelsPerDecade = 5;

enum class Finish : std::uint8_t {
  kMatte,   ///< exactly Lambertian
  kCloth,   ///< the same, of thin sheets that are seen from both sides
  kGlossy,  ///< a dielectric's coat
  kMetal,
  kMetalSheet  ///< seen from both sides
};

struct PaintRow {
  Paint paint;
  const char* name;
  Vec3 color;
  Finish finish;
  float roughness = 1;
};

constexpr std::array kPaints{
    PaintRow{Paint::kCeiling, "ceiling", {0.78f, 0.77f, 0.74f}, Finish::kMatte},
    PaintRow{Paint::kPlaster, "plaster", {0.72f, 0.70f, 0.66f}, Finish::kMatte},
    PaintRow{Paint::kCream, "cream wall", {0.72f, 0.62f, 0.46f}, Finish::kMatte},
    PaintRow{Paint::kSage, "sage wall", {0.36f, 0.46f, 0.34f}, Finish::kMatte},
    PaintRow{Paint::kSky, "sky wall", {0.36f, 0.50f, 0.62f}, Finish::kMatte},
    PaintRow{Paint::kRose, "rose wall", {0.66f, 0.38f, 0.34f}, Finish::kMatte},
    PaintRow{Paint::kOchre, "ochre wall", {0.64f, 0.42f, 0.16f}, Finish::kMatte},
    PaintRow{Paint::kSlate, "slate wall", {0.22f, 0.26f, 0.34f}, Finish::kMatte},
    PaintRow{Paint::kBrick, "brick", {0.42f, 0.18f, 0.12f}, Finish::kMatte},
    PaintRow{Paint::kSandstone, "sandstone", {0.56f, 0.46f, 0.34f}, Finish::kMatte},
    PaintRow{Paint::kConcrete, "concrete", {0.40f, 0.40f, 0.39f}, Finish::kMatte},
    PaintRow{Paint::kOak, "oak", {0.50f, 0.32f, 0.17f}, Finish::kMatte},
    PaintRow{Paint::kWalnut, "walnut", {0.22f, 0.12f, 0.07f}, Finish::kMatte},
    PaintRow{Paint::kStone, "stone", {0.46f, 0.44f, 0.41f}, Finish::kMatte},
    PaintRow{Paint::kTerracotta, "terracotta", {0.52f, 0.23f, 0.13f}, Finish::kMatte},
    PaintRow{Paint::kParquet, "parquet", {0.34f, 0.19f, 0.09f}, Finish::kGlossy, 0.38f},
    PaintRow{Paint::kMarble, "polished marble", {0.42f, 0.39f, 0.36f}, Finish::kGlossy, 0.22f},
    PaintRow{Paint::kBlackCloth, "black cloth", {0.06f, 0.06f, 0.07f}, Finish::kCloth},
    PaintRow{Paint::kRedCloth, "red cloth", {0.50f, 0.07f, 0.06f}, Finish::kCloth},
    PaintRow{Paint::kBlueCloth, "blue cloth", {0.08f, 0.16f, 0.42f}, Finish::kCloth},
    PaintRow{Paint::kGreenCloth, "green cloth", {0.08f, 0.28f, 0.16f}, Finish::kCloth},
    PaintRow{Paint::kMustardCloth, "mustard cloth", {0.60f, 0.38f, 0.07f}, Finish::kCloth},
    PaintRow{Paint::kWhiteCloth, "white cloth", {0.74f, 0.72f, 0.68f}, Finish::kCloth},
    PaintRow{Paint::kShade, "lamp shade", {0.70f, 0.64f, 0.54f}, Finish::kCloth},
    PaintRow{Paint::kLeaf, "leaf", {0.10f, 0.30f, 0.07f}, Finish::kCloth},
    PaintRow{Paint::kBark, "bark", {0.18f, 0.12f, 0.08f}, Finish::kMatte},
    PaintRow{Paint::kSoil, "soil", {0.08f, 0.05f, 0.03f}, Finish::kMatte},
    PaintRow{Paint::kPaper, "paper", {0.76f, 0.73f, 0.66f}, Finish::kMatte},
    PaintRow{Paint::kGround, "ground", {0.14f, 0.14f, 0.13f}, Finish::kMatte},
    PaintRow{Paint::kRoof, "roof", {0.12f, 0.10f, 0.10f}, Finish::kMatte},
    PaintRow{Paint::kGlaze, "white glaze", {0.70f, 0.69f, 0.66f}, Finish::kGlossy, 0.15f},
    PaintRow{Paint::kGlazeBlue, "blue glaze", {0.05f, 0.15f, 0.40f}, Finish::kGlossy, 0.15f},
    PaintRow{Paint::kGlazeRed, "red glaze", {0.42f, 0.05f, 0.04f}, Finish::kGlossy, 0.2f},
    PaintRow{Paint::kGold, "gold", {1.00f, 0.77f, 0.34f}, Finish::kMetal, 0.28f},
    PaintRow{Paint::kSteel, "brushed steel", {0.56f, 0.57f, 0.58f}, Finish::kMetal, 0.42f},
    PaintRow{Paint::kCopper, "copper", {0.95f, 0.64f, 0.54f}, Finish::kMetalSheet, 0.35f},
    PaintRow{Paint::kBlackMetal, "black iron", {0.10f, 0.10f, 0.10f}, Finish::kMetal, 0.5f},
    PaintRow{Paint::kWetAsphalt, "wet asphalt", {0.045f, 0.046f, 0.05f}, Finish::kGlossy, 0.24f},
    PaintRow{Paint::kDarkGlass, "dark window", {0.012f, 0.014f, 0.018f}, Finish::kGlossy, 0.12f},
    PaintRow{Paint::kWater, "water", {0.01f, 0.04f, 0.05f}, Finish::kGlossy, 0.08f},
};
static_assert(kPaints.size() == static_cast<std::size_t>(Paint::kCount));

GlbMaterial describe(Paint paint) {
  const PaintRow& row = kPaints[static_cast<std::size_t>(paint)];
  assert(row.paint == paint);
  const bool metal = row.finish == Finish::kMetal || row.finish == Finish::kMetalSheet;
  return {.name = row.name,
          .baseColor = row.color,
          .metallic = metal ? 1.0f : 0.0f,
          .roughness = row.roughness,
          .specular = metal || row.finish == Finish::kGlossy ? 1.0f : 0.0f,
          .doubleSided = row.finish == Finish::kCloth || row.finish == Finish::kMetalSheet};
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
