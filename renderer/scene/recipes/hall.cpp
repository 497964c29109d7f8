#include "renderer/scene/recipes/builders.h"
#include "renderer/scene/recipes/furniture.h"
#include "renderer/scene/recipes/lamps.h"

#include <algorithm>
#include <cmath>

namespace cellcut {

namespace {

// A nave along −z with an aisle on either side; the vault over the nave is a half cylinder.
constexpr float kBay = 6;
constexpr float kNave = 5;    ///< half width, to the columns' middle
constexpr float kAisle = 10;  ///< half width of the whole hall
constexpr float kSpring = 8;  ///< where the vault begins
constexpr float kAisleTop = 7;
constexpr float kBulb = 0.035f;  ///< radius of a candle's flame
constexpr int kVaultFacets = 24;
constexpr float kRadiance = 0.22f;  ///< aimed at, mean over the hall

class Hall {
 public:
  Hall(GlbBuilder& builder, std::size_t lights, std::uint64_t seed)
      : builder_(builder), palette_(builder), lights_(lights), rng_(hashOf(seed, 0x4a11u)) {
    const double chandeliers = std::pow(static_cast<double>(lights), 0.4);
    bays_ = std::max(5, static_cast<int>(std::ceil(chandeliers / 3)));
  }
  void build();

 private:
  float end() const { return -kBay * static_cast<float>(bays_); }
  void addShell();
  void addVault();
  void addColumns();
  void addTables();
  void addStatue(const Vec3& base);
  void addChandelier(const Vec3& ceiling, float drop, float radius, std::size_t lights, float flux);
  void addFlame(Tint tint, float radiance, const Vec3& at, std::size_t triangles);
  void light();

