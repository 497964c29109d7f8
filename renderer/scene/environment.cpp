#include "renderer/scene/environment.h"

#include "renderer/base/error.h"
#include "renderer/scene/load_scene.h"

namespace cellcut {

namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

/// Rounding may bring a coordinate to 1.
float toHalfOpen(float unit) {
  return std::clamp(unit, 0.0f, kBelowOne);
}

/// Two neighbouring texels on one axis and how far the point is towards the second.
struct Neighbours {
  int first;
  int second;
  float fraction;
};

Neighbours neighbours(float coordinate, int size) {
  const float texel = coordinate * static_cast<float>(size) - 0.5f;
  const float floor = std::floor(texel);
  return {static_cast<int>(floor), static_cast<int>(floor) + 1, texel - floor};
}

Vec3 scaled(const Vec3& texel, double scale, const std::string& name) {
  const glm::dvec3 product = scale * glm::dvec3(texel);
  if (std::max({product.x, product.y, product.z}) > std::numeric_limits<float>::max()) {
    throw InputError(name, "becomes too bright for 32-bit floats when scaled; choose a smaller scale");
  }
  return Vec3(product);
}

}  // namespace

Vec2 latLongFromDirection(const Environment& environment, const Vec3& direction) {
  const float azimuth = std::atan2(direction.z, direction.x) + environment.rotation;
  const float turns = 0.5f + azimuth * (0.5f * kInvPi);
  // Not acos(y): near the poles that knows the angle to 3e-4 only.
  const float polar = std::atan2(std::hypot(direction.x, direction.z), direction.y);
  return {toHalfOpen(turns - std::floor(turns)), toHalfOpen(polar * kInvPi)};
}

Vec3 directionFromLatLong(const Environment& environment, Vec2 uv) {
  const float azimuth = 2 * kPi * (uv.x - 0.5f) - environment.rotation;
  const float polar = kPi * uv.y;
  const float sine = std::sin(polar);
  return {sine * std::cos(azimuth), std::cos(polar), sine * std::sin(azimuth)};
}

Vec3 environmentRadiance(const Environment& environment, Vec2 uv) {
  const ImageRgb& image = environment.radiance;
  Neighbours x = neighbours(uv.x, image.width());
  Neighbours y = neighbours(uv.y, image.height());
  if (x.first < 0) x.first = image.width() - 1;
  if (x.second == image.width()) x.second = 0;
  y.first = std::max(y.first, 0);
  y.second = std::min(y.second, image.height() - 1);
  // A weighted sum of numbers ≥ 0: no rounding makes it negative.
  const Vec3 upper = (1 - x.fraction) * image.at(x.first, y.first) + x.fraction * image.at(x.second, y.first);
  const Vec3 lower = (1 - x.fraction) * image.at(x.first, y.second) + x.fraction * image.at(x.second, y.second);
  return (1 - y.fraction) * upper + y.fraction * lower;
}

void setEnvironment(Scene& scene, ImageRgb radiance, double scale, double rotation, const std::string& name) {
  if (radiance.empty()) throw InputError(name, "has no pixels");
  if (!std::isfinite(scale) || scale < 0) throw InputError(name, "its scale must be a number that is not negative");
  if (!std::isfinite(rotation)) throw InputError(name, "its rotation must be a number of degrees");

  std::size_t notFinite = 0, negative = 0;
  for (Vec3& texel : radiance) {
    if (!isFinite(texel)) {
      ++notFinite;
      texel = Vec3(0.0f);
    } else if (texel.x < 0 || texel.y < 0 || texel.z < 0) {  // filters that ring, colors out of Rec. 709
      ++negative;
      texel = glm::max(texel, Vec3(0.0f));
    }
    texel = scaled(texel, scale, name);
  }
  const auto warn = [&](std::size_t count, const std::string& problem) {
    if (count == 0) return;
    scene.warnings.push_back(name + ": " + std::to_string(count) + (count == 1 ? " texel is " : " texels are ") +
                             problem);
  };
  warn(notFinite, "NaN or infinite and taken as black");
  warn(negative, "negative in some channel, which is taken as 0");
  const double turn = std::fmod(rotation, 360.0) * std::numbers::pi / 180;
  scene.environment = Environment{std::move(radiance), static_cast<float>(turn)};
}

}  // namespace cellcut
