/// \file colormap.h
/// Numbers in [0, 1] → colours, by published tables: the same bytes on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <glm/vec3.hpp>

namespace cellcut {

enum class Colormap : std::uint8_t { kViridis, kTurbo, kMagma };

struct ColormapName {
  Colormap colormap;
  std::string_view name;         ///< on the command line
  std::string_view description;  ///< one line
};

inline constexpr std::array kColormaps{
    ColormapName{Colormap::kViridis, "viridis", "dark blue to yellow, even steps, safe for colour-blind readers"},
    ColormapName{Colormap::kTurbo, "turbo", "rainbow from blue to red, shows the most detail"},
    ColormapName{Colormap::kMagma, "magma", "black over red to pale yellow, even steps"},
};

constexpr std::string_view nameOf(Colormap colormap) {
  return kColormaps[static_cast<std::size_t>(colormap)].name;
}

using Rgb8 = glm::vec<3, std::uint8_t>;  ///< sRGB, as a screen shows it

/// The colour of t in [0, 1]; beyond it is clamped. Entry floor(256 t) of the table, as Matplotlib does. \pre not NaN
Rgb8 colorOf(Colormap colormap, double t);

/// The tables behind colorOf(), 0xRRGGBB. Sources: colormap_tables.cpp.
using ColormapTable = std::array<std::uint32_t, 256>;
extern const ColormapTable kViridisTable, kTurboTable, kMagmaTable;

}  // namespace cellcut
