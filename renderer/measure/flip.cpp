#include "renderer/measure/flip.h"

#include "renderer/measure/convolution.h"
#include "renderer/measure/flip_color.h"

#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cellcut {

namespace {

using namespace flip;

// Andersson et al. 2020, section 4: q_c, p_c, p_t, the width w of the feature detectors in degrees, and q_f.
constexpr float kColorExponent = 0.7f;
constexpr float kColorKnee = 0.4f;
constexpr float kColorKneeValue = 0.95f;
constexpr double kFeatureWidth = 0.082;
constexpr float kFeatureExponent = 0.5f;

template <class Function>
void forEachPixel(std::size_t count, const Function& function) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 12), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
  });
}

double sum(const std::vector<float>& values) {
  double total = 0;
  for (const float v : values) total += v;
  return total;
}

/// One Gaussian of a contrast sensitivity function in space, amplitude · √(π/b) · exp(−π² d²/b), d in degrees.
/// Source: Andersson et al. 2020, equation 6 and table 1 (after Johnson and Fairchild 2003).
struct CsfTerm {
  double amplitude;
  double b;
};
constexpr CsfTerm kLuma{1, 0.0047};
constexpr CsfTerm kRedGreen{1, 0.0053};
constexpr std::array<CsfTerm, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

Kernel sampleGaussian(const CsfTerm& term, double pixelsPerDegree) {
  // Three standard deviations √(b/2π²) of the widest term, the same for all as in the paper.
  const double widest = std::sqrt(kBlueYellow[0].b / 2) / std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3 * widest * pixelsPerDegree));
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) {
    const double degrees = x / pixelsPerDegree;
    kernel.weights.push_back(
        static_cast<float>(std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / term.b)));
  }
  return kernel;
}

void scale(Kernel& kernel, double factor) {
  for (float& w : kernel.weights) w = static_cast<float>(w * factor);
}

Plane blur(const Plane& plane, const CsfTerm& term, double pixelsPerDegree) {
  Kernel kernel = sampleGaussian(term, pixelsPerDegree);
  scale(kernel, 1 / sum(kernel.weights));
  return convolve(plane, kernel, kernel);
}

/// The sum of two Gaussians in the plane is not separable; each of them is.
Plane blurBlueYellow(const Plane& plane, double pixelsPerDegree) {
  std::array<double, 2> weights;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = sum(sampleGaussian(kBlueYellow[i], pixelsPerDegree).weights);
    weights[i] = kBlueYellow[i].amplitude * std::sqrt(std::numbers::pi / kBlueYellow[i].b) * side * side;
  }
  const auto share = static_cast<float>(weights[0] / (weights[0] + weights[1]));
  Plane first = blur(plane, kBlueYellow[0], pixelsPerDegree);
  const Plane second = blur(plane, kBlueYellow[1], pixelsPerDegree);
  forEachPixel(first.size(), [&](std::size_t i) { first[i] = share * first[i] + (1 - share) * second[i]; });
  return first;
}

/// A picture's three opponent channels.
struct Opponent {
  Plane luma, redGreen, blueYellow;
};

Opponent toOpponent(const ImageRgb& image) {
  const Plane plane(image.width(), image.height());
  Opponent opponent{plane, plane, plane};
  forEachPixel(image.size(), [&](std::size_t i) {
    const Vec3 c = opponentFromRgb(glm::clamp(image[i], 0.0f, 1.0f));
    opponent.luma[i] = c.x;
    opponent.redGreen[i] = c.y;
    opponent.blueYellow[i] = c.z;
  });
  return opponent;
}

/// Colours as the eye blurs them, in Hunt-adjusted L*a*b*.
Image<Vec3> perceivedColors(const Opponent& opponent, double pixelsPerDegree) {
  const Plane luma = blur(opponent.luma, kLuma, pixelsPerDegree);
  const Plane redGreen = blur(opponent.redGreen, kRedGreen, pixelsPerDegree);
  const Plane blueYellow = blurBlueYellow(opponent.blueYellow, pixelsPerDegree);
  Image<Vec3> colors(luma.width(), luma.height());
  forEachPixel(colors.size(), [&](std::size_t i) {
    const Vec3 rgb = rgbFromOpponent({luma[i], redGreen[i], blueYellow[i]});
    colors[i] = huntLabFromRgb(glm::clamp(rgb, 0.0f, 1.0f));
  });
  return colors;
}

/// Strength of edges and of points and lines at every pixel.
struct Features {
  Plane edges, points;
};

/// A Gaussian and its derivatives, whose positive and negative weights each sum to 1 in magnitude.
struct FeatureKernels {
  Kernel gaussian, first, second;
};

void balance(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const float w : kernel.weights) (w > 0 ? positive : negative) += std::abs(w);
  for (float& w : kernel.weights) w = static_cast<float>(w / (w > 0 ? positive : negative));
}

FeatureKernels featureKernels(double pixelsPerDegree) {
  const double deviation = 0.5 * kFeatureWidth * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  FeatureKernels kernels;
  for (int x = -radius; x <= radius; ++x) {
    const double t = x / deviation;
    const double g = std::exp(-0.5 * t * t);
    kernels.gaussian.weights.push_back(static_cast<float>(g));
    kernels.first.weights.push_back(static_cast<float>(-x * g));
    kernels.second.weights.push_back(static_cast<float>((t * t - 1) * g));
  }
  scale(kernels.gaussian, 1 / sum(kernels.gaussian.weights));
  balance(kernels.first);
  balance(kernels.second);
  return kernels;
}

