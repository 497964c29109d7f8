#include "renderer/scene/recipes/builders.h"
#include "renderer/scene/recipes/lamps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cellcut {

namespace {

// The street runs along −z, the camera stands near z = 0.
constexpr float kHalfRoad = 4.0f;
constexpr float kHalfStreet = 7.0f;  ///< between the houses
constexpr float kKerb = 0.14f;
constexpr float kShopStorey = 4.0f;
constexpr float kUpperStorey = 3.2f;
constexpr float kGap = 0.25f;        ///< between houses: their walls must not coincide
constexpr float kBehindCamera = 14;  ///< the street goes on there, so that it is lit from both sides

/// A house with its front towards the street.
struct House {
  Pose front;  ///< foot of the left end, seen from the street
  float width;
  int storeys;  ///< above the shop
  int columns;  ///< of windows
  Paint wall;
  float height() const { return kShopStorey + kUpperStorey * static_cast<float>(storeys); }
  std::size_t windows() const { return static_cast<std::size_t>(storeys) * static_cast<std::size_t>(columns); }
  float distance() const { return std::abs(front.origin.z); }
};

class Street {
 public:
  Street(GlbBuilder& builder, std::size_t lights, std::uint64_t seed)
      : builder_(builder), palette_(builder), left_(lights), total_(lights), rng_(hashOf(seed, 0x57u)) {}
  void build();

 private:
  void placeHouses();
  void addGround();
  void addHouse(const House& house);
  void addLampPosts();
  void addFestoons();
  void addShopLights(const House& house);
  void addWindows(const House& house, std::size_t lights);
  void addPane(Surface& light, const Pose& cell, Vec2 lower, Vec2 upper, std::size_t triangles);
  void addTrees();
  void addCars();
  void addCar(const Pose& pose, bool lit);
  bool spend(std::size_t lights) {
    if (left_ < lights) return false;
    left_ -= lights;
    return true;
  }

  GlbBuilder& builder_;
  Palette palette_;
  std::size_t left_;  ///< lights not yet placed
  std::size_t total_;
  Rng rng_;
  std::vector<House> houses_;  ///< nearest to the camera first
  float length_ = 0;           ///< of the street in front of the camera
};

void Street::placeHouses() {
  static constexpr std::array kWalls{Paint::kBrick, Paint::kSandstone, Paint::kConcrete, Paint::kCream,
                                     Paint::kRose,  Paint::kSlate,     Paint::kPlaster,  Paint::kOchre};
  const int perSide = std::max(6, static_cast<int>(0.75 * std::pow(static_cast<double>(total_), 0.42)));
  const int extraStoreys = std::min(12, perSide / 40);
  std::array<float, 2> end{kBehindCamera, kBehindCamera};  // z of the next house's near side
  for (int i = 0; i < perSide; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      House house;
      house.width = rng_.uniform(9, 15);
      house.storeys = 2 + static_cast<int>(rng_.below(4)) + extraStoreys;
      house.columns = static_cast<int>(house.width / 2.3f);
      house.wall = kWalls[rng_.below(kWalls.size())];
      const float near = end[side], far = near - house.width;
      end[side] = far - kGap;
      house.front =
          side == 0 ? Pose{{-kHalfStreet, kKerb, near}, {0, 0, -1}} : Pose{{kHalfStreet, kKerb, far}, {0, 0, 1}};
      houses_.push_back(house);
    }
  }
  length_ = -std::min(end[0], end[1]);
  // The house that closes the view.
  House last{{{-kHalfStreet - 4, kKerb, -length_ - 3}, {1, 0, 0}},
             2 * kHalfStreet + 8,
             5 + extraStoreys,
             9,
             Paint::kSandstone};
  houses_.push_back(last);
  std::stable_sort(houses_.begin(), houses_.end(),
                   [](const House& a, const House& b) { return a.distance() < b.distance(); });
}

