#include "renderer/measure/flip.h"

#include "renderer/base/rng.h"

#include <array>
#include <functional>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

constexpr Vec3 kBlack{0, 0, 0}, kWhite{1, 1, 1}, kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};
// Float sums of up to 441 weights leave 1e-3 of an error in L*a*b* and through the slope of the metric, 0.04 per unit,
// 4e-5.
constexpr double kMetricRounding = 1e-4;

double mean(const Image<float>& error) {
  double sum = 0;
  for (const float e : error) sum += e;
  return sum / static_cast<double>(error.size());
}

double flipOfColors(const Vec3& a, const Vec3& b) {
  return mean(flipLdr(ImageRgb(8, 8, a), ImageRgb(8, 8, b)));
}

ImageRgb noise(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  ImageRgb image(width, height);
  for (Vec3& pixel : image) pixel = {rng.uniform(), rng.uniform(), rng.uniform()};
  return image;
}

ImageRgb transposed(const ImageRgb& image) {
  ImageRgb result(image.height(), image.width());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) result.at(y, x) = image.at(x, y);
  }
  return result;
}

ImageRgb mirrored(ImageRgb image) {
  for (int y = 0; y < image.height(); ++y) std::reverse(&image.at(0, y), &image.at(0, y) + image.width());
  return image;
}

/// The paper's equations once more, in double and with plain two-dimensional filters.
class BruteForce {
 public:
  BruteForce(const ImageRgb& test, const ImageRgb& reference, double pixelsPerDegree)
      : test_(test), reference_(reference), ppd_(pixelsPerDegree) {}

  double at(int x, int y) const {
    const double largest = std::pow(203.30165461087745, 0.7);  // HyAB of green and blue, computed by hand
    const double distance = std::pow(hyab(color(test_, x, y), color(reference_, x, y)), 0.7);
    const double knee = 0.4 * largest;
    const double ramp = distance < knee ? distance * 0.95 / knee : 0.95 + (distance - knee) / (largest - knee) * 0.05;
    const double edge = std::abs(feature(test_, x, y, false) - feature(reference_, x, y, false));
    const double point = std::abs(feature(test_, x, y, true) - feature(reference_, x, y, true));
    return std::pow(ramp, 1 - std::sqrt(std::max(edge, point) / std::sqrt(2)));
  }

 private:
  using Weight = std::function<double(int, int)>;
  using Value = std::function<double(const Vec3&)>;

  static glm::dvec3 xyz(const glm::dvec3& c) {
    return {(10135552 * c.x + 8788810 * c.y + 4435075 * c.z) / 23359437,
            (2613072 * c.x + 8788810 * c.y + 887015 * c.z) / 12288897,
            (1425312 * c.x + 8788810 * c.y + 70074185 * c.z) / 80288307};
  }
  static glm::dvec3 opponent(const Vec3& c) {
    const glm::dvec3 t = xyz(c);
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
  }
  static double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
  }

  static double filter(const ImageRgb& image, int x, int y, int radius, const Weight& weight, const Value& value) {
    double sum = 0;
    for (int j = -radius; j <= radius; ++j) {
      for (int i = -radius; i <= radius; ++i) {
        const int u = std::clamp(x + i, 0, image.width() - 1), v = std::clamp(y + j, 0, image.height() - 1);
        sum += weight(i, j) * value(image.at(u, v));
      }
    }
    return sum;
  }

  double blurred(const ImageRgb& image, int x, int y, int channel, std::array<double, 4> csf) const {
    constexpr double pi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd_));
    const Weight weight = [&](int i, int j) {
      const double d2 = (i * i + j * j) / (ppd_ * ppd_);
      return csf[0] * std::sqrt(pi / csf[1]) * std::exp(-pi * pi * d2 / csf[1]) +
             csf[2] * std::sqrt(pi / csf[3]) * std::exp(-pi * pi * d2 / csf[3]);
    };
    const double sum = filter(image, x, y, radius, weight, [](const Vec3&) { return 1.0; });
    return filter(image, x, y, radius, weight, [&](const Vec3& c) { return opponent(c)[channel]; }) / sum;
  }

  glm::dvec3 color(const ImageRgb& image, int x, int y) const {
    const double luma = blurred(image, x, y, 0, {1, 0.0047, 0, 1e-5});
    const double redGreen = blurred(image, x, y, 1, {1, 0.0053, 0, 1e-5});
    const double blueYellow = blurred(image, x, y, 2, {34.1, 0.04, 13.5, 0.025});
    const double ty = (luma + 16) / 116;
    const glm::dmat3 xyzFromRgb(xyz({1, 0, 0}), xyz({0, 1, 0}), xyz({0, 0, 1}));
    const glm::dvec3 rgb = glm::inverse(xyzFromRgb) * glm::dvec3(ty + redGreen / 500, ty, ty - blueYellow / 200);
    const glm::dvec3 t = xyz(glm::clamp(rgb, 0.0, 1.0));
    const auto f = [](double v) { return v > std::pow(6.0 / 29, 3) ? std::cbrt(v) : v * 841 / 108 + 4.0 / 29; };
    const double lightness = 116 * f(t.y) - 16;
    return {lightness, 0.01 * lightness * 500 * (f(t.x) - f(t.y)), 0.01 * lightness * 200 * (f(t.y) - f(t.z))};
  }

  double feature(const ImageRgb& image, int x, int y, bool point) const {
    const double sd = 0.5 * 0.082 * ppd_;
    const int radius = static_cast<int>(std::ceil(3 * sd));
    const auto along = [&](int i, int j) {
      const double g = std::exp(-(i * i + j * j) / (2 * sd * sd));
      return point ? (i * i / (sd * sd) - 1) * g : -i * g;
    };
    const auto one = [](const Vec3&) { return 1.0; };
    const double positive = filter(
        image, x, y, radius, [&](int i, int j) { return std::max(along(i, j), 0.0); }, one);
    const double negative = filter(
        image, x, y, radius, [&](int i, int j) { return std::max(-along(i, j), 0.0); }, one);
    const auto balanced = [&](int i, int j) { return along(i, j) / (along(i, j) > 0 ? positive : negative); };
    const Value value = [](const Vec3& c) { return xyz(c).y; };
    const double h = filter(image, x, y, radius, balanced, value);
    const double v = filter(
        image, x, y, radius, [&](int i, int j) { return balanced(j, i); }, value);
    return std::sqrt(h * h + v * v);
  }

  const ImageRgb& test_;
  const ImageRgb& reference_;
  double ppd_;
};

