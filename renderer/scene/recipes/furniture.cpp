#include "renderer/scene/recipes/furniture.h"

#include <array>

namespace cellcut {

namespace {

template <std::size_t N>
Paint pick(const std::array<Paint, N>& paints, Rng& rng) {
  return paints[rng.below(static_cast<std::uint32_t>(N))];
}

constexpr std::array kWoods{Paint::kOak, Paint::kWalnut};
constexpr std::array kGlazes{Paint::kGlaze, Paint::kGlazeBlue, Paint::kGlazeRed,
                             Paint::kGold,  Paint::kSteel,     Paint::kCopper};
constexpr std::array kBindings{Paint::kRedCloth,   Paint::kBlueCloth, Paint::kGreenCloth, Paint::kMustardCloth,
                               Paint::kWhiteCloth, Paint::kPaper,     Paint::kSlate,      Paint::kRose};

/// Board on four legs, around the pose.
void addTable(Surface& s, const Pose& pose, Vec3 size) {
  constexpr float kBoard = 0.04f;
  constexpr float kLeg = 0.05f;
  const Vec3 half(size.x / 2, 0, size.z / 2);
  addBox(s, pose, {-half.x, size.y - kBoard, -half.z}, {half.x, size.y, half.z});
  for (const float x : {-half.x + 0.02f, half.x - 0.02f - kLeg}) {
    for (const float z : {-half.z + 0.02f, half.z - 0.02f - kLeg}) {
      addBox(s, pose, {x, 0, z}, {x + kLeg, size.y - kBoard, z + kLeg}, kTop | kBottom);
    }
  }
}

}  // namespace

void addChair(Palette& palette, const Pose& centre, Paint wood) {
  addTable(palette.flat(wood), centre, {0.42f, 0.45f, 0.42f});
  addBox(palette.flat(wood), centre, {-0.21f, 0.55f, -0.21f}, {0.21f, 0.90f, -0.18f});
  for (const float x : {-0.20f, 0.17f}) {
    addBox(palette.flat(wood), centre, {x, 0.45f, -0.205f}, {x + 0.03f, 0.55f, -0.185f}, kTop | kBottom);
  }
}

void addSofa(Palette& palette, const Pose& wall, Paint cloth) {
  Surface& s = palette.flat(cloth);
  addBox(s, wall, {-0.95f, 0, 0.03f}, {-0.78f, 0.60f, 0.90f}, kBottom);
  addBox(s, wall, {0.78f, 0, 0.03f}, {0.95f, 0.60f, 0.90f}, kBottom);
  addBox(s, wall, {-0.775f, 0, 0.03f}, {0.775f, 0.80f, 0.25f}, kBottom);
  addBox(s, wall, {-0.775f, 0, 0.255f}, {-0.005f, 0.43f, 0.86f}, kBottom);
  addBox(s, wall, {0.005f, 0, 0.255f}, {0.775f, 0.43f, 0.86f}, kBottom);
  const Paint cushion = cloth == Paint::kMustardCloth ? Paint::kBlueCloth : Paint::kMustardCloth;
  addBox(palette.flat(cushion), wall.at({0.5f, 0.435f, 0.36f}, 0.3f), {-0.2f, 0, -0.06f}, {0.2f, 0.36f, 0.06f});
}

void addBed(Palette& palette, const Pose& wall, Paint cloth) {
  addBox(palette.flat(Paint::kWalnut), wall, {-0.75f, 0, 0.01f}, {0.75f, 0.95f, 0.07f}, kBottom);
  addBox(palette.flat(Paint::kWalnut), wall, {-0.72f, 0, 0.075f}, {0.72f, 0.26f, 2.05f}, kBottom | kTop);
  addBox(palette.flat(Paint::kWhiteCloth), wall, {-0.70f, 0.26f, 0.08f}, {0.70f, 0.45f, 2.03f});
  addBox(palette.flat(cloth), wall, {-0.74f, 0.28f, 0.75f}, {0.74f, 0.48f, 2.07f});
  for (const float x : {-0.36f, 0.36f}) {
    addBox(palette.flat(Paint::kWhiteCloth), wall.at({x, 0.46f, 0.32f}), {-0.28f, 0, -0.18f}, {0.28f, 0.11f, 0.18f});
  }
}

void addShelf(Palette& palette, const Pose& wall, std::uint32_t books, Rng& rng) {
  Surface& wood = palette.flat(pick(kWoods, rng));
  constexpr float kHeight = 1.9f;
  constexpr float kDepth = 0.30f;
  constexpr int kBoards = 5;
  addBox(wood, wall, {-0.50f, 0, 0.01f}, {-0.47f, kHeight, kDepth}, kBottom);
  addBox(wood, wall, {0.47f, 0, 0.01f}, {0.50f, kHeight, kDepth}, kBottom);
  addBox(wood, wall, {-0.47f, 0, 0.012f}, {0.47f, kHeight - 0.01f, 0.025f}, kBottom | kLeft | kRight);
  for (int i = 0; i < kBoards; ++i) {
    const float y = 0.08f + 0.44f * static_cast<float>(i);
    addBox(wood, wall, {-0.47f, y, 0.025f}, {0.47f, y + 0.025f, kDepth - 0.01f}, kLeft | kRight | kBack);
    if (i + 1 == kBoards) continue;
    float x = -0.45f;
    for (std::uint32_t b = 0; b < books; ++b) {
      const float width = rng.uniform(0.03f, 0.11f);
      if (x + width > 0.45f) break;
      addBox(palette.flat(pick(kBindings, rng)), wall, {x, y + 0.026f, 0.04f},
             {x + width, y + rng.uniform(0.22f, 0.36f), rng.uniform(0.18f, 0.27f)});
      x += width + (rng.uniform() < 0.2f ? 0.12f : 0.004f);
    }
  }
}

void addDesk(Palette& palette, const Pose& wall, Rng& rng) {
  const Paint wood = pick(kWoods, rng);
  addTable(palette.flat(wood), wall.at({0, 0, 0.36f}), {1.4f, 0.74f, 0.68f});
  Surface& black = palette.flat(Paint::kBlackCloth);
  addBox(black, wall, {-0.30f, 0.86f, 0.14f}, {0.30f, 1.22f, 0.17f});
  addBox(black, wall, {-0.03f, 0.741f, 0.10f}, {0.03f, 0.90f, 0.13f});
  addBox(black, wall, {-0.22f, 0.742f, 0.38f}, {0.22f, 0.76f, 0.52f});
  addBox(palette.flat(pick(kBindings, rng)), wall.at({0.5f, 0.742f, 0.4f}, 0.4f), {-0.1f, 0, -0.14f},
         {0.1f, rng.uniform(0.03f, 0.18f), 0.14f});
  addChair(palette, wall.at({rng.uniform(-0.2f, 0.2f), 0, 1.05f}, kPi + rng.uniform(-0.4f, 0.4f)), wood);
}

void addVase(Palette& palette, const Vec3& base, float height, Paint glaze) {
  const std::array<Vec2, 9> profile{Vec2{0, 0},         Vec2{0.18f, 0},     Vec2{0.18f, 0},
                                    Vec2{0.34f, 0.25f}, Vec2{0.36f, 0.45f}, Vec2{0.22f, 0.75f},
                                    Vec2{0.13f, 0.88f}, Vec2{0.20f, 1.0f},  Vec2{0, 0.97f}};
  std::array<Vec2, 9> scaled{};
  for (std::size_t i = 0; i < profile.size(); ++i) scaled[i] = height * profile[i];
  addLathe(palette.smooth(glaze), base, scaled, 20);
}

void addDiningTable(Palette& palette, const Pose& centre, Rng& rng) {
  const Paint wood = pick(kWoods, rng);
  addTable(palette.flat(wood), centre, {1.2f, 0.74f, 0.9f});
  const std::array<float, 4> offsets{-0.3f, 0.3f, -0.3f, 0.3f};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const bool back = i < 2;
    addChair(palette, centre.at({offsets[i], 0, back ? -0.56f : 0.56f}, (back ? 0 : kPi) + rng.uniform(-0.25f, 0.25f)),
             wood);
  }
  addVase(palette, centre.point({rng.uniform(-0.3f, 0.3f), 0.742f, rng.uniform(-0.15f, 0.15f)}),
          rng.uniform(0.2f, 0.4f), pick(kGlazes, rng));
}

