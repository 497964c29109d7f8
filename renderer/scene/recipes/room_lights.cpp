#include "renderer/scene/recipes/lamps.h"
#include "renderer/scene/recipes/room_interior.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace cellcut {

namespace {

/// A lamp that will be built once the strengths of all lamps of the room are known.
struct PlannedLamp {
  double weight;  ///< of its flux
  Tint tint;
  std::function<void(Glow)> build;
};

/// Finds places for lamps until the room's number of lights is spent.
class LampPlanner {
 public:
  LampPlanner(Palette& palette, const RoomSpace& room, std::size_t lights, Rng& rng)
      : palette_(palette), room_(room), left_(lights), rng_(rng) {}

  void plan(bool punctual);
  void build(float flux);

 private:
  /// Log-uniform over `decades`; a larger lamp is likelier to be a strong one.
  void add(float area, Tint tint, std::size_t lights, std::function<void(Glow)> build, double decades = 4) {
    lamps_.push_back({std::sqrt(area) * std::pow(10.0, -decades * rng_.uniformDouble()), tint, std::move(build)});
    left_ -= lights;
  }
  Tint whiteTint() {
    static constexpr std::array kTints{Tint::kCandle, Tint::kWarm, Tint::kSoft, Tint::kNeutral, Tint::kCool};
    return kTints[rng_.below(kTints.size())];
  }
  Tint partyTint() {
    static constexpr std::array kTints{Tint::kAmber, Tint::kRed,  Tint::kGreen,
                                       Tint::kTeal,  Tint::kBlue, Tint::kMagenta};
    return kTints[rng_.below(kTints.size())];
  }
  /// Point on the ceiling at (u, v) in [−1, 1]² of the half-lengths.
  Pose ceilingAt(float u, float v) const {
    const Vec3 half = 0.5f * (room_.upper - room_.lower);
    return {{room_.centre().x + u * half.x, room_.upper.y, room_.centre().z + v * half.z}};
  }

  void mainLamp();
  void cornerLamp();
  void sconces(const RoomWall& wall);
  void tube(const RoomWall& wall);
  void triangleLamp(const RoomWall& wall);
  void fairyString(const RoomWall& wall, float height, std::size_t most);
  void spot();
  void lantern();
  void spendRest();