Plane magnitude(const Plane& x, const Plane& y) {
  Plane result(x.width(), x.height());
  forEachPixel(result.size(), [&](std::size_t i) { result[i] = std::hypot(x[i], y[i]); });
  return result;
}

Features detectFeatures(const Plane& luma, double pixelsPerDegree) {
  const FeatureKernels k = featureKernels(pixelsPerDegree);
  Plane unit(luma.width(), luma.height());
  forEachPixel(unit.size(), [&](std::size_t i) { unit[i] = (luma[i] + 16) / 116; });
  return {magnitude(convolve(unit, k.first, k.gaussian), convolve(unit, k.gaussian, k.first)),
          magnitude(convolve(unit, k.second, k.gaussian), convolve(unit, k.gaussian, k.second))};
}

/// Distance of colours → [0, 1]: up to the knee, 40 % of the largest distance, it takes 95 % of the range.
float compressColorDistance(float distance, float largest) {
  const float powered = std::pow(distance, kColorExponent);
  const float knee = kColorKnee * largest;
  if (powered < knee) return powered * kColorKneeValue / knee;
  return kColorKneeValue + (powered - knee) / (largest - knee) * (1 - kColorKneeValue);
}

/// What the two halves of the metric see in one picture.
struct Percept {
  Image<Vec3> colors;
  Features features;
};

Percept perceive(const ImageRgb& image, double pixelsPerDegree) {
  const Opponent opponent = toOpponent(image);
  return {perceivedColors(opponent, pixelsPerDegree), detectFeatures(opponent.luma, pixelsPerDegree)};
}

/// Narkowicz' fit of the ACES curve without its pre-exposure of 0.6, the default of the HDR paper: (a x² + b x) / (c x²
/// + d x + e).
struct AcesFit {
  static constexpr double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;

  static float apply(double x) {
    constexpr double kWhite = 1e4;                     // shown as 1 long before; keeps the squares finite
    const double t = x > 0 ? std::min(x, kWhite) : 0;  // NaN compares false
    return std::min(static_cast<float>((a * t + b) * t / ((c * t + d) * t + e)), 1.0f);
  }
  /// The x that is shown as y < a/c.
  static double invert(double y) {
    const double p = (b - y * d) / (a - y * c);
    const double q = -y * e / (a - y * c);
    return -p / 2 + std::sqrt(p * p / 4 - q);
  }
};

ImageRgb expose(const ImageRgb& image, double log2Exposure) {
  const double factor = std::exp2(log2Exposure);
  ImageRgb shown(image.width(), image.height());
  forEachPixel(image.size(), [&](std::size_t i) {
    for (int c = 0; c < 3; ++c) shown[i][c] = AcesFit::apply(factor * image[i][c]);
  });
  return shown;
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Image<float> flipLdr(const ImageRgb& test, const ImageRgb& reference, double pixelsPerDegree) {
  assert(test.width() == reference.width() && test.height() == reference.height() && !test.empty());
  const Percept a = perceive(test, pixelsPerDegree);
  const Percept b = perceive(reference, pixelsPerDegree);
  // Green and blue are the farthest apart of all displayable colours.
  const float largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
  Image<float> error(test.width(), test.height());
  forEachPixel(error.size(), [&](std::size_t i) {
    const float color = compressColorDistance(hyab(a.colors[i], b.colors[i]), largest);
    const float edge = std::abs(a.features.edges[i] - b.features.edges[i]);
    const float point = std::abs(a.features.points[i] - b.features.points[i]);
    const float feature = std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, kFeatureExponent);
    error[i] = std::clamp(std::pow(color, 1 - feature), 0.0f, 1.0f);
  });
  return error;
}

FlipExposures flipExposures(const ImageRgb& reference) {
  constexpr double kShownAt = 0.85;  // Andersson et al. 2021, section 3
  std::vector<double> luminances;
  for (const Vec3& pixel : reference) {
    const double y = luminance(glm::dvec3(pixel));
    luminances.push_back(y > 0 && std::isfinite(y) ? y : 0);
  }
  double median = medianOf(luminances);
  if (median == 0) {
    std::erase(luminances, 0.0);
    if (luminances.empty()) return {};
    median = medianOf(luminances);
  }
  const double brightest = *std::max_element(luminances.begin(), luminances.end());
  const double shown = AcesFit::invert(kShownAt);
  FlipExposures exposures{std::log2(shown / brightest), std::log2(shown / median)};
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

Image<float> flipHdr(const ImageRgb& test, const ImageRgb& reference, double pixelsPerDegree) {
  const FlipExposures exposures = flipExposures(reference);
  Image<float> largest(test.width(), test.height());
  for (int i = 0; i < exposures.count; ++i) {
    const double exposure = exposures.at(i);
    const Image<float> error = flipLdr(expose(test, exposure), expose(reference, exposure), pixelsPerDegree);
    forEachPixel(largest.size(), [&](std::size_t p) { largest[p] = std::max(largest[p], error[p]); });
  }
  return largest;
}

}  // namespace cellcut
