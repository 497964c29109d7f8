/// \file environment_light.h
/// The environment as lights: tiles of its picture, each sampled by scalar emission × solid angle.
///
/// The weight of a texel is the bilinear interpolant of the scalar emission integrated over the texel, times its solid
/// angle, so that it is positive wherever any radiance is. Weights are summed in a pyramid; a tile is a node of it, and
/// a direction is found by descending from the tile to a texel (hierarchical warping, Clarberg et al. 2005): no
/// difference of prefix sums, so that a dim texel beside the sun keeps its exact probability.
#pragma once

#include "renderer/scene/environment.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cellcut {

/// Directions and energy of one tile.
struct EnvironmentTile {
  std::uint8_t level;  ///< of the pyramid; 0 are texels
  std::uint32_t x, y;  ///< node at that level
  double weight;       ///< mean scalar emission × solid angle, W/m², > 0
  Vec3 axis;           ///< unit, middle of the tile
  float halfAngle;     ///< radians; every direction of the tile is within this angle of the axis
};

class EnvironmentLight {
 public:
  /// \param environment must outlive the light
  explicit EnvironmentLight(const Environment& environment);

  /// Tiles with energy, in the pyramid's depth-first order. Empty for a black environment.
  const std::vector<EnvironmentTile>& tiles() const { return tiles_; }

  struct Sample {
    Vec2 uv;  ///< in the picture: latLongFromDirection(direction)
    Vec3 direction;
    float pdf;  ///< over solid angle, given the tile
  };
  Sample sample(std::size_t tile, Vec2 u) const;
  /// \param uv  in the picture, inside the tile
  float pdf(std::size_t tile, Vec2 uv) const;

  /// The tile that a point of the picture falls into, unless that part is black.
  std::optional<std::size_t> tileAt(Vec2 uv) const;

  const Environment& environment() const { return environment_; }
  std::size_t bytes() const;

 private:
  struct Texel {
    std::uint32_t x, y;
  };
  struct Level {
    std::uint32_t width, height;
    std::vector<float> weights;
    float at(std::uint32_t x, std::uint32_t y) const {
      return x < width && y < height ? weights[static_cast<std::size_t>(y) * width + x] : 0.0f;
    }
  };
  void chooseUnit();
  void buildPyramid();
  void splitTiles();
  void addTile(std::uint8_t level, std::uint32_t x, std::uint32_t y);
  Texel texelAt(Vec2 uv) const;
  /// Probability density over solid angle of directions in a texel, given its tile.
  float density(const EnvironmentTile& tile, const Texel& texel) const;

  const Environment& environment_;
  std::vector<float> texelSolidAngles_;  ///< per row, sr
  std::vector<Level> levels_;            ///< weights in units of 2^exponent_ W/m²
  int exponent_ = 0;
  std::vector<EnvironmentTile> tiles_;
  /// Quadtree from the pyramid's top to the tiles: index of the first of four children, or ~tile, or kBlack.
  std::vector<std::int32_t> nodes_;
};

}  // namespace cellcut