void Street::addGround() {
  const float near = kBehindCamera + 12, far = -length_ - 3;
  addQuad(palette_.flat(Paint::kWetAsphalt), {-kHalfRoad, 0, near}, {kHalfRoad, 0, near}, {kHalfRoad, 0, far},
          {-kHalfRoad, 0, far});
  constexpr float kReach = 60;  // under and beyond the houses
  for (const float side : {-1.0f, 1.0f}) {
    const float x0 = side < 0 ? -kReach : kHalfRoad, x1 = side < 0 ? -kHalfRoad : kReach;
    addBox(palette_.flat(Paint::kConcrete), {}, {x0, 0, far}, {x1, kKerb, near}, kBottom);
  }
  addBox(palette_.flat(Paint::kConcrete), {}, {-kReach, 0, far - 20}, {kReach, kKerb - 0.002f, far}, kBottom);
  const int dashes = static_cast<int>(std::ceil((near - far - 6) / 6));
  for (int i = 0; i < dashes; ++i) {
    const float z = near - 2 - 6 * static_cast<float>(i);
    addBox(palette_.flat(Paint::kPaper), {}, {-0.08f, 0, z - 2.4f}, {0.08f, 0.006f, z}, kBottom);
  }
}

void Street::addHouse(const House& house) {
  const float h = house.height(), w = house.width;
  addBox(palette_.flat(house.wall), house.front, {0, 0, -11}, {w, h, 0}, kBottom);
  Surface& trim = palette_.flat(house.wall == Paint::kSandstone ? Paint::kPlaster : Paint::kSandstone);
  for (int s = 0; s <= house.storeys; ++s) {
    const float y = kShopStorey + kUpperStorey * static_cast<float>(s);
    const bool cornice = s == house.storeys;
    const float depth = cornice ? 0.5f : 0.2f;
    addBox(trim, house.front, {cornice ? -0.05f : 0, y - 0.16f, 0}, {cornice ? w + 0.05f : w, y + 0.1f, depth},
           cornice ? 0 : unsigned{kBack});
  }
  const float step = w / static_cast<float>(house.columns);
  for (int c = 0; c <= house.columns; ++c) {
    const float x = std::clamp(step * static_cast<float>(c), 0.16f, w - 0.16f);
    addBox(palette_.flat(house.wall), house.front, {x - 0.16f, 0, 0}, {x + 0.16f, h - 0.17f, 0.13f},
           kBack | kBottom | kTop);
  }
}

/// One pane, or half of one where a single light is left.
void Street::addPane(Surface& light, const Pose& cell, Vec2 lower, Vec2 upper, std::size_t triangles) {
  constexpr float kProud = 0.03f;  // of the wall
  const auto at = [&](float x, float y) { return cell.point({x, y, kProud}); };
  if (triangles == 2) {
    addQuad(light, at(lower.x, lower.y), at(upper.x, lower.y), at(upper.x, upper.y), at(lower.x, upper.y));
  } else {
    addTriangle(light, at(lower.x, lower.y), at(upper.x, lower.y), at(lower.x, upper.y));
  }
}

