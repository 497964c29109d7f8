#include "app/numbers.h"

#include "renderer/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut {
namespace {

constexpr RealRange kPositive{.least = 0, .leastExcluded = true};

TEST(Numbers, WholeNumbersReachBothEndsOfTheirRange) {
  EXPECT_EQ(parseWhole("--spp", "1", {.least = 1, .most = 9}), 1u);
  EXPECT_EQ(parseWhole("--spp", "9", {.least = 1, .most = 9}), 9u);
  EXPECT_EQ(parseWhole("--seed", "18446744073709551615", {}), 18446744073709551615u);
}

TEST(Numbers, WholeNumbersAreDecimal) {
  EXPECT_EQ(parseWhole("--spp", "010", {}), 10u);
}

TEST(Numbers, WholeNumbersOutsideTheirRangeAreRefused) {
  EXPECT_THROW(parseWhole("--spp", "0", {.least = 1, .most = 9}), InputError);
  EXPECT_THROW(parseWhole("--spp", "10", {.least = 1, .most = 9}), InputError);
  EXPECT_THROW(parseWhole("--seed", "18446744073709551616", {}), InputError);
}

TEST(Numbers, TextThatIsNotAWholeNumberIsRefused) {
  for (const char* text : {"", " ", "1 ", " 1", "+1", "-1", "1.0", "1e3", "0x10", "12k", "1'000", "1_000", "nan"}) {
    EXPECT_THROW(parseWhole("--spp", text, {}), InputError) << "'" << text << "'";
  }
}

TEST(Numbers, RefusalNamesOptionTextAndRange) {
  try {
    parseWhole("--spp", "12k", {.least = 1, .most = 9});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--spp: '12k' is not a whole number from 1 to 9");
  }
  try {
    parseReal("--time", "0", kPositive);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--time: '0' is not a number above 0");
  }
  try {
    parseReal("--threshold", "2", {.least = 0, .most = 1});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--threshold: '2' is not a number of at least 0 and at most 1");
  }
}

TEST(Numbers, RealNumbersMayBeScientific) {
  EXPECT_EQ(parseReal("--time", "2.5e-3", kPositive), 2.5e-3);
  EXPECT_EQ(parseReal("--environment-rotation", "-30", {}), -30);
}

TEST(Numbers, LeastRealNumberIsInsideUnlessItIsExcluded) {
  EXPECT_EQ(parseReal("--environment-scale", "0", {.least = 0}), 0);
  EXPECT_THROW(parseReal("--time", "0", kPositive), InputError);
  EXPECT_THROW(parseReal("--environment-scale", "-1", {.least = 0}), InputError);
}

TEST(Numbers, TextThatIsNotAFiniteNumberIsRefused) {
  for (const char* text : {"", "1s", " 1", "nan", "inf", "-inf", "infinity", "1e999", "1,5", "0x1p3", "--"}) {
    EXPECT_THROW(parseReal("--time", text, {}), InputError) << "'" << text << "'";
  }
}

}  // namespace
}  // namespace cellcut