void addCoffeeTable(Palette& palette, const Pose& centre, Rng& rng) {
  addTable(palette.flat(pick(kWoods, rng)), centre, {1.0f, 0.40f, 0.55f});
  addBox(palette.flat(pick(kBindings, rng)), centre.at({-0.25f, 0.402f, 0}, rng.uniform(-0.6f, 0.6f)),
         {-0.12f, 0, -0.09f}, {0.12f, 0.05f, 0.09f});
  addSphere(palette.smooth(pick(kGlazes, rng)), centre.point({0.22f, 0.402f + 0.11f, 0.05f}), 0.11f, 10, 20);
}

void addPlant(Palette& palette, const Pose& centre, float height, Rng& rng) {
  const float pot = 0.28f * std::min(1.0f, height);
  addFrustum(palette.flat(Paint::kTerracotta), centre.origin, 0.6f * pot, 0.75f * pot, pot, 14, kBottom | kTop);
  addFrustum(palette.flat(Paint::kSoil), centre.point({0, 0.9f * pot, 0}), 0.72f * pot, 0, 0.02f, 14, kBottom);
  Surface& leaf = palette.flat(Paint::kLeaf);
  constexpr int kLeaves = 14;
  for (int i = 0; i < kLeaves; ++i) {
    const Pose blade =
        centre.at({0, 0, 0}, 2.4f * static_cast<float>(i));  // near the golden angle: no two above each other
    const float reach = rng.uniform(0.18f, 0.34f);
    const float top = height * rng.uniform(0.6f, 1.0f);
    const float width = rng.uniform(0.03f, 0.06f);
    const Vec3 root = blade.point({0, 0.92f * pot, 0.01f});
    const Vec3 left = blade.point({-width, 0.7f * top, 0.5f * reach});
    const Vec3 right = blade.point({width, 0.7f * top, 0.5f * reach});
    const std::uint32_t v = leaf.add(root);
    leaf.add(right);
    leaf.add(left);
    leaf.add(blade.point({0, top, reach}));
    leaf.triangle(v, v + 1, v + 2);
    leaf.triangle(v + 2, v + 1, v + 3);
  }
}

