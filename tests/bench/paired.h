/// \file paired.h
/// Times alternatives against each other in one run, in turns, so that a drifting machine favours none.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

namespace cellcut {

/// Seconds of one call.
inline double secondsOf(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One of the values, which a share of them is not above.
inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

inline double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

/// Seconds of two alternatives and the ratio a / b, each the median over rounds; the ratio is taken within a round.
struct PairedTimes {
  double a;
  double b;
  double ratio;
};

/// One round first that does not count.
inline PairedTimes timePaired(int rounds, const std::function<void()>& a, const std::function<void()>& b) {
  std::vector<double> as, bs, ratios;
  for (int round = 0; round <= rounds; ++round) {
    const bool aFirst = round % 2 == 0;
    double secondsA = aFirst ? secondsOf(a) : 0;
    const double secondsB = secondsOf(b);
    if (!aFirst) secondsA = secondsOf(a);
    if (round == 0) continue;
    as.push_back(secondsA);
    bs.push_back(secondsB);
    ratios.push_back(secondsA / secondsB);
  }
  return {median(as), median(bs), median(ratios)};
}

}  // namespace cellcut