  Palette& palette_;
  const RoomSpace& room_;
  std::size_t left_;
  Rng& rng_;
  std::vector<PlannedLamp> lamps_;
};

void LampPlanner::mainLamp() {
  const std::uint32_t kind = rng_.below(4);
  const Tint tint = whiteTint();
  constexpr double kDecades = 1;  // the lamp that a room is lit by is a strong one
  if (left_ >= kGlobeLights + 20 && kind == 0) {
    const Pose at = ceilingAt(0, 0);
    add(
        0.5f, tint, kGlobeLights, [=, this](Glow glow) { addGlobe(palette_, at, 0.65f, 0.22f, glow); }, kDecades);
  } else if (left_ >= kBulbLights && kind <= 1) {
    const Pose at = ceilingAt(0, 0);
    const Paint shade = rng_.uniform() < 0.5f ? Paint::kShade : Paint::kCopper;
    add(
        0.1f, tint, kBulbLights, [=, this](Glow glow) { addPendant(palette_, at, 0.8f, shade, glow); }, kDecades);
  } else if (left_ >= kPanelPaneLights) {
    const std::size_t panes = std::min<std::size_t>(left_ / kPanelPaneLights, 1 + rng_.below(3));
    // Towards the front: from there one sees what a panel lights, not the panel.
    const Pose at = ceilingAt(rng_.uniform(-0.3f, 0.3f), rng_.uniform(0.2f, 0.5f));
    const Vec2 size(0.6f * static_cast<float>(panes), 1.2f);
    add(
        size.x * size.y, tint, panes * kPanelPaneLights,
        [=, this](Glow glow) { addCeilingPanel(palette_, at, size, static_cast<int>(panes), glow); }, kDecades);
  }
}

void LampPlanner::cornerLamp() {
  if (left_ < kBulbLights) return;
  const Pose at{lampCorners(room_)[rng_.below(2)]};
  const Tint tint = whiteTint();
  const float height = rng_.uniform(1.3f, 1.6f);
  add(0.1f, tint, kBulbLights, [=, this](Glow glow) { addFloorLamp(palette_, at, height, Paint::kShade, glow); });
}

/// Where the wall is free of its door: the longer of the two sides.
std::pair<float, float> freeStretch(const RoomWall& wall) {
  if (!wall.door) return {0.0f, wall.length};
  if (wall.door->from > wall.length - wall.door->to) return {0.0f, wall.door->from};
  return {wall.door->to, wall.length};
}

void LampPlanner::sconces(const RoomWall& wall) {
  if (wall.open || left_ < kSconceLights) return;
  const auto [from, to] = freeStretch(wall);
  const Pose at = wall.left.at({0.5f * (from + to), 2.1f, 0});
  add(0.05f, rng_.uniform() < 0.7f ? whiteTint() : partyTint(), kSconceLights,
      [=, this](Glow glow) { addSconce(palette_, at, glow); });
}

void LampPlanner::tube(const RoomWall& wall) {
  if (wall.open || left_ < kTubeLights) return;
  const auto [from, to] = freeStretch(wall);
  const float length = std::min(1.2f, 0.8f * (to - from));
  const Pose at = wall.left.at({0.5f * (from + to), 2.62f, 0});
  add(0.1f, partyTint(), kTubeLights, [=, this](Glow glow) { addTube(palette_, at, length, glow); });
}

void LampPlanner::triangleLamp(const RoomWall& wall) {
  if (wall.open || left_ < 1) return;
  const auto [from, to] = freeStretch(wall);
  const Pose at = wall.left.at({from + 0.3f * (to - from), 2.15f, 0});
  add(0.03f, rng_.uniform() < 0.5f ? whiteTint() : partyTint(), 1,
      [=, this](Glow glow) { addTriangleLamp(palette_, at, 0.26f, glow); });
}

void LampPlanner::fairyString(const RoomWall& wall, float height, std::size_t most) {
  const std::size_t bulbs = std::min(most, left_ / kFairyLights);
  if (bulbs == 0) return;
  const Vec3 from = wall.left.point({0.2f, height, 0.12f});
  const Vec3 to = wall.left.point({wall.length - 0.2f, height, 0.12f});
  const Tint tint = whiteTint();
  const bool coloured = rng_.uniform() < 0.4f;
  add(0.01f, tint, bulbs * kFairyLights,
      [=, this](Glow glow) { addFairyString(palette_, from, to, 0.22f, bulbs, 0.022f, glow, coloured); });
}

void LampPlanner::spot() {
  if (left_ < 1) return;
  const float u = rng_.uniform() < 0.5f ? -0.6f : 0.6f;
  const Pose at = ceilingAt(u, rng_.uniform(-0.5f, 0.5f));
  const Vec3 target = at.origin + Vec3(u * 1.6f, -1.8f, rng_.uniform(-0.6f, 0.6f));
  add(0.05f, whiteTint(), 1, [=, this](Glow glow) { addSpotCan(palette_, at, target, glow); });
}

void LampPlanner::lantern() {
  if (left_ < 1) return;
  const Pose at = ceilingAt(rng_.uniform() < 0.5f ? -0.62f : 0.62f, rng_.uniform(-0.7f, -0.55f));
  add(0.05f, whiteTint(), 1, [=, this](Glow glow) { addLantern(palette_, at, 0.7f, glow); });
}

/// However many are left: rows of bulbs under the ceiling, and bare triangles for the last three.
void LampPlanner::spendRest() {
  constexpr std::size_t kBulbsPerRow = 40;
  const auto rowCount = static_cast<float>((left_ / kFairyLights + kBulbsPerRow - 1) / kBulbsPerRow);
  for (std::size_t row = 0; left_ >= kFairyLights; ++row) {
    const std::size_t bulbs = std::min(kBulbsPerRow, left_ / kFairyLights);
    const float z = -0.9f + 1.8f * (static_cast<float>(row) + 0.5f) / rowCount;
    const Vec3 from = ceilingAt(-0.95f, z).point({0, -0.04f, 0});
    const Vec3 to = ceilingAt(0.95f, z).point({0, -0.04f, 0});
    add(0.01f, whiteTint(), bulbs * kFairyLights,
        [=, this](Glow glow) { addFairyString(palette_, from, to, 0.12f, bulbs, 0.02f, glow, false); });
  }
  for (std::size_t k = 0; left_ > 0; ++k) {
    const RoomWall& wall = room_.walls[k % 2 == 0 ? 1 : 3];
    const Pose at = wall.left.at({0.12f + 0.3f * static_cast<float>(k / 2), 2.45f, 0});
    add(0.01f, partyTint(), 1, [=, this](Glow glow) { addTriangleLamp(palette_, at, 0.2f, glow); });
  }
}

void LampPlanner::plan(bool punctual) {
  mainLamp();
  if (punctual && left_ > 6) spot();
  triangleLamp(room_.walls[3]);
  cornerLamp();
  sconces(room_.walls[0]);
  if (punctual && left_ > 6) lantern();
  if (rng_.uniform() < 0.6f) tube(room_.walls[1]);
  if (rng_.uniform() < 0.5f) sconces(room_.walls[3]);
  if (rng_.uniform() < 0.4f) tube(room_.walls[3]);
  fairyString(room_.walls[0], 2.85f, 14);
  spendRest();
}

void LampPlanner::build(float flux) {
  double sum = 0;
  for (const PlannedLamp& lamp : lamps_) sum += lamp.weight;
  for (const PlannedLamp& lamp : lamps_) lamp.build({lamp.tint, static_cast<float>(flux * lamp.weight / sum)});
}

}  // namespace

void lightRoom(Palette& palette, const RoomSpace& room, std::size_t lights, float radiance, bool punctual, Rng& rng) {
  LampPlanner planner(palette, room, lights, rng);
  planner.plan(punctual);
  const Vec3 size = room.upper - room.lower;
  const float area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  // A closed room of albedo a that is lit by Φ holds the radiance Φ a / (π A (1 − a)): the sum of all bounces.
  constexpr float kAlbedo = 0.4f;
  planner.build(radiance * kPi * area * (1 - kAlbedo) / kAlbedo);
}

}  // namespace cellcut
