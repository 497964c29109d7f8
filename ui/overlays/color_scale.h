/// \file color_scale.h
/// Values → colours, and the legend that says which is which.
///
/// With a linear scale colours are the same bytes on every machine; a logarithmic one may differ by one entry of the
/// table where a value lies within a rounding of a step, for machines round logarithms differently.
#pragma once

#include "renderer/base/image_io.h"
#include "ui/overlays/colormap.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

enum class ScaleKind : std::uint8_t { kLinear, kLog };

constexpr std::string_view nameOf(ScaleKind kind) {
  return kind == ScaleKind::kLog ? "log" : "linear";
}

struct ValueRange {
  double minimum;
  double maximum;
  bool operator==(const ValueRange&) const = default;
};

struct ScaleSettings {
  std::optional<ValueRange> pinned;  ///< nothing: the range of the values
  ScaleKind kind = ScaleKind::kLinear;
  Colormap colormap = Colormap::kViridis;

  bool operator==(const ScaleSettings&) const = default;
};

/// Least and largest of the finite values, for a logarithm of the positive ones and of eight decades at most; nothing when
/// there is none.
std::optional<ValueRange> autoRange(const Image<float>& values, ScaleKind kind);

/// A scale whose range is known.
class ColorScale {
 public:
  /// The range that the settings ask for: pinned, or autoRange(values). A pinned range is put in order, and one that a
  /// logarithm cannot show (nothing of it is positive) counts as not pinned; where only its minimum is not positive, it
  /// starts three decades below its maximum.
  ColorScale(const Image<float>& values, const ScaleSettings& settings);

  /// Nothing when there are no values to take it from.
  const std::optional<ValueRange>& range() const { return range_; }
  ScaleKind kind() const { return settings_.kind; }

  /// Where a value lies on the bar, 0 at its minimum and 1 at its maximum, clamped. Half-way in a range of one value; 0
  /// without a range. ±Infinity lies at the ends; for a logarithm, values that are not positive at 0. \pre not NaN
  double position(double value) const;
  Rgb8 color(double value) const { return colorOf(settings_.colormap, position(value)); }

 private:
  ScaleSettings settings_;
  std::optional<ValueRange> range_;
};

/// A picture of the values, `opacity` in [0, 1] as its alpha, not premultiplied. NaN is transparent black.
ImageRgba8 colorize(const Image<float>& values, const ColorScale& scale, float opacity);

using Rgba8 = glm::vec<4, std::uint8_t>;  ///< sRGB and alpha, not premultiplied

/// One colour over another, in integers rounded to nearest: the same on every machine.
Rgba8 over(const Rgba8& below, const Rgba8& above);

struct LegendTick {
  double value;
  double position;    ///< on the bar, [0, 1] from its minimum
  std::string label;  ///< "0.25", "3e-07"
};

struct Legend {
  std::string title;
  std::string unit;                 ///< may be empty
  std::optional<ValueRange> range;  ///< nothing: no value anywhere, and no ticks
  std::vector<LegendTick> ticks;    ///< ascending; at least one, at most nine
};

/// Ticks at 1, 2 or 5 times powers of ten (logarithmic: at powers of ten, if two or more lie in the range). A range of
/// one value has that value.
/// \param integral  ticks at whole numbers only
Legend makeLegend(const ColorScale& scale, std::string_view title, std::string_view unit, bool integral);

/// A value with up to `digits` significant digits, as short as it can be: "12", "0.5", "1.3e-05".
std::string shortNumber(double value, int digits = 6);

}  // namespace cellcut
