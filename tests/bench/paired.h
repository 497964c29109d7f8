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

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
