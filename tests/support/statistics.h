/// \file statistics.h
/// Tails of distributions and the tests made of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cellcut::test {

/// Error rate of one test program's family of comparisons: an honest build fails one seed in a hundred, and the seeds
/// are fixed.
inline constexpr double kAlpha = 0.01;

/// P(|Z| > z) of a standard normal.
double normalTwoSidedTail(double z);
/// The z with P(|Z| > z) = alpha.
double normalCritical(double alpha);
/// Level of each of m comparisons so that all of them together keep `alpha`; where isSixteenth(), together with those
/// of all other tests. Source: Šidák 1967.
double sidak(double alpha, std::size_t comparisons);
/// |z| beyond which one of m comparisons is refuted at kAlpha over all: 2.58 for 1, 3.40 for 15, 3.78 for 64.
double criticalZ(std::size_t comparisons);
/// P(X > x) of a χ² distribution. Source: regularised incomplete gamma function by series and continued fraction.
double chiSquareTail(double x, double degreesOfFreedom);

/// Pearson's test of counts against expected counts.
struct ChiSquare {
  double statistic = 0;
  double degreesOfFreedom = 0;
  double p = 1;
  std::uint64_t impossible = 0;  ///< counted where nothing is expected
};
/// Bins that expect fewer than five are pooled into one; expectations are scaled to the number of counts.
ChiSquare chiSquareTest(std::span<const std::uint64_t> counts, std::span<const double> expected);

/// Mean and variance of a stream in double. Source: Welford 1962.
class Moments {
 public:
  void add(double x) {
    ++n_;
    const double before = x - mean_;
    mean_ += before / static_cast<double>(n_);
    squares_ += before * (x - mean_);
    if (x != 0) ++nonZero_;
  }
  std::uint64_t count() const { return n_; }
  std::uint64_t nonZero() const { return nonZero_; }
  double mean() const { return mean_; }
  /// Of the samples; 0 with fewer than two.
  double variance() const { return n_ > 1 ? squares_ / static_cast<double>(n_ - 1) : 0; }
  /// Of the mean, squared.
  double meanVariance() const { return n_ > 0 ? variance() / static_cast<double>(n_) : 0; }

 private:
  std::uint64_t n_ = 0;
  std::uint64_t nonZero_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

/// Distance of two estimates in standard errors; 0 when they are equal, infinite when they differ and neither varies.
double zScore(double a, double varianceOfA, double b, double varianceOfB);

}  // namespace cellcut::test
