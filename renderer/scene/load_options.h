/// \file load_options.h
/// What a person may say of how a scene file is taken.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cellcut {

/// Beyond these a scene is refused before memory for it is asked for: a small file can ask for any amount by instances
/// and by pictures that pack well.
struct LoadLimits {
  /// With instances written out; 8 GB with their attributes.
  std::size_t maxTriangles = std::size_t{1} << 27;
  /// Of all pictures on surfaces together, and of the environment, decoded.
  std::uint64_t maxTextureBytes = std::uint64_t{1} << 33;
};

struct LoadOptions {
  double punctualScale = 1;  ///< multiplies point, spot and directional lights; 1/683 undoes Blender's lm/W
  LoadLimits limits{};
};

}  // namespace cellcut
