/// \file palette.h
/// The paints and the light colours of the recipes, as materials of a file that come into being when first used.
#pragma once

#include "renderer/scene/recipes/glb_builder.h"

#include <array>
#include <map>
#include <optional>
#include <tuple>

namespace cellcut {

enum class Paint : std::uint8_t {
  kCeiling,
  kPlaster,
  kCream,
  kSage,
  kSky,
  kRose,
  kOchre,
  kSlate,
  kBrick,
  kSandstone,
  kConcrete,  // walls
  kOak,
  kWalnut,
  kStone,
  kTerracotta,
  kParquet,
  kMarble,  // floors
  kBlackCloth,
  kRedCloth,
  kBlueCloth,
  kGreenCloth,
  kMustardCloth,
  kWhiteCloth,  // textiles
  kShade,
  kLeaf,
  kBark,
  kSoil,
  kPaper,
  kGround,
  kRoof,
  kGlaze,
  kGlazeBlue,
  kGlazeRed,
  kGold,
  kSteel,
  kCopper,
  kBlackMetal,
  kWetAsphalt,
  kDarkGlass,
  kWater,
  kCount
};

enum class Tint : std::uint8_t {
  kCandle,
  kWarm,
  kSoft,
  kNeutral,
  kCool,
  kAmber,
  kRed,
  kGreen,
  kTeal,
  kBlue,
  kMagenta,
  kCount
};

/// Linear Rec. 709 of luminance 1.
Vec3 tintColor(Tint tint);

class Palette {
 public:
  explicit Palette(GlbBuilder& builder) : builder_(builder) {}

  GlbBuilder& builder() { return builder_; }
  Surface& flat(Paint paint) { return builder_.flat(material(paint)); }
  Surface& smooth(Paint paint) { return builder_.smooth(material(paint)); }

  /// Flat surface that emits `radiance` W/(m² sr) of luminance, snapped to five levels per decade so that a million
  /// lamps share a few hundred materials; from both sides if asked. Each triangle added to it is a light.
  Surface& emitter(Tint tint, float radiance, bool bothSides = false);
  /// The same for lights with a node of their own, where equal strengths share a definition.
  /// \param intensity W/sr
  Vec3 intensity(Tint tint, float intensity) const;

 private:
  GlbMaterialId material(Paint paint);

  GlbBuilder& builder_;
  std::array<std::optional<GlbMaterialId>, static_cast<std::size_t>(Paint::kCount)> paints_;
  std::map<std::tuple<Tint, int, bool>, GlbMaterialId> emitters_;  ///< by tint, level and sides
};

}  // namespace cellcut
