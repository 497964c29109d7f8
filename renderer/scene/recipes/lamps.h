/// \file lamps.h
/// Lamps of the recipes. Each adds an exact number of lights, stated with it, whose flux together is near Glow::flux
/// (strengths are snapped to the palette's levels).
///
/// Space: metres. A pose stands where the lamp is fixed: on the ceiling (the lamp hangs down), on the floor, or on a
/// wall with local z away from it.
#pragma once

#include "renderer/scene/recipes/palette.h"

namespace cellcut {

struct Glow {
  Tint tint = Tint::kWarm;
  float flux = 1;  ///< W, of the whole lamp
};

/// Radiance of a diffuse emitter.
/// \param flux W
/// \param area m²
/// \return W/(m² sr)
inline float radianceOf(float flux, float area) {
  return flux / (kPi * area);
}

inline constexpr std::size_t kPanelPaneLights = 2;
/// Flat panel under the ceiling, cut into `panes` along local x. Lights: kPanelPaneLights each.
void addCeilingPanel(Palette& palette, const Pose& ceiling, Vec2 size, int panes, Glow glow);

inline constexpr std::size_t kBulbLights = 8;
/// Bulb in a shade that is open above and below, on a cord. Lights: kBulbLights.
void addPendant(Palette& palette, const Pose& ceiling, float drop, Paint shade, Glow glow);
/// Bulb in a drum shade on a pole. Lights: kBulbLights.
void addFloorLamp(Palette& palette, const Pose& floor, float height, Paint shade, Glow glow);

inline constexpr std::size_t kGlobeLights = 32;
/// Faceted paper globe on a cord. Lights: kGlobeLights.
void addGlobe(Palette& palette, const Pose& ceiling, float drop, float radius, Glow glow);

inline constexpr std::size_t kSconceLights = 4;
/// Box on the wall that shines up and down along it. Lights: kSconceLights.
void addSconce(Palette& palette, const Pose& wall, Glow glow);

inline constexpr std::size_t kTubeLights = 6;
/// Tube along local x on the wall, in two holders. Lights: kTubeLights.
void addTube(Palette& palette, const Pose& wall, float length, Glow glow);

inline constexpr std::size_t kFairyLights = 4;
/// Bulbs on a string that sags between two points. Tints change from bulb to bulb if `coloured`. Lights: kFairyLights
/// each.
void addFairyString(Palette& palette, const Vec3& from, const Vec3& to, float sag, std::size_t bulbs, float radius,
                    Glow glow, bool coloured);

/// Wall lamp of one bare triangle, point down. Lights: 1.
void addTriangleLamp(Palette& palette, const Pose& wall, float size, Glow glow);

/// Can under the ceiling that shines at `target`. Lights: 1 spot.
void addSpotCan(Palette& palette, const Pose& ceiling, const Vec3& target, Glow glow);

/// Hanging lantern of a cap, a floor and four bars around a point. Lights: 1 point.
void addLantern(Palette& palette, const Pose& ceiling, float drop, Glow glow);

}  // namespace cellcut