  GlbBuilder& builder_;
  Palette palette_;
  std::size_t lights_;
  Rng rng_;
  int bays_;
  std::vector<Vec3> candles_;  ///< where flames may stand on the tables
};

void Hall::addShell() {
  const float z = end();
  addQuad(palette_.flat(Paint::kMarble), {-kAisle, 0, 0}, {kAisle, 0, 0}, {kAisle, 0, z}, {-kAisle, 0, z});
  Surface& wall = palette_.flat(Paint::kSandstone);
  addQuad(wall, {-kAisle, 0, 0}, {-kAisle, 0, z}, {-kAisle, kAisleTop, z}, {-kAisle, kAisleTop, 0});
  addQuad(wall, {kAisle, 0, z}, {kAisle, 0, 0}, {kAisle, kAisleTop, 0}, {kAisle, kAisleTop, z});
  for (const float side : {-1.0f, 1.0f}) {
    const float x0 = side < 0 ? -kAisle : kNave, x1 = side < 0 ? -kNave : kAisle;
    addQuad(palette_.flat(Paint::kPlaster), {x0, kAisleTop, z}, {x1, kAisleTop, z}, {x1, kAisleTop, 0},
            {x0, kAisleTop, 0});
  }
  // The nave's walls between the aisles' ceilings and the vault.
  addQuad(wall, {-kNave, kAisleTop, 0}, {-kNave, kAisleTop, z}, {-kNave, kSpring, z}, {-kNave, kSpring, 0});
  addQuad(wall, {kNave, kAisleTop, z}, {kNave, kAisleTop, 0}, {kNave, kSpring, 0}, {kNave, kSpring, z});
}

/// Point k of the vault's half circle, from the right spring to the left.
Vec3 vaultPoint(int k, float radius, float z) {
  if (k == 0) return {radius, kSpring, z};
  if (k == kVaultFacets) return {-radius, kSpring, z};
  const float angle = kPi * static_cast<float>(k) / static_cast<float>(kVaultFacets);
  return {radius * std::cos(angle), kSpring + radius * std::sin(angle), z};
}

void Hall::addVault() {
  const float z = end();
  Surface& vault = palette_.flat(Paint::kPlaster);
  Surface& wall = palette_.flat(Paint::kSandstone);
  for (int k = 0; k < kVaultFacets; ++k) {
    addQuad(vault, vaultPoint(k, kNave, z), vaultPoint(k, kNave, 0), vaultPoint(k + 1, kNave, 0),
            vaultPoint(k + 1, kNave, z));
  }
  // End walls, as fans over the whole outline.
  for (const float at : {0.0f, z}) {
    std::vector<Vec3> outline{{-kAisle, 0, at}, {kAisle, 0, at}, {kAisle, kAisleTop, at}, {kNave, kAisleTop, at}};
    for (int k = 0; k <= kVaultFacets; ++k) outline.push_back(vaultPoint(k, kNave, at));
    outline.push_back({-kNave, kAisleTop, at});
    outline.push_back({-kAisle, kAisleTop, at});
    const std::uint32_t middle = wall.add({0, kAisleTop - 1, at});
    for (const Vec3& p : outline) wall.add(p);
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = middle + 1 + k, b = middle + 1 + (k + 1) % n;
      if (at < 0)
        wall.triangle(middle, a, b);
      else
        wall.triangle(middle, b, a);
    }
  }
  // Ribs over every pair of columns.
  constexpr float kRib = 0.3f;
  for (int b = 1; b < bays_; ++b) {
    const float mid = -kBay * static_cast<float>(b);
    for (int k = 0; k < kVaultFacets; ++k) {
      const auto p = [&](int i, float depth, float dz) { return vaultPoint(i, kNave - depth, mid + dz); };
      addQuad(wall, p(k, kRib, -0.25f), p(k, kRib, 0.25f), p(k + 1, kRib, 0.25f), p(k + 1, kRib, -0.25f));
      addQuad(wall, p(k, 0, 0.25f), p(k + 1, 0, 0.25f), p(k + 1, kRib, 0.25f), p(k, kRib, 0.25f));
      addQuad(wall, p(k + 1, 0, -0.25f), p(k, 0, -0.25f), p(k, kRib, -0.25f), p(k + 1, kRib, -0.25f));
    }
  }
}

void Hall::addColumns() {
  static constexpr std::array<Vec2, 14> kColumn{
      Vec2{0.62f, 0.0f},  Vec2{0.62f, 0.22f}, Vec2{0.62f, 0.22f}, Vec2{0.52f, 0.32f}, Vec2{0.42f, 0.42f},
      Vec2{0.42f, 0.42f}, Vec2{0.36f, 5.70f}, Vec2{0.36f, 5.70f}, Vec2{0.44f, 5.78f}, Vec2{0.44f, 5.88f},
      Vec2{0.40f, 5.96f}, Vec2{0.62f, 6.45f}, Vec2{0.62f, 6.45f}, Vec2{0.62f, 6.55f}};
  for (int b = 1; b < bays_; ++b) {
    for (const float x : {-kNave, kNave}) {
      const Vec3 base(x, 0, -kBay * static_cast<float>(b));
      addLathe(palette_.smooth(Paint::kStone), base, kColumn, 24);
      addBox(palette_.flat(Paint::kStone), {base}, {-0.66f, 6.5f, -0.66f}, {0.66f, kAisleTop + 0.05f, 0.66f});
      addBox(palette_.flat(Paint::kStone), {base}, {-0.34f, kAisleTop, -0.34f}, {0.34f, kSpring, 0.34f}, kBottom);
    }
  }
}

void Hall::addStatue(const Vec3& base) {
  static constexpr std::array<Vec2, 11> kFigure{Vec2{0.26f, 0},     Vec2{0.28f, 0.08f}, Vec2{0.20f, 0.16f},
                                                Vec2{0.14f, 0.5f},  Vec2{0.12f, 0.8f},  Vec2{0.22f, 0.9f},
                                                Vec2{0.12f, 0.96f}, Vec2{0.18f, 1.12f}, Vec2{0.17f, 1.25f},
                                                Vec2{0.10f, 1.36f}, Vec2{0, 1.40f}};
  static constexpr std::array kPaints{Paint::kGold, Paint::kGlaze, Paint::kCopper, Paint::kGlazeBlue};
  addBox(palette_.flat(Paint::kStone), {base}, {-0.35f, 0, -0.35f}, {0.35f, 0.7f, 0.35f}, kBottom);
  addLathe(palette_.smooth(kPaints[rng_.below(kPaints.size())]), base + Vec3(0, 0.701f, 0), kFigure, 24);
}

void Hall::addTables() {
  // Two long rows of tables with room for candles; beyond some hundred metres nobody sees them.
  const int rows = std::min(bays_ - 1, 24);
  for (int b = 1; b <= rows; ++b) {
    for (const float x : {-2.2f, 2.2f}) {
      const Pose pose{{x, 0, -kBay * static_cast<float>(b) - 0.5f * kBay}};
      Surface& wood = palette_.flat(Paint::kWalnut);
      addBox(wood, pose, {-0.45f, 0.72f, -2.3f}, {0.45f, 0.78f, 2.3f});
      for (const float z : {-1.9f, 1.9f})
        addBox(wood, pose, {-0.35f, 0, z - 0.06f}, {0.35f, 0.72f, z + 0.06f}, kTop | kBottom);
      for (const float side : {-0.85f, 0.85f}) {
        addBox(wood, pose, {side - 0.15f, 0.42f, -2.2f}, {side + 0.15f, 0.46f, 2.2f});
        for (const float z : {-1.8f, 1.8f}) {
          addBox(wood, pose, {side - 0.12f, 0, z - 0.04f}, {side + 0.12f, 0.42f, z + 0.04f}, kTop | kBottom);
        }
      }
      for (const float z : {-1.6f, 0.0f, 1.6f}) {
        const Vec3 foot = pose.point({rng_.uniform(-0.15f, 0.15f), 0.781f, z});
        addFrustum(palette_.flat(Paint::kGold), foot, 0.07f, 0.02f, 0.03f, 10);
        addFrustum(palette_.flat(Paint::kPaper), foot + Vec3(0, 0.031f, 0), 0.016f, 0.016f, 0.22f, 8);
        candles_.push_back(foot + Vec3(0, 0.251f + 0.02f, 0));
      }
      addVase(palette_, pose.point({0.1f, 0.781f, 0.8f}), 0.34f, Paint::kCopper);
      addSphere(palette_.smooth(Paint::kGlazeRed), pose.point({-0.12f, 0.781f + 0.09f, -0.8f}), 0.09f, 10, 16);
    }
    if (b % 2 == 1) {
      for (const float x : {-7.6f, 7.6f}) addStatue({x, 0, -kBay * static_cast<float>(b)});
    }
  }
}

/// A flame of up to four triangles; fewer where fewer lights are left, and then seen from both sides.
void Hall::addFlame(Tint tint, float radiance, const Vec3& at, std::size_t triangles) {
  if (triangles == 4) {
    addTetrahedron(palette_.emitter(tint, radiance), at, kBulb, rng_.uniform(0, kPi));
    return;
  }
  Surface& light = palette_.emitter(tint, radiance, true);
  for (std::size_t k = 0; k < triangles; ++k) {
    const Pose pose = Pose::turned(at, kPi * static_cast<float>(k) / 3 + 0.2f);
    const float aside = 0.3f * kBulb * static_cast<float>(k);
    addTriangle(light, pose.point({-kBulb, -kBulb, aside}), pose.point({kBulb, -kBulb, aside}),
                pose.point({0, kBulb, aside}));
  }
}

/// Rings of flames that grow smaller upwards.
void Hall::addChandelier(const Vec3& ceiling, float drop, float radius, std::size_t lights, float flux) {
  const Vec3 centre = ceiling - Vec3(0, drop, 0);
  Surface& iron = palette_.flat(Paint::kGold);
  const std::size_t flames = (lights + 3) / 4;
  const auto tiers = static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(flames) / 12), 1.0, 24.0));
  const float spacing = tiers > 4 ? 2.4f / static_cast<float>(tiers) : 0.55f;
  addBox(iron, {centre}, {-0.015f, -0.2f, -0.015f}, {0.015f, drop, 0.015f}, kTop);
  const float flameFlux = flux / static_cast<float>(std::max<std::size_t>(1, flames));
  const float radiance = flameFlux / (kPi * 4.6188f * kBulb * kBulb);  // a tetrahedron's area is 8/√3 r²
  std::size_t placed = 0;
  for (std::size_t tier = 0; tier < tiers; ++tier) {
    const float share = 1 - 0.8f * static_cast<float>(tier) / static_cast<float>(tiers);
    const float r = radius * share, y = spacing * static_cast<float>(tier);
    // Flames in proportion to the ring's length; the last ring takes the rest.
    const float sum = static_cast<float>(tiers) - 0.4f * static_cast<float>(tiers - 1);
    const std::size_t here =
        tier + 1 == tiers
            ? flames - placed
            : std::min(flames - placed, static_cast<std::size_t>(static_cast<float>(flames) * share / sum));
    constexpr int kSegments = 32;
    const float in = r + 0.005f, out = r + 0.03f, h = 0.05f;
    const std::array<Vec2, 8> ring{Vec2{in, 0}, {out, 0}, {out, 0}, {out, h}, {out, h}, {in, h}, {in, h}, {in, 0}};
    addLathe(palette_.smooth(Paint::kGold), centre + Vec3(0, y - 0.03f, 0), ring, kSegments);
    for (int spoke = 0; spoke < 3; ++spoke) {
      addBox(iron, Pose::turned(centre + Vec3(0, y, 0), kPi * static_cast<float>(spoke) / 3),
             {-r - 0.008f, -0.02f, -0.012f}, {r + 0.008f, 0.01f, 0.012f}, kLeft | kRight);
    }
    for (std::size_t i = 0; i < here; ++i, ++placed) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(here);
      const Vec3 at = centre + Vec3((r + 0.018f) * std::cos(angle), y + 0.09f, (r + 0.018f) * std::sin(angle));
      addFlame(radius > 1 ? Tint::kWarm : Tint::kNeutral, radiance, at, std::min<std::size_t>(4, lights - 4 * placed));
    }
  }
}

