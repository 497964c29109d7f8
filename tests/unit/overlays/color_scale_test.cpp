#include "ui/overlays/color_scale.h"

#include "tests/support/vectors.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::ElementsAre;

Image<float> row(std::initializer_list<float> values) {
  Image<float> image(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), image.begin());
  return image;
}

/// The legend of a pinned range.
Legend legendOf(double minimum, double maximum, ScaleKind kind = ScaleKind::kLinear, bool integral = false) {
  return makeLegend(ColorScale({}, {.pinned = ValueRange{minimum, maximum}, .kind = kind}), "title", "unit", integral);
}
std::vector<std::string> labelsOf(const Legend& legend) {
  std::vector<std::string> labels;
  for (const LegendTick& tick : legend.ticks) labels.push_back(tick.label);
  return labels;
}

// As published: the first, the middle and the last entry.
TEST(Colormap, HasThePublishedColours) {
  EXPECT_EQ(colorOf(Colormap::kViridis, 0), Rgb8(68, 1, 84));
  EXPECT_EQ(colorOf(Colormap::kViridis, 0.5), Rgb8(33, 145, 140));
  EXPECT_EQ(colorOf(Colormap::kViridis, 1), Rgb8(253, 231, 37));
  EXPECT_EQ(colorOf(Colormap::kTurbo, 0), Rgb8(48, 18, 59));
  EXPECT_EQ(colorOf(Colormap::kTurbo, 0.5), Rgb8(164, 252, 60));
  EXPECT_EQ(colorOf(Colormap::kTurbo, 1), Rgb8(122, 4, 3));
  EXPECT_EQ(colorOf(Colormap::kMagma, 0), Rgb8(0, 0, 4));
  EXPECT_EQ(colorOf(Colormap::kMagma, 0.5), Rgb8(183, 55, 121));
  EXPECT_EQ(colorOf(Colormap::kMagma, 1), Rgb8(252, 253, 191));
}

TEST(Colormap, ClampsAndHas256Steps) {
  EXPECT_EQ(colorOf(Colormap::kTurbo, -3), colorOf(Colormap::kTurbo, 0));
  EXPECT_EQ(colorOf(Colormap::kTurbo, HUGE_VAL), colorOf(Colormap::kTurbo, 1));
  for (int i = 0; i < 256; ++i) {
    const Rgb8 color = colorOf(Colormap::kViridis, (i + 0.5) / 256);
    const std::uint32_t entry = kViridisTable[static_cast<std::size_t>(i)];
    EXPECT_EQ(static_cast<std::uint32_t>(color.r << 16 | color.g << 8 | color.b), entry);
  }
}

TEST(Colormap, ViridisAndMagmaGetBrighterAllTheWay) {
  for (const Colormap colormap : {Colormap::kViridis, Colormap::kMagma}) {
    double before = -1;
    for (int i = 0; i < 256; ++i) {
      const Rgb8 c = colorOf(colormap, i / 255.0);
      const double brightness = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
      EXPECT_GE(brightness, before - 0.5) << nameOf(colormap) << i;  // rounding to 8 bits
      before = brightness;
    }
  }
}

TEST(Colormap, HasItsName) {
  for (const ColormapName& c : kColormaps) EXPECT_EQ(nameOf(c.colormap), c.name);
}

TEST(ColorScale, RangeIsThatOfTheFiniteValues) {
  const Image<float> values = row({3, kNan, -1, kInfinity, 7, 0});
  EXPECT_EQ(ColorScale(values, {}).range(), (ValueRange{-1, 7}));
  EXPECT_EQ(ColorScale(values, {.kind = ScaleKind::kLog}).range(), (ValueRange{3, 7}));
  EXPECT_EQ(ColorScale(row({0, 1e-28f, 8}), {.kind = ScaleKind::kLog}).range(), (ValueRange{8e-8, 8}));
}

TEST(ColorScale, ValuesLieWhereTheirColourIs) {
  const ColorScale linear({}, {.pinned = ValueRange{2, 10}});
  EXPECT_EQ(linear.position(4), 0.25);
  EXPECT_EQ(linear.position(-100), 0);
  EXPECT_EQ(linear.position(HUGE_VAL), 1);
  const ColorScale log({}, {.pinned = ValueRange{0.01, 100}, .kind = ScaleKind::kLog});
  EXPECT_NEAR(log.position(1), 0.5, 1e-12);
  EXPECT_NEAR(log.position(10), 0.75, 1e-12);
  EXPECT_EQ(log.position(0), 0);
  EXPECT_EQ(log.position(-5), 0);
}

TEST(ColorScale, PinnedRangesAreMadeUsable) {
  EXPECT_EQ(ColorScale({}, {.pinned = ValueRange{5, 1}}).range(), (ValueRange{1, 5}));
  EXPECT_EQ(ColorScale({}, {.pinned = ValueRange{0, 2}, .kind = ScaleKind::kLog}).range(), (ValueRange{0.002, 2}));
  EXPECT_EQ(ColorScale(row({4, 8}), {.pinned = ValueRange{-3, 0}, .kind = ScaleKind::kLog}).range(),
            (ValueRange{4, 8}));
}

TEST(Colorize, ColoursEachValueAndLeavesOutNan) {
  const Image<float> values = row({0, 1, kNan, 0.5f, kInfinity});
  const ColorScale scale(values, {.colormap = Colormap::kMagma});
  const ImageRgba8 image = colorize(values, scale, 0.5f);
  EXPECT_EQ(image[0], glm::u8vec4(0, 0, 4, 128));
  EXPECT_EQ(image[1], glm::u8vec4(252, 253, 191, 128));
  EXPECT_EQ(image[2], glm::u8vec4(0));
  EXPECT_EQ(image[3], glm::u8vec4(colorOf(Colormap::kMagma, 0.5), 128));
  EXPECT_EQ(image[4], image[1]);
}

