#include "tests/support/hostile_budget.h"

#include "tests/support/depth.h"

#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

constexpr std::size_t kMostBytes = std::size_t{512} << 20;
constexpr unsigned kHangSeconds = 60;
const unsigned kSlowness = isSanitized() ? 10 : 1;

/// Of a line like "VmHWM:  349456 kB"; 0 without it.
std::size_t statusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kilobytes = 0;
    if (word == key && status >> kilobytes) return kilobytes << 10;
  }
  return 0;
}

/// From now on the largest resident memory is counted anew. Source: proc(5), "clear_refs".
void forgetPeak() {
  std::ofstream("/proc/self/clear_refs") << '5';
}

}  // namespace

HostileBudget::HostileBudget(std::string what, double mostSeconds)
    : what_(std::move(what)), mostSeconds_(kSlowness * mostSeconds), start_(std::clock()) {
  forgetPeak();
  before_ = statusBytes("VmHWM:");
  alarm(kSlowness * kHangSeconds);
}

HostileBudget::~HostileBudget() {
  alarm(0);
  EXPECT_LT(seconds(), mostSeconds_) << what_;
  if (!isSanitized()) {
    EXPECT_LT(bytes(), kMostBytes) << what_;
  }
}

double HostileBudget::seconds() const {
  return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
}

std::size_t HostileBudget::bytes() const {
  const std::size_t peak = statusBytes("VmHWM:");
  return peak > before_ ? peak - before_ : 0;
}

}  // namespace cellcut::test
