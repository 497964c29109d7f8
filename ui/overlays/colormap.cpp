#include "ui/overlays/colormap.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cellcut {
namespace {

const ColormapTable& tableOf(Colormap colormap) {
  switch (colormap) {
    case Colormap::kViridis:
      return kViridisTable;
    case Colormap::kTurbo:
      return kTurboTable;
    case Colormap::kMagma:
      return kMagmaTable;
  }
  assert(false);
  return kViridisTable;
}

}  // namespace

Rgb8 colorOf(Colormap colormap, double t) {
  assert(!std::isnan(t));
  const auto index = static_cast<std::size_t>(std::clamp(t * 256, 0.0, 255.0));
  const std::uint32_t rgb = tableOf(colormap)[index];
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb)};
}

}  // namespace cellcut
