#include "renderer/lights/environment_light.h"

#include "renderer/lights/scalar_emission.h"

#include <oneapi/tbb/parallel_for.h>

namespace cellcut {
namespace {

/// A tile with more than this share of the energy is split. 1/256: an even sky becomes a few hundred tiles, fine enough
/// for the horizon's cosine, and the sun a tile of its own.
constexpr float kTileShare = 1.0f / 256;

/// Weights are scaled so that the brightest radiance is about 2 to this power: the sum over a sphere of it is finite,
/// and the weight of a texel 60 decades dimmer at the pole of a large picture is not denormal.
constexpr int kBrightestExponent = 100;

constexpr std::int32_t kBlack = std::numeric_limits<std::int32_t>::min();

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : environment_(environment) {
  const double height = environment.radiance.height(), width = environment.radiance.width();
  constexpr double pi = std::numbers::pi;
  for (int y = 0; y < environment.radiance.height(); ++y) {
    // cos a − cos b as a product: no cancellation at the poles.
    const double band = 2 * std::sin(pi * (y + 0.5) / height) * std::sin(pi * 0.5 / height);
    texelSolidAngles_.push_back(static_cast<float>(2 * pi / width * band));
  }
  chooseUnit();
  buildPyramid();
  if (levels_.back().weights[0] > 0) splitTiles();
}

void EnvironmentLight::chooseUnit() {
  double brightest = 0;
  for (const Vec3& radiance : environment_.radiance) brightest = std::max(brightest, scalarEmission(radiance));
  if (brightest > 0) exponent_ = std::ilogb(brightest) - kBrightestExponent;
}

void EnvironmentLight::buildPyramid() {
  const ImageRgb& image = environment_.radiance;
  const int width = image.width(), height = image.height();
  Level texels{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  texels.weights.resize(image.size());
  const double scale = std::ldexp(1.0, -exponent_);
  tbb::parallel_for(0, height, [&](int y) {
    const double scaledAngle = static_cast<double>(texelSolidAngles_[static_cast<std::size_t>(y)]) * scale;
    // The integral of a bilinear interpolant over a texel: (1 6 1)/8 on each axis.
    std::vector<double> columns(texels.width);
    for (int x = 0; x < width; ++x) {
      const auto at = [&](int row) { return scalarEmission(image.at(x, std::clamp(row, 0, height - 1))); };
      columns[static_cast<std::size_t>(x)] = 0.125 * (at(y - 1) + at(y + 1)) + 0.75 * at(y);
    }
    float* weights = &texels.weights[static_cast<std::size_t>(y) * texels.width];
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const double before = columns[x > 0 ? x - 1 : columns.size() - 1];
      const double after = columns[x + 1 < columns.size() ? x + 1 : 0];
      weights[x] = static_cast<float>((0.125 * (before + after) + 0.75 * columns[x]) * scaledAngle);
    }
  });
  levels_.push_back(std::move(texels));
  while (levels_.back().weights.size() > 1) {
    const Level& fine = levels_.back();
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    coarse.weights.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
    for (std::uint32_t y = 0; y < coarse.height; ++y) {
      for (std::uint32_t x = 0; x < coarse.width; ++x) {
        coarse.weights.push_back((fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y)) +
                                 (fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1)));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

void EnvironmentLight::splitTiles() {
  const float limit = kTileShare * levels_.back().weights[0];
  struct Pending {
    std::uint32_t x, y;
    std::size_t node;
    std::uint8_t level;
  };
  std::vector<Pending> stack{{0, 0, 0, static_cast<std::uint8_t>(levels_.size() - 1)}};
  nodes_.assign(1, kBlack);
  while (!stack.empty()) {
    const Pending p = stack.back();
    stack.pop_back();
    const float weight = levels_[p.level].at(p.x, p.y);
    if (!(weight > 0)) continue;
    if (p.level == 0 || weight <= limit) {
      nodes_[p.node] = ~static_cast<std::int32_t>(tiles_.size());
      addTile(p.level, p.x, p.y);
      continue;
    }
    const std::size_t children = nodes_.size();
    nodes_[p.node] = static_cast<std::int32_t>(children);
    nodes_.resize(children + 4, kBlack);
    for (std::uint32_t c = 4; c-- > 0;) {
      stack.push_back({2 * p.x + (c & 1), 2 * p.y + (c >> 1), children + c, static_cast<std::uint8_t>(p.level - 1)});
    }
  }
}

void EnvironmentLight::addTile(std::uint8_t level, std::uint32_t x, std::uint32_t y) {
  const auto width = static_cast<float>(levels_[0].width), height = static_cast<float>(levels_[0].height);
  const auto size = static_cast<float>(1u << level);
  const float u0 = static_cast<float>(x) * size / width, u1 = std::min(1.0f, static_cast<float>(x + 1) * size / width);
  const float v0 = static_cast<float>(y) * size / height,
              v1 = std::min(1.0f, static_cast<float>(y + 1) * size / height);
  // From the middle to any direction: first along the meridian, then along a parallel, which is no shorter than the
  // great circle.
  const float halfLatitude = kPi * 0.5f * (v1 - v0);
  const float widest = v0 <= 0.5f && v1 >= 0.5f ? 1.0f : std::max(std::sin(kPi * v0), std::sin(kPi * v1));
  const float halfAngle = std::min(kPi, halfLatitude + kPi * (u1 - u0) * widest);
  tiles_.push_back({level, x, y, std::ldexp(static_cast<double>(levels_[level].at(x, y)), exponent_),
                    directionFromLatLong(environment_, {0.5f * (u0 + u1), 0.5f * (v0 + v1)}), halfAngle});
}

EnvironmentLight::Sample EnvironmentLight::sample(std::size_t tile, Vec2 u) const {
  std::uint32_t x = tiles_[tile].x, y = tiles_[tile].y;
  for (int level = tiles_[tile].level - 1; level >= 0; --level) {
    const Level& l = levels_[static_cast<std::size_t>(level)];
    x *= 2, y *= 2;
    const float top = l.at(x, y) + l.at(x + 1, y), bottom = l.at(x, y + 1) + l.at(x + 1, y + 1);
    // Choose a row, then a column in it; what is left of each number is uniform again.
    const auto choose = [](float first, float second, float& number, std::uint32_t& coordinate) {
      const float p = first / (first + second);
      if (number < p) {
        number = std::min(number / p, 0x1.fffffep-1f);
      } else {
        number = std::clamp((number - p) / (1 - p), 0.0f, 0x1.fffffep-1f);
        ++coordinate;
      }
    };
    choose(top, bottom, u.y, y);
    choose(l.at(x, y), l.at(x + 1, y), u.x, x);
  }
  // Inside the texel uniformly in solid angle: in longitude and in cosθ.
  const auto width = static_cast<float>(levels_[0].width), height = static_cast<float>(levels_[0].height);
  const float cosTop = std::cos(kPi * static_cast<float>(y) / height);
  const float cosBottom = std::cos(kPi * static_cast<float>(y + 1) / height);
  const float v = std::acos(std::clamp(cosTop + u.y * (cosBottom - cosTop), -1.0f, 1.0f)) * kInvPi;
  const Vec2 uv((static_cast<float>(x) + u.x) / width, v);
  return {uv, directionFromLatLong(environment_, uv), density(tiles_[tile], {x, y})};
}

EnvironmentLight::Texel EnvironmentLight::texelAt(Vec2 uv) const {
  const auto width = levels_[0].width, height = levels_[0].height;
  return {std::min(static_cast<std::uint32_t>(uv.x * static_cast<float>(width)), width - 1),
          std::min(static_cast<std::uint32_t>(uv.y * static_cast<float>(height)), height - 1)};
}

float EnvironmentLight::density(const EnvironmentTile& tile, const Texel& texel) const {
  return levels_[0].at(texel.x, texel.y) / levels_[tile.level].at(tile.x, tile.y) / texelSolidAngles_[texel.y];
}

float EnvironmentLight::pdf(std::size_t tile, Vec2 uv) const {
  return density(tiles_[tile], texelAt(uv));
}

std::optional<std::size_t> EnvironmentLight::tileAt(Vec2 uv) const {
  if (nodes_.empty()) return std::nullopt;
  const Texel texel = texelAt(uv);
  std::size_t node = 0;
  for (std::size_t level = levels_.size() - 1; nodes_[node] >= 0; --level) {
    const std::uint32_t column = (texel.x >> (level - 1)) & 1, row = (texel.y >> (level - 1)) & 1;
    node = static_cast<std::size_t>(nodes_[node]) + column + 2 * row;
  }
  if (nodes_[node] == kBlack) return std::nullopt;
  return static_cast<std::size_t>(~nodes_[node]);
}

std::size_t EnvironmentLight::bytes() const {
  std::size_t sum = texelSolidAngles_.capacity() * sizeof(float) + tiles_.capacity() * sizeof(EnvironmentTile) +
                    nodes_.capacity() * sizeof(std::int32_t);
  for (const Level& level : levels_) sum += level.weights.capacity() * sizeof(float);
  return sum;
}

}  // namespace cellcut
