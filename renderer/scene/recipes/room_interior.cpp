#include "renderer/scene/recipes/room_interior.h"

#include "renderer/scene/recipes/furniture.h"
#include "renderer/scene/recipes/lamps.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cellcut {

namespace {

/// Taken floor, in the plane (x, z).
class FloorPlan {
 public:
  explicit FloorPlan(const RoomSpace& room) : lower_(room.lower.x, room.lower.z), upper_(room.upper.x, room.upper.z) {
    constexpr float kDoorClearance = 0.9f;
    for (const RoomWall& wall : room.walls) {
      if (wall.door)
        take(footprint(wall.left.at({0.5f * (wall.door->from + wall.door->to), 0, 0}),
                       {wall.door->to - wall.door->from, kDoorClearance}, true));
    }
  }

  struct Rectangle {
    Vec2 lower, upper;
  };

  /// \param atWall  the pose is at the middle of the back, not of the rectangle
  static Rectangle footprint(const Pose& pose, Vec2 size, bool atWall) {
    const float back = atWall ? 0 : -size.y / 2;
    const Vec3 a = pose.point({-size.x / 2, 0, back});
    const Vec3 b = pose.point({size.x / 2, 0, back + size.y});
    return {{std::min(a.x, b.x), std::min(a.z, b.z)}, {std::max(a.x, b.x), std::max(a.z, b.z)}};
  }

  void take(const Rectangle& r) { taken_.push_back(r); }

  bool tryTake(const Rectangle& r) {
    constexpr float kSlack = 1e-3f;  // a piece at the wall may round to just outside
    if (glm::any(glm::lessThan(r.lower, lower_ - kSlack)) || glm::any(glm::greaterThan(r.upper, upper_ + kSlack)))
      return false;
    const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Rectangle& t) {
      return r.lower.x < t.upper.x && t.lower.x < r.upper.x && r.lower.y < t.upper.y && t.lower.y < r.upper.y;
    });
    if (free) take(r);
    return free;
  }

 private:
  Vec2 lower_, upper_;
  std::vector<Rectangle> taken_;
};

constexpr int kTries = 10;
constexpr float kWallGap = 0.02f;    ///< between furniture and the wall
constexpr float kCornerLamp = 0.3f;  ///< distance of a floor lamp from both walls of its corner

/// The two corners at the back of a room, where floor lamps stand.
std::array<Vec3, 2> lampCorners(const RoomSpace& room) {
  const float z = room.lower.z + kCornerLamp;
  return {Vec3{room.lower.x + kCornerLamp, room.lower.y, z}, Vec3{room.upper.x - kCornerLamp, room.lower.y, z}};
}

/// A free place at a wall, or none.
std::optional<Pose> placeAtWall(FloorPlan& plan, const RoomSpace& room, Vec2 size, Rng& rng) {
  for (int i = 0; i < kTries; ++i) {
    const RoomWall& wall = room.walls[rng.below(4)];
    const float along = rng.uniform(size.x / 2 + 0.05f, wall.length - size.x / 2 - 0.05f);
    if (wall.open) continue;
    const Pose pose = wall.left.at({along, 0, kWallGap});
    if (plan.tryTake(FloorPlan::footprint(pose, size, true))) return pose;
  }
  return std::nullopt;
}

/// A free place on the floor, near the middle if asked, or none.
std::optional<Pose> placeFree(FloorPlan& plan, const RoomSpace& room, Vec2 size, float spread, Rng& rng) {
  const Vec3 half = 0.5f * (room.upper - room.lower) - Vec3(size.x / 2 + 0.05f, 0, size.y / 2 + 0.05f);
  for (int i = 0; i < kTries; ++i) {
    const Pose pose{{room.centre().x + spread * half.x * rng.uniform(-1, 1), room.lower.y,
                     room.centre().z + spread * half.z * rng.uniform(-1, 1)}};
    if (plan.tryTake(FloorPlan::footprint(pose, size, false))) return pose;
  }
  return std::nullopt;
}

/// One attempt to put each piece; a piece that finds no place is left out.
class Furnisher {
 public:
  Furnisher(Palette& palette, const RoomSpace& room, FloorPlan plan, Rng& rng)
      : palette_(palette), room_(room), plan_(std::move(plan)), rng_(rng) {}

  /// \param kind 0 … 4: living room, bedroom, dining room, gallery, study
  void fullRoom(std::uint32_t kind);
  /// What a room of a building of thousands can afford: boxes.
  void sparseRoom(std::uint32_t kind);