TEST(Colorize, NoValueAnywhereIsTransparentAndItsLegendIsEmpty) {
  const Image<float> values = row({kNan, kNan});
  for (const ScaleKind kind : {ScaleKind::kLinear, ScaleKind::kLog}) {
    const ColorScale scale(values, {.kind = kind});
    EXPECT_FALSE(scale.range());
    for (const auto& pixel : colorize(values, scale, 1)) EXPECT_EQ(pixel, glm::u8vec4(0));
    EXPECT_TRUE(makeLegend(scale, "t", "", false).ticks.empty());
  }
  EXPECT_FALSE(ColorScale(row({0, -1}), {.kind = ScaleKind::kLog}).range());
}

TEST(Colorize, AConstantPictureIsTheMiddleOfTheBar) {
  const Image<float> values = row({7, 7, 7});
  for (const ScaleKind kind : {ScaleKind::kLinear, ScaleKind::kLog}) {
    const ColorScale scale(values, {.kind = kind});
    EXPECT_EQ(colorize(values, scale, 1)[1], glm::u8vec4(colorOf(Colormap::kViridis, 0.5), 255));
    const Legend legend = makeLegend(scale, "t", "", true);
    EXPECT_THAT(labelsOf(legend), ElementsAre("7"));
    EXPECT_EQ(legend.ticks[0].position, 0.5);
  }
}

TEST(Over, MixesByAlpha) {
  const Rgba8 below(100, 200, 0, 255);
  EXPECT_EQ(over(below, Rgba8(200, 0, 255, 128)), Rgba8(150, 100, 128, 255));
  EXPECT_EQ(over(below, Rgba8(200, 0, 255, 0)), below);
  EXPECT_EQ(over(below, Rgba8(200, 0, 255, 255)), Rgba8(200, 0, 255, 255));
}

TEST(Over, KeepsTheColourOverNothingAndAddsCoverage) {
  EXPECT_EQ(over(Rgba8(9, 9, 9, 0), Rgba8(10, 20, 30, 77)), Rgba8(10, 20, 30, 77));
  EXPECT_EQ(over(Rgba8(10, 20, 30, 77), Rgba8(9, 9, 9, 0)), Rgba8(10, 20, 30, 77));
  EXPECT_EQ(over(Rgba8(5, 5, 5, 0), Rgba8(5, 5, 5, 0)), Rgba8(0));
  EXPECT_EQ(over(Rgba8(0, 0, 0, 128), Rgba8(255, 255, 255, 128)).a, 192);  // 1 − (1 − 0.5)², rounded
}

TEST(Legend, LinearTicksAreRoundNumbers) {
  EXPECT_THAT(labelsOf(legendOf(0, 1)), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
  EXPECT_THAT(labelsOf(legendOf(-3, 12)), ElementsAre("0", "5", "10"));
  EXPECT_THAT(labelsOf(legendOf(0, 1234)), ElementsAre("0", "500", "1000"));
  EXPECT_THAT(labelsOf(legendOf(0.1, 0.3)), ElementsAre("0.1", "0.15", "0.2", "0.25", "0.3"));
  EXPECT_THAT(labelsOf(legendOf(0, 3e-7)), ElementsAre("0", "1e-07", "2e-07", "3e-07"));
  EXPECT_THAT(labelsOf(legendOf(2e9, 5e9)), ElementsAre("2e+09", "3e+09", "4e+09", "5e+09"));
}

TEST(Legend, TicksOfCountsAreWholeNumbers) {
  EXPECT_THAT(labelsOf(legendOf(0, 1, ScaleKind::kLinear, true)), ElementsAre("0", "1"));
  EXPECT_THAT(labelsOf(legendOf(3, 6, ScaleKind::kLinear, true)), ElementsAre("3", "4", "5", "6"));
}

TEST(Legend, LogarithmicTicksArePowersOfTen) {
  EXPECT_THAT(labelsOf(legendOf(0.05, 200, ScaleKind::kLog)), ElementsAre("0.1", "1", "10", "100"));
  EXPECT_THAT(labelsOf(legendOf(1, 10, ScaleKind::kLog)), ElementsAre("1", "10"));
  // Within a decade there are too few.
  EXPECT_THAT(labelsOf(legendOf(2, 7, ScaleKind::kLog)), ElementsAre("2", "3", "4", "5", "6", "7"));
  EXPECT_LE(legendOf(1e-30, 1e30, ScaleKind::kLog).ticks.size(), 9u);
}

TEST(Legend, TicksLieOnTheirColoursAndInsideTheBar) {
  for (const ScaleKind kind : {ScaleKind::kLinear, ScaleKind::kLog}) {
    for (const double maximum : {1.3, 17.0, 999.0, 1e6, 123456789.0}) {
      const ColorScale scale({}, {.pinned = ValueRange{1, maximum}, .kind = kind});
      const Legend legend = makeLegend(scale, "t", "", false);
      ASSERT_GE(legend.ticks.size(), 2u) << maximum;
      ASSERT_LE(legend.ticks.size(), 9u) << maximum;
      for (const LegendTick& tick : legend.ticks) {
        EXPECT_EQ(tick.position, scale.position(tick.value));
        EXPECT_NEAR(std::stod(tick.label), tick.value, 1e-5 * tick.value);  // the label's six digits
        EXPECT_GE(tick.value, 1 - 1e-9);
        EXPECT_LE(tick.value, maximum * (1 + 1e-9));
      }
    }
  }
}

}  // namespace
}  // namespace cellcut::test
