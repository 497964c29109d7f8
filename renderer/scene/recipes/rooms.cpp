#include "renderer/scene/recipes/builders.h"
#include "renderer/scene/recipes/room_interior.h"

#include <algorithm>
#include <cmath>

namespace cellcut {

namespace {

// All lengths of the shell are multiples of 2⁻⁶ m, so that sums of them are exact and the two sides of a wall meet
// without a crack, however they are computed.
constexpr float kStorey = 3.375f;
constexpr float kCeiling = 3.0f;
constexpr float kHalfWall = 0.125f;
constexpr float kSlab = 0.1875f;  ///< how far a storey's front reaches below its floor
constexpr std::size_t kLightsPerRoom = 60;
constexpr std::size_t kMostRooms = 17'000;  ///< above a million lights rooms get more lamps, not their number larger
constexpr std::size_t kFullyFurnishedRooms = 1500;
constexpr std::size_t kRoomsWithPunctualLights = 5000;
constexpr float kRadiance = 0.3f;  ///< of a room of mean brightness, W/(m² sr)

/// Independent decisions of one seed.
enum Stream : std::uint64_t { kWidths, kDepths, kThroughDoor, kSideDoor, kThroughLine, kSideLine, kInterior, kDecor };

float snapped(float length) {
  return std::round(length * 64) / 64;
}

struct RoomIndex {
  int column, row, storey;  ///< row 0 is the open front, further rows lie towards −z
};

/// The grid of the building, and every opening in it. Front at z = 0.
class Plan {
 public:
  Plan(std::size_t lights, std::uint64_t seed);

  int columns() const { return static_cast<int>(x_.size()) - 1; }
  int rows() const { return static_cast<int>(z_.size()) - 1; }
  int storeys() const { return storeys_; }
  float x(int line) const { return x_[static_cast<std::size_t>(line)]; }
  float z(int line) const { return z_[static_cast<std::size_t>(line)]; }
  RoomIndex cameraRoom() const { return {columns() / 2, 0, storeys_ / 2}; }

  RoomSpace room(RoomIndex at) const;
  /// Every room, those nearest to the camera first.
  std::vector<RoomIndex> roomsByDistance() const;
  Rng rng(Stream stream, RoomIndex at) const {
    return Rng(hashOf(seed_, stream, static_cast<std::uint64_t>(at.column), static_cast<std::uint64_t>(at.row),
                      static_cast<std::uint64_t>(at.storey)));
  }
  /// Doorway in the wall behind a room (towards −z), from and to as x in the world.
  std::optional<Doorway> doorBehind(RoomIndex at) const;
  /// Doorway in the wall to the right of a room (towards +x), from and to as z in the world.
  std::optional<Doorway> doorRight(RoomIndex at) const;

 private:
  std::optional<Doorway> door(Stream exists, Stream line, RoomIndex at, RoomIndex lineOf, float middle,
                              bool always) const;