void addPedestal(Palette& palette, const Pose& centre, Rng& rng) {
  addBox(palette.flat(Paint::kPlaster), centre, {-0.2f, 0, -0.2f}, {0.2f, 0.95f, 0.2f}, kBottom);
  const Paint glaze = pick(kGlazes, rng);
  if (rng.uniform() < 0.5f) {
    addSphere(palette.smooth(glaze), centre.point({0, 1.131f, 0}), 0.18f, 12, 24);
  } else {
    addVase(palette, centre.point({0, 0.951f, 0}), 0.5f, glaze);
  }
}

void addCrates(Palette& palette, const Pose& centre, Rng& rng) {
  float y = 0;
  float half = rng.uniform(0.28f, 0.36f);
  const std::uint32_t count = 1 + rng.below(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    // Up to √2 · half from the middle: the largest crate stays in its footprint whatever its angle.
    addBox(palette.flat(i % 2 ? Paint::kWalnut : Paint::kOak), centre.at({0, y, 0}, rng.uniform(0, kPi / 2)),
           {-half, 0, -half}, {half, 1.6f * half, half}, i == 0 ? unsigned{kBottom} : 0u);
    y += 1.6f * half + 0.001f;
    half *= rng.uniform(0.65f, 0.9f);
  }
}

void addPicture(Palette& palette, const Pose& wall, Vec2 size, Rng& rng) {
  const Vec2 half = size * 0.5f;
  addBox(palette.flat(rng.uniform() < 0.4f ? Paint::kGold : Paint::kWalnut), wall, {-half.x, -half.y, 0},
         {half.x, half.y, 0.03f}, kBack);
  addBox(palette.flat(pick(kBindings, rng)), wall, {-half.x + 0.04f, -half.y + 0.04f, 0.03f},
         {half.x - 0.04f, half.y - 0.04f, 0.034f}, kBack);
  const float split = rng.uniform(-0.4f, 0.4f) * half.y;
  addBox(palette.flat(pick(kBindings, rng)), wall, {-half.x + 0.06f, -half.y + 0.06f, 0.034f},
         {half.x - 0.06f, split, 0.037f}, kBack);
}

}  // namespace cellcut