void Hall::light() {
  std::size_t left = lights_;
  const float area = 2 * (2 * kAisle * -end() + kAisleTop * -end()) + kPi * kNave * -end();
  constexpr float kAlbedo = 0.42f;
  const float flux = kRadiance * kPi * area * (1 - kAlbedo) / kAlbedo;  // as in lightRoom
  // A tenth of the lights, at most, are candles on the tables.
  const std::size_t candles = std::min(candles_.size(), left / 40);
  const std::size_t hung = left - 4 * candles;
  const float candleFlux = 0.1f * flux / static_cast<float>(candles_.size());
  for (std::size_t i = 0; i < candles; ++i) {
    addFlame(Tint::kCandle, candleFlux / (kPi * 4.6188f * kBulb * kBulb), candles_[i], 4);
  }
  // Over the nave one for every bay, then in the aisles; those that exist share the light by size.
  struct Place {
    Vec3 ceiling;
    float drop, radius, weight;
  };
  std::vector<Place> places;
  for (int b = 0; b < bays_; ++b) {
    const float z = -kBay * (static_cast<float>(b) + 0.5f);
    places.push_back({{0, kSpring + kNave - 0.01f, z}, 6.6f, 1.5f, 4});
  }
  if (lights_ >= 1000) {
    for (int b = 0; b < bays_; ++b) {
      const float z = -kBay * (static_cast<float>(b) + 0.5f);
      for (const float x : {-7.5f, 7.5f}) places.push_back({{x, kAisleTop, z}, 2.6f, 0.7f, 1});
    }
  }
  const std::size_t used = std::min(places.size(), std::max<std::size_t>(1, hung / 4));
  float weight = 0;
  for (std::size_t i = 0; i < used; ++i) weight += places[i].weight;
  std::size_t given = 0;
  float weightSoFar = 0;
  for (std::size_t i = 0; i < used; ++i) {
    weightSoFar += places[i].weight;
    const std::size_t upTo =
        i + 1 == used ? hung : static_cast<std::size_t>(static_cast<double>(hung) * weightSoFar / weight);
    const float strength = std::pow(10.0f, rng_.uniform(-0.5f, 0.25f));
    if (upTo > given) {
      addChandelier(places[i].ceiling, places[i].drop, places[i].radius, upTo - given,
                    strength * flux * places[i].weight / weight);
    }
    given = upTo;
  }
}

void Hall::build() {
  builder_.addCamera("nave", {1.1f, 1.9f, -0.8f}, {-0.5f, 3.0f, -20}, 1.0f);
  builder_.addCamera("aisle", {8.4f, 1.5f, -1}, {3, 2.2f, -16}, 0.95f);
  builder_.addCamera("tables", {0.4f, 1.15f, -5.2f}, {-2.0f, 0.7f, -11}, 0.8f);
  addShell();
  addVault();
  addColumns();
  addTables();
  light();
}

}  // namespace

void buildHall(GlbBuilder& builder, std::size_t lights, std::uint64_t seed) {
  Hall(builder, lights, seed).build();
}

}  // namespace cellcut
