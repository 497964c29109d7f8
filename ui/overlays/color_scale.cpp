#include "ui/overlays/color_scale.h"

#include <cassert>
#include <cmath>
#include <cstdio>

namespace cellcut {
namespace {

/// Ticks are aimed at; between half and twice as many are drawn.
constexpr double kTicks = 5;
constexpr std::size_t kMaxTicks = 9;
/// Share of the maximum that a logarithm starts at where its minimum was pinned to nothing or less.
constexpr double kPinnedDecades = 1e-3;
/// The same where it was not pinned: what rounding leaves of a variance, 10⁻²⁸, would take all colours.
constexpr double kMostDecades = 1e-8;

std::optional<ValueRange> usable(const std::optional<ValueRange>& pinned, ScaleKind kind) {
  if (!pinned || !std::isfinite(pinned->minimum) || !std::isfinite(pinned->maximum)) return std::nullopt;
  ValueRange range{std::min(pinned->minimum, pinned->maximum), std::max(pinned->minimum, pinned->maximum)};
  if (kind == ScaleKind::kLinear) return range;
  if (!(range.maximum > 0)) return std::nullopt;
  if (!(range.minimum > 0)) range.minimum = kPinnedDecades * range.maximum;
  return range;
}

/// 1, 2 or 5 times a power of ten, the nearest one not below `step` by more than rounding.
double niceStep(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<double> linearTicks(const ValueRange& range, bool integral) {
  double step = niceStep((range.maximum - range.minimum) / kTicks);
  if (integral) step = std::max(step, 1.0);
  std::vector<double> ticks;
  // Counted in steps and not summed, so that the last tick is not lost to rounding; a billionth of a step is rounding.
  const double first = std::ceil(range.minimum / step - 1e-9), last = std::floor(range.maximum / step + 1e-9);
  for (double i = first; i <= last && ticks.size() < kMaxTicks; ++i) ticks.push_back(i * step + 0.0);
  return ticks;
}

std::vector<double> logTicks(const ValueRange& range, bool integral) {
  const int first = static_cast<int>(std::ceil(std::log10(range.minimum) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(range.maximum) + 1e-9));
  if (last - first < 1) return linearTicks(range, integral);
  const int stride = (last - first) / static_cast<int>(kMaxTicks) + 1;
  std::vector<double> ticks;
  for (int exponent = first; exponent <= last; exponent += stride) ticks.push_back(std::pow(10.0, exponent));
  return ticks;
}

}  // namespace

std::optional<ValueRange> autoRange(const Image<float>& values, ScaleKind kind) {
  std::optional<ValueRange> range;
  for (const float value : values) {
    if (!std::isfinite(value) || (kind == ScaleKind::kLog && !(value > 0))) continue;
    const auto v = static_cast<double>(value);
    range = range ? ValueRange{std::min(range->minimum, v), std::max(range->maximum, v)} : ValueRange{v, v};
  }
  if (range && kind == ScaleKind::kLog) range->minimum = std::max(range->minimum, kMostDecades * range->maximum);
  return range;
}

ColorScale::ColorScale(const Image<float>& values, const ScaleSettings& settings)
    : settings_(settings), range_(usable(settings.pinned, settings.kind)) {
  if (!range_) range_ = autoRange(values, settings.kind);
}

double ColorScale::position(double value) const {
  assert(!std::isnan(value));
  if (!range_) return 0;
  double low = range_->minimum, high = range_->maximum;
  if (low == high) return value < low ? 0 : (value > high ? 1 : 0.5);
  if (value <= low) return 0;
  if (value >= high) return 1;
  if (settings_.kind == ScaleKind::kLog) {
    low = std::log10(low);
    high = std::log10(high);
    value = std::log10(value);
  }
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

ImageRgba8 colorize(const Image<float>& values, const ColorScale& scale, float opacity) {
  ImageRgba8 image(values.width(), values.height());
  if (!scale.range()) return image;
  const auto alpha = static_cast<std::uint8_t>(std::lround(std::clamp(opacity, 0.0f, 1.0f) * 255));
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!std::isnan(values[i])) image[i] = {scale.color(static_cast<double>(values[i])), alpha};
  }
  return image;
}

Rgba8 over(const Rgba8& below, const Rgba8& above) {
  const int shareAbove = 255 * above.a, shareBelow = below.a * (255 - above.a), sum = shareAbove + shareBelow;
  Rgba8 mixed(0);
  if (sum == 0) return mixed;
  for (int c = 0; c < 3; ++c) {
    mixed[c] = static_cast<std::uint8_t>((above[c] * shareAbove + below[c] * shareBelow + sum / 2) / sum);
  }
  mixed.a = static_cast<std::uint8_t>((sum + 127) / 255);
  return mixed;
}

std::string shortNumber(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

Legend makeLegend(const ColorScale& scale, std::string_view title, std::string_view unit, bool integral) {
  Legend legend{std::string(title), std::string(unit), scale.range(), {}};
  if (!legend.range) return legend;
  std::vector<double> values{legend.range->minimum};
  if (legend.range->minimum < legend.range->maximum) {
    values = scale.kind() == ScaleKind::kLog ? logTicks(*legend.range, integral) : linearTicks(*legend.range, integral);
    // A narrow range of whole numbers may hold none.
    if (values.empty()) values = {legend.range->minimum, legend.range->maximum};
  }
  for (const double value : values) legend.ticks.push_back({value, scale.position(value), shortNumber(value)});
  return legend;
}

}  // namespace cellcut