TEST(Flip, IsZeroForTheSamePicture) {
  const ImageRgb image = noise(20, 10, 1);
  for (const float e : flipLdr(image, image)) EXPECT_EQ(e, 0.0f);
  for (const float e : flipHdr(image, image)) EXPECT_EQ(e, 0.0f);
}

TEST(Flip, PlainColorsDifferByTheirCompressedDistance) {
  // Computed by hand from the paper's equations; without edges only the distance of the two colours is left.
  EXPECT_NEAR(flipOfColors(kBlack, kWhite), 0.9673797614921327, kMetricRounding);
  EXPECT_NEAR(flipOfColors(kRed, kBlue), 0.9650790225050357, kMetricRounding);
  EXPECT_NEAR(flipOfColors(kRed, kGreen), 0.9866622751952874, kMetricRounding);
  EXPECT_NEAR(flipOfColors(kGreen, kBlue), 1, kMetricRounding);
  EXPECT_NEAR(flipOfColors(Vec3(0.5f), Vec3(0.52f)), 0.06581283282068773, kMetricRounding);
  EXPECT_NEAR(flipOfColors(Vec3(0.18f), {0.2f, 0.18f, 0.16f}), 0.11041534912073062, kMetricRounding);
}

TEST(Flip, FollowsThePapersEquationsPixelByPixel) {
  const double ppd = 20;  // radii of 3, so that brute force is quick and the borders are a part of it
  const ImageRgb test = noise(12, 9, 2), reference = noise(12, 9, 3);
  const Image<float> error = flipLdr(test, reference, ppd);
  const BruteForce expected(test, reference, ppd);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 12; ++x)
      EXPECT_NEAR(error.at(x, y), expected.at(x, y), 1e-4) << x << " " << y;  // √ of features
  }
}

TEST(Flip, HasThePapersFiltersAtTheDefaultDistance) {
  // One bright pixel shows every weight of every filter at once.
  const ImageRgb reference(31, 25, Vec3(0.2f));
  ImageRgb test = reference;
  test.at(15, 12) = {1, 0.5f, 0};
  const Image<float> error = flipLdr(test, reference);
  const BruteForce expected(test, reference, kPixelsPerDegree);
  for (const glm::ivec2 p : {glm::ivec2(15, 12), {16, 12}, {15, 9}, {20, 17}, {24, 12}, {8, 3}, {0, 0}}) {
    // Far out both pictures agree to rounding, of which the powers 0.7 and 1/2 make 1e-3.
    EXPECT_NEAR(error.at(p.x, p.y), expected.at(p.x, p.y), 1e-3) << p.x << " " << p.y;
  }
}

TEST(Flip, IsSymmetricOnADisplay) {
  const ImageRgb a = noise(30, 20, 4), b = noise(30, 20, 5);
  const Image<float> ab = flipLdr(a, b), ba = flipLdr(b, a);
  for (std::size_t i = 0; i < ab.size(); ++i) EXPECT_EQ(ab[i], ba[i]);
}