void Street::addWindows(const House& house, std::size_t lights) {
  static constexpr std::array kTints{Tint::kCandle, Tint::kWarm,    Tint::kWarm, Tint::kSoft, Tint::kSoft,
                                     Tint::kAmber,  Tint::kNeutral, Tint::kCool, Tint::kTeal};
  std::vector<std::size_t> order(house.windows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[rng_.below(static_cast<std::uint32_t>(i))]);
  // Three windows of four at most are lit; more lights than that are more panes.
  const std::size_t mostLit = std::max<std::size_t>(1, 3 * order.size() / 4);
  const std::size_t panes = std::max<std::size_t>(1, (lights + 2 * mostLit - 1) / (2 * mostLit));
  const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panes) / 1.4)));
  const std::size_t down = (panes + across - 1) / across;
  const float step = house.width / static_cast<float>(house.columns);
  const Vec2 size(step - 0.9f, 1.75f);
  for (const std::size_t w : order) {
    const auto column = static_cast<int>(w) % house.columns, storey = static_cast<int>(w) / house.columns;
    const Pose cell = house.front.at({step * (static_cast<float>(column) + 0.5f),
                                      kShopStorey + kUpperStorey * static_cast<float>(storey) + 0.85f, 0});
    addBox(palette_.flat(Paint::kPlaster), cell, {-size.x / 2 - 0.1f, -0.1f, 0}, {size.x / 2 + 0.1f, 0, 0.16f}, kBack);
    if (lights == 0) {
      addPane(palette_.flat(Paint::kDarkGlass), cell, {-size.x / 2, 0}, {size.x / 2, size.y}, 2);
      continue;
    }
    const float radiance = 3.0f * std::pow(10.0f, -2 * rng_.uniform());
    Surface& light = palette_.emitter(kTints[rng_.below(kTints.size())], radiance);
    const Vec2 pane = size / Vec2(static_cast<float>(across), static_cast<float>(down));
    const Vec2 bar = pane * 0.06f;
    for (std::size_t p = 0; p < panes && lights > 0; ++p) {
      const Vec2 corner =
          Vec2(-size.x / 2, 0) + pane * Vec2(static_cast<float>(p % across), static_cast<float>(p / across));
      const std::size_t used = std::min<std::size_t>(2, lights);
      addPane(light, cell, corner + bar, corner + pane - bar, used);
      lights -= used;
    }
  }
  // A house without a window left to light has been asked for at most panes · windows: cannot happen, see `panes`.
}

void Street::addShopLights(const House& house) {
  static constexpr std::array kSigns{Tint::kRed, Tint::kTeal, Tint::kMagenta, Tint::kGreen, Tint::kAmber, Tint::kBlue};
  const float w = house.width;
  const float windowWidth = rng_.uniform(0.45f, 0.7f) * w;
  const bool left = rng_.uniform() < 0.5f;
  const Pose shop = house.front.at({left ? 0.6f + windowWidth / 2 : w - 0.6f - windowWidth / 2, 0, 0.15f});
  Surface& frame = palette_.flat(Paint::kWalnut);
  addBox(frame, shop, {-windowWidth / 2 - 0.1f, 0, -0.14f}, {windowWidth / 2 + 0.1f, 3.05f, 0}, kBack | kBottom);
  const bool open = rng_.uniform() < 0.6f && spend(2);
  const float radiance = 1.4f * std::pow(10.0f, -1.2f * rng_.uniform());
  addPane(open ? palette_.emitter(rng_.uniform() < 0.7f ? Tint::kWarm : Tint::kCool, radiance)
               : palette_.flat(Paint::kDarkGlass),
          shop, {-windowWidth / 2, 0.6f}, {windowWidth / 2, 2.8f}, 2);
  constexpr float kInFront = 0.035f;  // of the pane, which does not glow into its bars
  const int bars = static_cast<int>(windowWidth / 1.3f);
  for (int i = 1; i < bars; ++i) {
    const float x = windowWidth * (static_cast<float>(i) / static_cast<float>(bars) - 0.5f);
    addBox(frame, shop, {x - 0.03f, 0.6f, kInFront}, {x + 0.03f, 2.8f, kInFront + 0.03f});
  }
  addBox(frame, shop, {-windowWidth / 2, 2.2f, kInFront}, {windowWidth / 2, 2.26f, kInFront + 0.025f});
  const Pose sign = shop.at({0, 3.4f, 0});
  const float half = 0.3f * windowWidth;
  addBox(palette_.flat(Paint::kBlackMetal), sign, {-half - 0.06f, -0.26f, -0.1f}, {half + 0.06f, 0.26f, 0.08f}, kBack);
  const Tint tint = kSigns[rng_.below(kSigns.size())];
  if (spend(2)) {
    addPane(palette_.emitter(tint, rng_.uniform(1.0f, 4.0f)), sign.at({0, 0, 0.06f}), {-half, -0.2f}, {half, 0.2f}, 2);
  }
  if (rng_.uniform() < 0.6f && total_ >= 100 && spend(1)) {
    const Pose bracket = house.front.at({left ? w - 0.9f : 0.9f, 3.3f, 0.5f});
    addBox(palette_.flat(Paint::kBlackMetal), bracket, {-0.02f, 0, -0.37f}, {0.02f, 0.04f, 0.04f}, kBack);
    addLantern(palette_, bracket, 0.4f, {Tint::kWarm, rng_.uniform(15, 70)});
  }
}