 private:
  void sofa() {
    static constexpr std::array kCloths{Paint::kRedCloth, Paint::kBlueCloth, Paint::kGreenCloth, Paint::kMustardCloth,
                                        Paint::kWhiteCloth};
    if (const auto p = placeAtWall(plan_, room_, kSofaFootprint, rng_)) addSofa(palette_, *p, kCloths[rng_.below(5)]);
  }
  void bed() {
    static constexpr std::array kCloths{Paint::kRedCloth, Paint::kBlueCloth, Paint::kGreenCloth, Paint::kMustardCloth};
    if (const auto p = placeAtWall(plan_, room_, kBedFootprint, rng_)) addBed(palette_, *p, kCloths[rng_.below(4)]);
  }
  void shelf(std::uint32_t books) {
    if (const auto p = placeAtWall(plan_, room_, kShelfFootprint, rng_)) addShelf(palette_, *p, books, rng_);
  }
  void desk() {
    if (const auto p = placeAtWall(plan_, room_, kDeskFootprint, rng_)) addDesk(palette_, *p, rng_);
  }
  void diningTable() {
    if (const auto p = placeFree(plan_, room_, kDiningFootprint, 0.3f, rng_)) addDiningTable(palette_, *p, rng_);
  }
  void coffeeTable() {
    if (const auto p = placeFree(plan_, room_, kCoffeeFootprint, 0.3f, rng_)) addCoffeeTable(palette_, *p, rng_);
  }
  void plant() {
    if (const auto p = placeFree(plan_, room_, kPlantFootprint, 1, rng_))
      addPlant(palette_, *p, rng_.uniform(0.8f, 1.6f), rng_);
  }
  void pedestal() {
    if (const auto p = placeFree(plan_, room_, kPedestalFootprint, 0.9f, rng_)) addPedestal(palette_, *p, rng_);
  }
  void picture() {
    constexpr Vec2 kFootprint{1.2f, 0.06f};  // of the tallest and widest; keeps it off shelves
    constexpr float kEyeHeight = 1.55f;
    if (const auto p = placeAtWall(plan_, room_, kFootprint, rng_)) {
      const Vec2 size(rng_.uniform(0.5f, 1.1f), rng_.uniform(0.45f, 0.75f));
      addPicture(palette_, p->at({0, kEyeHeight, -kWallGap}), size, rng_);
    }
  }
  void crates() {
    if (const auto p = placeFree(plan_, room_, kCratesFootprint, 1, rng_)) addCrates(palette_, *p, rng_);
  }

  Palette& palette_;
  const RoomSpace& room_;
  FloorPlan plan_;
  Rng& rng_;
};

void Furnisher::fullRoom(std::uint32_t kind) {
  constexpr std::uint32_t kBooks = 11;
  switch (kind) {
    case 0:
      coffeeTable();
      sofa();
      sofa();
      shelf(kBooks);
      plant();
      break;
    case 1:
      bed();
      desk();
      plant();
      break;
    case 2:
      diningTable();
      shelf(kBooks);
      plant();
      crates();
      break;
    case 3:
      for (int i = 0; i < 5; ++i) pedestal();
      coffeeTable();
      break;
    default:
      desk();
      for (int i = 0; i < 3; ++i) shelf(kBooks);
      for (int i = 0; i < 4; ++i) crates();
      break;
  }
  for (int i = 0; i < 3; ++i) picture();
}

void Furnisher::sparseRoom(std::uint32_t kind) {
  switch (kind) {
    case 0:
      sofa();
      break;
    case 1:
      bed();
      break;
    case 2:
      shelf(0);
      break;
    case 3:
      desk();
      break;
    default:
      crates();
      break;
  }
  crates();
}

}  // namespace

void furnishRoom(Palette& palette, const RoomSpace& room, Clutter clutter, std::optional<Vec2> keepClear, Rng& rng) {
  FloorPlan plan(room);
  constexpr float kClear = 1.1f;
  for (const Vec3& corner : lampCorners(room)) {
    plan.take(FloorPlan::footprint({corner}, Vec2(2 * kCornerLamp), false));
  }
  if (keepClear) plan.take({*keepClear - kClear, *keepClear + kClear});
  Furnisher put(palette, room, std::move(plan), rng);
  if (clutter == Clutter::kFull) {
    put.fullRoom(rng.below(5));
  } else {
    put.sparseRoom(rng.below(5));
  }
}

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