  std::uint64_t seed_;
  int storeys_;
  std::vector<float> x_, z_;  ///< grid lines: middles of the walls; z falls
};

Plan::Plan(std::size_t lights, std::uint64_t seed) : seed_(seed) {
  const double rooms = static_cast<double>(std::clamp<std::size_t>(lights / kLightsPerRoom, 9, kMostRooms));
  storeys_ = std::max(1, static_cast<int>(std::lround(std::cbrt(rooms / 4))));
  if (rooms < 18) storeys_ = 1;
  const int rows = std::max(3, static_cast<int>(std::lround(std::sqrt(rooms / storeys_ / 1.6))));
  const int columns = std::max(3, static_cast<int>(std::ceil(rooms / (storeys_ * rows))));
  Rng widths(hashOf(seed, std::uint64_t{kWidths}));
  x_.push_back(0);
  for (int i = 0; i < columns; ++i) x_.push_back(x_.back() + snapped(widths.uniform(5.0f, 6.8f)));
  const float middle = snapped(0.5f * x_.back());
  for (float& x : x_) x -= middle;
  Rng depths(hashOf(seed, std::uint64_t{kDepths}));
  z_.push_back(0);
  for (int i = 0; i < rows; ++i) z_.push_back(z_.back() - snapped(depths.uniform(5.0f, 6.8f)));
}

std::optional<Doorway> Plan::door(Stream exists, Stream line, RoomIndex at, RoomIndex lineOf, float middle,
                                  bool always) const {
  Rng own = rng(exists, at);
  if (own.uniform() > 0.8f && !always) return std::nullopt;
  const float halfWidth = snapped(0.5f * own.uniform(0.95f, 2.1f));
  const float height = snapped(own.uniform(2.1f, 2.45f));
  const float centre = snapped(middle + rng(line, lineOf).uniform(-0.3f, 0.3f));  // one line: doors behind each other
  return Doorway{centre - halfWidth, centre + halfWidth, height};
}

std::optional<Doorway> Plan::doorBehind(RoomIndex at) const {
  if (at.row < 0 || at.row + 1 >= rows()) return std::nullopt;
  const bool always = at.column == cameraRoom().column && at.storey == cameraRoom().storey;
  return door(kThroughDoor, kThroughLine, at, {at.column, 0, at.storey}, 0.5f * (x(at.column) + x(at.column + 1)),
              always);
}

std::optional<Doorway> Plan::doorRight(RoomIndex at) const {
  if (at.column < 0 || at.column + 1 >= columns()) return std::nullopt;
  const bool always = at.row <= 1 && at.storey == cameraRoom().storey;
  return door(kSideDoor, kSideLine, at, {0, at.row, at.storey}, 0.5f * (z(at.row) + z(at.row + 1)), always);
}

RoomSpace Plan::room(RoomIndex at) const {
  RoomSpace room;
  const float y = kStorey * static_cast<float>(at.storey);
  const bool open = at.row == 0;
  room.lower = {x(at.column) + kHalfWall, y, z(at.row + 1) + kHalfWall};
  room.upper = {x(at.column + 1) - kHalfWall, y + kCeiling, z(at.row) - (open ? 0 : kHalfWall)};
  const Vec3 size = room.upper - room.lower;
  // From the left end of each wall, as it is seen from inside.
  room.walls[0] = {Pose{{room.lower.x, y, room.lower.z}, {1, 0, 0}}, size.x, false, {}};
  room.walls[1] = {Pose{{room.upper.x, y, room.lower.z}, {0, 0, 1}}, size.z, false, {}};
  room.walls[2] = {Pose{{room.upper.x, y, room.upper.z}, {-1, 0, 0}}, size.x, open, {}};
  room.walls[3] = {Pose{{room.lower.x, y, room.upper.z}, {0, 0, -1}}, size.z, false, {}};
  if (auto d = doorBehind(at)) room.walls[0].door = {d->from - room.lower.x, d->to - room.lower.x, d->height};
  if (auto d = doorRight(at)) room.walls[1].door = {d->from - room.lower.z, d->to - room.lower.z, d->height};
  if (auto d = doorBehind({at.column, at.row - 1, at.storey})) {
    room.walls[2].door = {room.upper.x - d->to, room.upper.x - d->from, d->height};
  }
  if (auto d = doorRight({at.column - 1, at.row, at.storey})) {
    room.walls[3].door = {room.upper.z - d->to, room.upper.z - d->from, d->height};
  }
  return room;
}

std::vector<RoomIndex> Plan::roomsByDistance() const {
  std::vector<RoomIndex> all;
  for (int s = 0; s < storeys(); ++s) {
    for (int r = 0; r < rows(); ++r) {
      for (int c = 0; c < columns(); ++c) all.push_back({c, r, s});
    }
  }
  const RoomIndex camera = cameraRoom();
  const auto distance = [&](RoomIndex a) {
    // Another storey is never seen; the rooms straight ahead are seen best.
    return 100 * std::abs(a.storey - camera.storey) + 3 * std::abs(a.column - camera.column) + 2 * a.row;
  };
  std::stable_sort(all.begin(), all.end(), [&](RoomIndex a, RoomIndex b) { return distance(a) < distance(b); });
  return all;
}

/// Walls, floors and the outside.
class Shell {
 public:
  Shell(Palette& palette, const Plan& plan) : palette_(palette), plan_(plan) {}
  void addRoom(RoomIndex at, const RoomSpace& room, Rng& rng);
  void addOutside();

