#include "app/progress.h"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

using ::testing::HasSubstr;

ProgressState at(double seconds, double share = 0.25) {
  return {.doneShare = share, .passes = 16, .seconds = seconds, .raysPerSecond = 4.2e6};
}

std::ptrdiff_t countOf(const std::string& text, char c) {
  return std::count(text.begin(), text.end(), c);
}

TEST(Progress, DurationsChangeTheirUnitAsTheyGrow) {
  EXPECT_EQ(formatDuration(3.21), "3.2 s");
  EXPECT_EQ(formatDuration(59.96), "1 min 00 s");
  EXPECT_EQ(formatDuration(245), "4 min 05 s");
  EXPECT_EQ(formatDuration(2 * 3600 + 10 * 60), "2 h 10 min");
}

TEST(Progress, LineHasSamplesElapsedRemainingAndSpeed) {
  EXPECT_EQ(formatProgress(at(3)), "16 spp, 3.0 s, about 9.0 s left, 4.20 Mray/s");
}

TEST(Progress, RemainingTimeIsUnknownBeforeAnythingIsDone) {
  EXPECT_FALSE(remainingSeconds(at(3, 0)).has_value());
  EXPECT_EQ(formatProgress(at(3, 0)), "16 spp, 3.0 s, 4.20 Mray/s");
}

TEST(Progress, TerminalLineIsRedrawnAtMostTenTimesASecond) {
  std::ostringstream stream;
  Progress progress(stream, true);
  for (int i = 0; i <= 1000; ++i) progress.update(at(i * 1e-3));
  EXPECT_GE(countOf(stream.str(), '\r'), 9);  // some of the ten may fall just behind a step of the loop
  EXPECT_LE(countOf(stream.str(), '\r'), 10);
  EXPECT_EQ(countOf(stream.str(), '\n'), 0);
  EXPECT_THAT(stream.str(), HasSubstr("[######..................] 16 spp"));
}

TEST(Progress, LogGetsPlainLinesAtMostEveryTwoSeconds) {
  std::ostringstream stream;
  Progress progress(stream, false);
  for (int i = 0; i <= 100; ++i) progress.update(at(i * 0.1));
  EXPECT_GE(countOf(stream.str(), '\n'), 4);
  EXPECT_LE(countOf(stream.str(), '\n'), 5);
  EXPECT_EQ(countOf(stream.str(), '\r'), 0);
  EXPECT_EQ(countOf(stream.str(), '\x1b'), 0);
}

TEST(Progress, LastStateIsAlwaysShown) {
  for (const bool terminal : {false, true}) {
    std::ostringstream stream;
    Progress progress(stream, terminal);
    progress.finish(at(0.01, 1));
    EXPECT_THAT(stream.str(), HasSubstr("16 spp, 0.0 s, 4.20 Mray/s"));
    EXPECT_EQ(stream.str().back(), '\n');
  }
}

}  // namespace
}  // namespace cellcut
