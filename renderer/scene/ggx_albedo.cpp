#include "renderer/scene/ggx_albedo.h"

#include "renderer/scene/ggx.h"

#include <array>

namespace cellcut {
namespace {

constexpr int kRows = 32;          ///< steps in roughness
constexpr int kColumns = 32;       ///< steps in √μ, which are finer at grazing, where Fresnel's reflectance is steep
constexpr int kMicrofacets = 610;  ///< microfacets per entry: a Fibonacci number,
constexpr int kGenerator = 377;    ///< and the one before it, which makes a lattice of the unit square

struct Table {
  std::array<std::array<Vec2, kColumns + 1>, kRows + 1> albedo;
  std::array<Vec2, kRows + 1> mean;
};

/// Mean over the normals visible from wo of the share that leaves unshadowed, split by Schlick's weight.
Vec2 integrate(float alpha, const Vec3& wo) {
  Vec2 sum(0);
  const float lambdaOut = ggxLambda(alpha, wo);
  for (int i = 0; i < kMicrofacets; ++i) {
    const Vec2 u((static_cast<float>(i) + 0.5f) / kMicrofacets,
                 (static_cast<float>(i * kGenerator % kMicrofacets) + 0.5f) / kMicrofacets);
    const Vec3 h = sampleVisibleNormal(alpha, wo, u);
    const float cosine = glm::dot(wo, h);
    const Vec3 wi = 2 * cosine * h - wo;
    if (!(wi.z > 0)) continue;
    const float unshadowed = (1 + lambdaOut) / (1 + lambdaOut + ggxLambda(alpha, wi));
    const float weight = schlickWeight(cosine);
    sum += unshadowed * Vec2(1 - weight, weight);
  }
  return sum / static_cast<float>(kMicrofacets);
}

/// 2 ∫ E(μ) μ dμ over one step of t = √μ, in which E is linear in t.
Vec2 meanOfStep(const Vec2& e0, const Vec2& e1, float t0, float t1) {
  // E = a + b t, μ dμ = 2 t³ dt.
  const Vec2 b = (e1 - e0) / (t1 - t0), a = e0 - b * t0;
  const auto power = [](float t, int n) { return std::pow(t, static_cast<float>(n)); };
  return a * (power(t1, 4) - power(t0, 4)) + b * (0.8f * (power(t1, 5) - power(t0, 5)));
}

Table makeTable() {
  Table table{};
  for (std::size_t row = 0; row <= kRows; ++row) {
    const float alpha = ggxAlpha(static_cast<float>(row) / kRows);
    for (std::size_t column = 0; column <= kColumns; ++column) {
      const float t = static_cast<float>(column) / kColumns;
      const float cosine = std::max(1e-4f, t * t);  // Λ has no value at 0
      table.albedo[row][column] = integrate(alpha, {safeSqrt(1 - cosine * cosine), 0, cosine});
      if (column == 0) continue;
      const float before = static_cast<float>(column - 1) / kColumns;
      table.mean[row] += meanOfStep(table.albedo[row][column - 1], table.albedo[row][column], before, t);
    }
  }
  return table;
}

const Table& theTable() {
  static const Table table = makeTable();
  return table;
}

}  // namespace

void GgxAlbedo::prepare() {
  theTable();
}

GgxAlbedo::GgxAlbedo(float roughness) {
  const float at = roughness > 0 ? std::min(roughness, 1.0f) * kRows : 0.0f;
  row_ = std::min(static_cast<int>(at), kRows - 1);
  between_ = at - static_cast<float>(row_);
}

Vec2 GgxAlbedo::operator()(float cosine) const {
  const float at = safeSqrt(std::min(cosine, 1.0f)) * kColumns;
  const int column = std::min(static_cast<int>(at), kColumns - 1);
  const auto* row = &theTable().albedo[static_cast<std::size_t>(row_)];
  const auto along = [&](const auto& entries) {
    return glm::mix(entries[static_cast<std::size_t>(column)], entries[static_cast<std::size_t>(column) + 1],
                    at - static_cast<float>(column));
  };
  return glm::mix(along(row[0]), along(row[1]), between_);
}

Vec2 GgxAlbedo::mean() const {
  const auto* row = &theTable().mean[static_cast<std::size_t>(row_)];
  return glm::mix(row[0], row[1], between_);
}

}  // namespace cellcut