 private:
  void addWall(Surface& s, const RoomWall& wall);
  void addFloor(Surface& s, const RoomSpace& room);
  void addReveal(const RoomWall& wall, Paint floor);
  void addFront(RoomIndex at, const RoomSpace& room);

  Palette& palette_;
  const Plan& plan_;
};

void Shell::addWall(Surface& s, const RoomWall& wall) {
  if (wall.open) return;
  const auto at = [&](float along, float up) { return wall.left.point({along, up, 0}); };
  if (!wall.door) {
    addQuad(s, at(0, 0), at(wall.length, 0), at(wall.length, kCeiling), at(0, kCeiling));
    return;
  }
  // Six triangles around the hole that share all their edges: no crack for a ray to slip through.
  const auto [from, to, height] = *wall.door;
  const std::uint32_t v = s.add(at(0, 0));
  for (const Vec3& p : {at(from, 0), at(from, height), at(to, height), at(to, 0), at(wall.length, 0),
                        at(wall.length, kCeiling), at(0, kCeiling)}) {
    s.add(p);
  }
  s.triangle(v, v + 1, v + 2);
  s.triangle(v, v + 2, v + 7);
  s.triangle(v + 7, v + 2, v + 3);
  s.triangle(v + 7, v + 3, v + 6);
  s.triangle(v + 3, v + 5, v + 6);
  s.triangle(v + 3, v + 4, v + 5);
}

/// A fan from the middle, with a vertex wherever a doorway begins or ends.
void Shell::addFloor(Surface& s, const RoomSpace& room) {
  const std::uint32_t middle = s.add({room.centre().x, room.lower.y, room.centre().z});
  for (const RoomWall& wall : room.walls) {
    s.add(wall.left.origin);
    if (!wall.door) continue;
    s.add(wall.left.point({wall.door->from, 0, 0}));
    s.add(wall.left.point({wall.door->to, 0, 0}));
  }
  const auto rim = static_cast<std::uint32_t>(s.positions.size()) - middle - 1;
  // The walls go round clockwise seen from above.
  for (std::uint32_t k = 0; k < rim; ++k) s.triangle(middle, middle + 1 + (k + 1) % rim, middle + 1 + k);
}

/// The inside of a doorway, through to the wall of the room behind it.
void Shell::addReveal(const RoomWall& wall, Paint floor) {
  const auto [from, to, height] = *wall.door;
  const float through = -2 * kHalfWall;
  const auto at = [&](float along, float up, float depth) { return wall.left.point({along, up, depth}); };
  Surface& frame = palette_.flat(Paint::kWalnut);
  addQuad(frame, at(from, 0, 0), at(from, 0, through), at(from, height, through), at(from, height, 0));
  addQuad(frame, at(to, 0, through), at(to, 0, 0), at(to, height, 0), at(to, height, through));
  addQuad(frame, at(from, height, 0), at(from, height, through), at(to, height, through), at(to, height, 0));
  addQuad(palette_.flat(floor), at(from, 0, 0), at(to, 0, 0), at(to, 0, through), at(from, 0, through));
}

void Shell::addRoom(RoomIndex at, const RoomSpace& room, Rng& rng) {
  static constexpr std::array kWalls{Paint::kPlaster, Paint::kCream, Paint::kSage,  Paint::kSky,
                                     Paint::kRose,    Paint::kOchre, Paint::kSlate, Paint::kPlaster};
  static constexpr std::array kFloors{Paint::kOak, Paint::kParquet, Paint::kStone, Paint::kTerracotta, Paint::kWalnut};
  const Paint walls = kWalls[rng.below(kWalls.size())];
  const Paint floor = kFloors[rng.below(kFloors.size())];
  for (const RoomWall& wall : room.walls) addWall(palette_.flat(walls), wall);
  addFloor(palette_.flat(floor), room);
  addQuad(palette_.flat(Paint::kCeiling), {room.lower.x, room.upper.y, room.lower.z},
          {room.upper.x, room.upper.y, room.lower.z}, {room.upper.x, room.upper.y, room.upper.z},
          {room.lower.x, room.upper.y, room.upper.z});
  if (room.walls[0].door) addReveal(room.walls[0], floor);
  if (room.walls[1].door) addReveal(room.walls[1], floor);
  if (at.row == 0) addFront(at, room);
}

/// The cut through walls and floors around an open room.
void Shell::addFront(RoomIndex at, const RoomSpace& room) {
  const float bottom = kStorey * static_cast<float>(at.storey) - kSlab;
  const std::array<Vec2, 4> outer{Vec2{plan_.x(at.column), bottom}, Vec2{plan_.x(at.column + 1), bottom},
                                  Vec2{plan_.x(at.column + 1), bottom + kStorey},
                                  Vec2{plan_.x(at.column), bottom + kStorey}};
  const std::array<Vec2, 4> inner{Vec2{room.lower.x, room.lower.y}, Vec2{room.upper.x, room.lower.y},
                                  Vec2{room.upper.x, room.upper.y}, Vec2{room.lower.x, room.upper.y}};
  Surface& s = palette_.flat(Paint::kConcrete);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    addQuad(s, Vec3(outer[k], 0), Vec3(outer[next], 0), Vec3(inner[next], 0), Vec3(inner[k], 0));
  }
}

void Shell::addOutside() {
  const float x0 = plan_.x(0), x1 = plan_.x(plan_.columns()), back = plan_.z(plan_.rows());
  const float top = kStorey * static_cast<float>(plan_.storeys()) - kSlab;
  addBox(palette_.flat(Paint::kBrick), {}, {x0, -kSlab, back}, {x1, top, 0}, kFront | kBottom | kTop);
  addBox(palette_.flat(Paint::kRoof), {}, {x0 - 0.2f, top, back - 0.2f}, {x1 + 0.2f, top + 0.15f, 0.2f});
  const float reach = 1.5f * (x1 - x0);
  addQuad(palette_.flat(Paint::kGround), {-reach, -kSlab, reach}, {reach, -kSlab, reach}, {reach, -kSlab, back - 5},
          {-reach, -kSlab, back - 5});
}

void addCameras(GlbBuilder& builder, const Plan& plan) {
  const RoomIndex at = plan.cameraRoom();
  const RoomSpace room = plan.room(at);
  const float eye = room.lower.y + 1.5f;
  const Doorway behind = plan.doorBehind(at).value();
  const Vec3 through(0.5f * (behind.from + behind.to), room.lower.y + 1.25f, room.lower.z);
  builder.addCamera("inside", {room.lower.x + 0.62f * (room.upper.x - room.lower.x), eye, -0.2f}, through, 1.0f);
  const RoomSpace next = plan.room({at.column, 1, at.storey});
  builder.addCamera("through", {next.lower.x + 0.5f, eye, next.upper.z - 0.5f},
                    {next.upper.x, room.lower.y + 1.2f, 0.5f * (next.lower.z + next.upper.z)}, 1.0f);
  const float width = plan.x(plan.columns()) - plan.x(0);
  const float height = kStorey * static_cast<float>(plan.storeys());
  const float distance = std::max(0.86f * width, 1.7f * height);
  builder.addCamera("overview", {-0.07f * width, 0.5f * height + 0.08f * distance, distance}, {0, 0.47f * height, 0},
                    0.7f);
}

}  // namespace

void buildRooms(GlbBuilder& builder, std::size_t lights, std::uint64_t seed) {
  const Plan plan(lights, seed);
  Palette palette(builder);
  Shell shell(palette, plan);
  addCameras(builder, plan);
  shell.addOutside();
  const std::vector<RoomIndex> rooms = plan.roomsByDistance();
  const Clutter clutter = rooms.size() <= kFullyFurnishedRooms ? Clutter::kFull : Clutter::kSparse;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const RoomSpace room = plan.room(rooms[i]);
    Rng rng = plan.rng(kInterior, rooms[i]);
    shell.addRoom(rooms[i], room, rng);
    const std::optional<Vec2> camera = i == 0 ? std::optional(Vec2(room.centre().x, room.upper.z)) : std::nullopt;
    furnishRoom(palette, room, clutter, camera, rng);
    const std::size_t share = lights / rooms.size() + (i < lights % rooms.size() ? 1 : 0);
    const float brightness = i == 0 ? 1.0f : std::pow(10.0f, rng.uniform(-0.4f, 0.4f));
    if (share > 0) lightRoom(palette, room, share, kRadiance * brightness, i < kRoomsWithPunctualLights, rng);
  }
}

}  // namespace cellcut