void Street::addLampPosts() {
  constexpr float kSpacing = 16;
  constexpr float kHeight = 6.2f;
  const std::size_t most =
      std::min<std::size_t>(total_ / 5, 20'000);  // a node each: keeps files of a million lights small
  std::size_t lit = 0;
  const int posts = static_cast<int>(std::ceil((kBehindCamera - 6 + length_) / (kSpacing / 2)));
  for (int i = 0; i < posts; ++i) {
    const float z = kBehindCamera - 6 - kSpacing / 2 * static_cast<float>(i);
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    const Pose foot{{side * (kHalfRoad + 0.5f), kKerb, z}, {-side, 0, 0}};  // local x over the road
    Surface& metal = palette_.flat(Paint::kBlackMetal);
    addFrustum(metal, foot.origin, 0.09f, 0.05f, kHeight, 8, kBottom);
    addBox(metal, foot, {0.02f, kHeight - 0.1f, -0.03f}, {1.5f, kHeight - 0.04f, 0.03f});
    addBox(metal, foot, {1.2f, kHeight - 0.2f, -0.14f}, {1.9f, kHeight - 0.1f, 0.14f});
    if (lit >= most || !spend(1)) continue;
    ++lit;
    const Tint tint = rng_.uniform() < 0.8f ? Tint::kWarm : Tint::kNeutral;
    const float strength = rng_.uniform(0.5f, 1.6f);
    builder_.addSpot(foot.point({1.55f, kHeight - 0.26f, 0}), {0, -1, 0}, palette_.intensity(tint, 190 * strength),
                     0.7f, 1.35f);
    if (total_ >= 100 && spend(2)) {
      const float y = kHeight - 0.205f;
      addQuad(palette_.emitter(tint, 40 * strength), foot.point({1.25f, y, -0.1f}), foot.point({1.85f, y, -0.1f}),
              foot.point({1.85f, y, 0.1f}), foot.point({1.25f, y, 0.1f}));
    }
  }
}

void Street::addFestoons() {
  if (total_ < 200) return;
  constexpr std::size_t kBulbs = 22;
  const auto most = static_cast<int>(std::min<std::size_t>(total_ / 10 / (kBulbs * kFairyLights), 40));
  for (int i = 0; i < std::max(1, most); ++i) {
    const float z = -7 - 9 * static_cast<float>(i);
    if (z < -length_ || !spend(kBulbs * kFairyLights)) return;
    const float y = rng_.uniform(5.2f, 6.4f);
    const float x = kHalfStreet - 0.25f;
    addFairyString(palette_, {-x, y, z}, {x, y + rng_.uniform(-0.4f, 0.4f), z + rng_.uniform(-3, 3)}, 0.9f, kBulbs,
                   0.06f, {Tint::kWarm, 60}, i % 2 == 1);
  }
}

void Street::addTrees() {
  const int most = 40;
  for (int i = 0; i < most; ++i) {
    const float z = -4 - 16 * static_cast<float>(i / 2);
    if (z < -length_ + 4) return;
    const Vec3 foot((i % 2 == 0 ? -1.0f : 1.0f) * (kHalfRoad + 0.9f), kKerb, z);
    addFrustum(palette_.flat(Paint::kBark), foot, 0.13f, 0.08f, 2.6f, 8, kBottom);
    for (int k = 0; k < 5; ++k) {
      const Vec3 offset(rng_.uniform(-0.6f, 0.6f), 2.9f + 0.35f * static_cast<float>(k), rng_.uniform(-0.6f, 0.6f));
      Surface crown;
      addSphere(crown, foot + offset, rng_.uniform(0.55f, 0.85f), 7, 10);
      Surface& leaves = palette_.flat(Paint::kLeaf);  // flat facets look like foliage
      const auto first = static_cast<std::uint32_t>(leaves.positions.size());
      for (const Vec3& p : crown.positions) leaves.add(p);
      for (const std::uint32_t v : crown.indices) leaves.indices.push_back(first + v);
    }
  }
}

void Street::addCar(const Pose& pose, bool lit) {
  static constexpr std::array kPaints{Paint::kGlazeRed, Paint::kGlazeBlue, Paint::kGlaze, Paint::kSteel,
                                      Paint::kDarkGlass};
  Surface& body = palette_.flat(kPaints[rng_.below(kPaints.size())]);
  addBox(body, pose, {-0.88f, 0.30f, -2.1f}, {0.88f, 0.82f, 2.1f});
  Surface& glass = palette_.flat(Paint::kDarkGlass);
  // The cabin: a box with a smaller roof.
  const std::array<Vec2, 4> base{Vec2{-0.82f, 1.5f}, Vec2{0.82f, 1.5f}, Vec2{0.82f, -1.1f}, Vec2{-0.82f, -1.1f}};
  const auto at = [&](Vec2 p, float scale, float y) {
    return pose.point({scale * p.x, y, scale * p.y + 0.05f * (1 - scale)});
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    addQuad(glass, at(base[k], 1, 0.82f), at(base[next], 1, 0.82f), at(base[next], 0.72f, 1.36f),
            at(base[k], 0.72f, 1.36f));
  }
  addQuad(body, at(base[0], 0.72f, 1.36f), at(base[1], 0.72f, 1.36f), at(base[2], 0.72f, 1.36f),
          at(base[3], 0.72f, 1.36f));
  for (const float x : {-0.9f, 0.72f}) {
    for (const float z : {-1.35f, 1.3f}) {
      addBox(palette_.flat(Paint::kBlackCloth), pose, {x, 0, z - 0.3f}, {x + 0.18f, 0.6f, z + 0.3f}, kBottom);
    }
  }
  if (!lit) return;
  for (const float x : {-0.8f, 0.5f}) {
    const float z = 2.105f;
    addQuad(palette_.emitter(Tint::kRed, 8), pose.point({x, 0.6f, z}), pose.point({x + 0.3f, 0.6f, z}),
            pose.point({x + 0.3f, 0.72f, z}), pose.point({x, 0.72f, z}));
  }
}

void Street::addCars() {
  const int most = 40;
  for (int i = 0; i < most; ++i) {
    const bool right = i % 2 == 1;
    const float z = -8 - 6.5f * static_cast<float>(i) - rng_.uniform(0, 2);
    if (z < -length_ + 6) return;
    const float angle = right ? 0.0f : kPi;
    const bool lit = rng_.uniform() < 0.4f && total_ >= 200 && spend(4);
    addCar(Pose::turned({right ? 2.9f : -2.9f, 0, z}, angle + rng_.uniform(-0.02f, 0.02f)), lit);
  }
}

void Street::build() {
  placeHouses();
  builder_.addCamera("street", {0.9f, 1.6f, 3}, {-0.4f, 2.6f, -16}, 0.95f);
  builder_.addCamera("balcony", {-5.9f, 6.5f, 2}, {2, 1.6f, -16}, 0.85f);
  builder_.addCamera("above", {26, 34, 22}, {-1, 2, -24}, 0.75f);
  if (spend(1))
    builder_.addDirectional({0.45f, -1, -0.35f}, tintColor(Tint::kBlue) * 0.04f + tintColor(Tint::kCool) * 0.10f);
  addGround();
  addLampPosts();
  addFestoons();
  addTrees();
  addCars();
  for (const House& house : houses_) {
    addHouse(house);
    addShopLights(house);
  }
  const std::size_t windows = left_;
  for (std::size_t i = 0; i < houses_.size(); ++i) {
    addWindows(houses_[i], windows / houses_.size() + (i < windows % houses_.size() ? 1 : 0));
  }
}

}  // namespace

void buildStreet(GlbBuilder& builder, std::size_t lights, std::uint64_t seed) {
  Street(builder, lights, seed).build();
}

}  // namespace cellcut