TEST(Flip, StaysBetweenZeroAndOne) {
  const ImageRgb stripes = [] {
    ImageRgb image(32, 32);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) image.at(x, y) = x / 4 % 2 ? kGreen : kBlue;
    }
    return image;
  }();
  for (const Image<float>& error : {flipLdr(stripes, mirrored(stripes)), flipHdr(noise(32, 32, 6), noise(32, 32, 7)),
                                    flipLdr(stripes, ImageRgb(32, 32, kBlack))}) {
    for (const float e : error) {
      EXPECT_GE(e, 0.0f);
      EXPECT_LE(e, 1.0f);
    }
  }
}

TEST(Flip, DoesNotDependOnOrientation) {
  const ImageRgb a = noise(30, 20, 8), b = noise(30, 20, 9);
  const double upright = mean(flipHdr(a, b));
  EXPECT_NEAR(mean(flipHdr(transposed(a), transposed(b))), upright, kMetricRounding);
  EXPECT_NEAR(mean(flipHdr(mirrored(a), mirrored(b))), upright, kMetricRounding);
}

TEST(Flip, SeesLessFromFartherAway) {
  const ImageRgb a = noise(64, 64, 10), b = noise(64, 64, 11);
  EXPECT_LT(mean(flipLdr(a, b, 4 * kPixelsPerDegree)), mean(flipLdr(a, b)));
}

TEST(FlipHdr, PlainReferenceIsShownAtEightyFivePercent) {
  // Exposure log2(2.1188723) for a luminance of 1, where the ACES fit is 0.85; computed by hand, as the error.
  const ImageRgb reference(8, 8, kWhite);
  const FlipExposures exposures = flipExposures(reference);
  EXPECT_NEAR(exposures.start, std::log2(2.1188723239873157), 1e-7);  // luminance's weights sum to 1 in double
  EXPECT_NEAR(exposures.stop, exposures.start, 1e-12);
  EXPECT_NEAR(mean(flipHdr(ImageRgb(8, 8, Vec3(1.5f)), reference)), 0.10912632725795715, kMetricRounding);
}

TEST(FlipHdr, ExposuresReachFromTheBrightestToTheMedian) {
  ImageRgb reference(5, 5, Vec3(0.25f));
  reference.at(2, 2) = Vec3(64.0f);
  const FlipExposures exposures = flipExposures(reference);
  EXPECT_NEAR(exposures.stop - exposures.start, 8, 1e-6);
  EXPECT_NEAR(exposures.at(0), exposures.start, 1e-12);
  EXPECT_NEAR(exposures.at(exposures.count - 1), exposures.stop, 1e-12);
}

TEST(FlipHdr, DoesNotDependOnTheUnitOfRadiance) {
  const ImageRgb a = noise(16, 16, 12), b = noise(16, 16, 13);
  const double expected = mean(flipHdr(a, b));
  for (const float scale : {1e-20f, 1e20f}) {
    ImageRgb scaledA = a, scaledB = b;
    for (Vec3& p : scaledA) p *= scale;
    for (Vec3& p : scaledB) p *= scale;
    EXPECT_NEAR(mean(flipHdr(scaledA, scaledB)), expected, 1e-4) << scale;  // one rounding of every texel
  }
}

TEST(FlipHdr, MostlyBlackReferenceIsExposedForWhatIsLit) {
  ImageRgb reference(9, 9);
  reference.at(4, 4) = kWhite;
  const FlipExposures exposures = flipExposures(reference);
  EXPECT_NEAR(exposures.start, exposures.stop, 1e-12);
  EXPECT_GT(mean(flipHdr(ImageRgb(9, 9), reference)), 0);
}

TEST(FlipHdr, HasAnAnswerForBlackAndForBadNumbers) {
  const ImageRgb black(4, 4);
  EXPECT_EQ(mean(flipHdr(black, black)), 0);
  EXPECT_GT(mean(flipHdr(ImageRgb(4, 4, kWhite), black)), 0.9);
  ImageRgb bad(4, 4, Vec3(std::numeric_limits<float>::quiet_NaN(), -1, kInfinity));
  bad[0] = Vec3(std::numeric_limits<float>::max());
  bad[1] = Vec3(std::numeric_limits<float>::denorm_min());
  for (const float e : flipHdr(bad, ImageRgb(4, 4, kWhite))) EXPECT_TRUE(e >= 0 && e <= 1);
  for (const float e : flipHdr(ImageRgb(4, 4, kWhite), bad)) EXPECT_TRUE(e >= 0 && e <= 1);
}

TEST(Flip, WorksOnASinglePixel) {
  EXPECT_NEAR(mean(flipLdr(ImageRgb(1, 1, kBlack), ImageRgb(1, 1, kWhite))), 0.96738, kMetricRounding);
}

}  // namespace
}  // namespace cellcut
