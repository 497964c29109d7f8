#include "renderer/scene/recipes/furniture.h"
#include "renderer/scene/recipes/room_interior.h"

#include <algorithm>

namespace cellcut {

std::array<Vec3, 2> lampCorners(const RoomSpace& room) {
  const float z = room.lower.z + kCornerLamp;
  return {Vec3{room.lower.x + kCornerLamp, room.lower.y, z}, Vec3{room.upper.x - kCornerLamp, room.lower.y, z}};
}

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
constexpr float kWallGap = 0.02f;  ///< between furniture and the wall

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

}  // namespace cellcut
