#include "renderer/measure/quality_trials.h"

#include "renderer/base/rng.h"
#include "renderer/trace/film.h"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

constexpr PlannedLength kHundredSeconds{.seconds = 100};
const std::vector<Quality> kThree{{"first", "", {}}, {"second", "", {}}, {"third", "", {}}};

/// Passes that take what they are told to, on a clock that only they move.
class FakeTrials {
 public:
  struct Costs {
    double build, pass;  ///< seconds
  };
  explicit FakeTrials(std::vector<Costs> costs) : costs_(std::move(costs)), passes_(costs_.size()) {}

  std::vector<std::vector<TrialPass>> run(const PlannedLength& length, double scale = 16) {
    return runTrials(costs_.size(), length, scale, [this](std::size_t c, double most) { return pass(c, most); });
  }
  double seconds() const { return seconds_; }
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  TrialPass pass(std::size_t c, double most) {
    const double build = passes_[c] == 0 ? costs_[c].build : 0;
    const double wanted = build + costs_[c].pass;
    const bool complete = wanted <= most;
    passes_[c] += complete;
    seconds_ += std::min(wanted, most);
    order_.push_back(c);
    return {std::min(wanted, most), build, complete};
  }
  std::vector<Costs> costs_;
  std::vector<int> passes_;
  double seconds_ = 0;
  std::vector<std::size_t> order_;
};

/// Of kHundredSeconds; sums of seconds are rounded.
constexpr double kBudget = kTrialShare * 100 * (1 + 1e-12);

TEST(RunTrials, TakeTheirShareOfThePlannedSecondsAndNoMore) {
  FakeTrials trials({{0.2, 0.1}, {0.3, 0.1}, {0.4, 0.2}});
  const auto passes = trials.run(kHundredSeconds);
  EXPECT_LE(trials.seconds(), kBudget);
  EXPECT_GT(trials.seconds(), 0.9 * kBudget);
  for (const auto& of : passes) EXPECT_GE(of.size(), 8u);
}

TEST(RunTrials, TakeTheirShareOfThePlannedPasses) {
  // A pass of the picture takes 16 · 0.01 s, or less by kSmallFilmCost.
  FakeTrials trials({{0.05, 0.01}, {0.05, 0.01}, {0.05, 0.01}});
  trials.run({.passes = 100});
  const double budget = kTrialShare * 100 * 16 * 0.01 / kSmallFilmCost;
  EXPECT_LE(trials.seconds(), budget * (1 + 1e-12));
  EXPECT_GT(trials.seconds(), 0.9 * budget);
}

TEST(RunTrials, GoInTurnAfterTwoPassesOfTheFirst) {
  FakeTrials trials({{0.2, 0.1}, {0.2, 0.1}, {0.2, 0.1}});
  const auto passes = trials.run(kHundredSeconds);
  const std::vector<std::size_t> begin(trials.order().begin(), trials.order().begin() + 9);
  EXPECT_EQ(begin, (std::vector<std::size_t>{0, 0, 1, 2, 1, 2, 0, 1, 2}));
  EXPECT_LE(passes[0].size() - passes[2].size(), 1u);
}

TEST(RunTrials, EndWhenMoreWouldSayLittle) {
  FakeTrials trials({{0, 1e-6}, {0, 1e-6}});
  for (const auto& of : trials.run(kHundredSeconds)) EXPECT_EQ(of.size(), kMostTrialPasses);
}

TEST(RunTrials, LeaveOutACandidateThatIsTooDear) {
  FakeTrials trials({{0.1, 0.1}, {0.1, 0.1}, {10, 0.1}});
  const auto passes = trials.run(kHundredSeconds);
  EXPECT_TRUE(passes[2].empty());
  EXPECT_GE(passes[1].size(), 3u);
  EXPECT_LE(trials.seconds(), kBudget);
}

TEST(RunTrials, EndWithTheFirstCandidateWhereItAloneIsTooDear) {
  FakeTrials trials({{10, 0.1}, {0, 0.1}});
  const auto passes = trials.run(kHundredSeconds);
  EXPECT_EQ(trials.order().size(), 1u);
  EXPECT_TRUE(passes[0].empty());
  EXPECT_LE(trials.seconds(), kBudget / 3);
}

TEST(RunTrials, DoNotBeginForAFewPassesNorForOneCandidate) {
  FakeTrials few({{0, 1e-6}, {0, 1e-6}, {0, 1e-6}});
  few.run({.passes = 16});  // the share of 16 · 16 trial passes is 5.8; two of each are six
  EXPECT_TRUE(few.order().empty());
  FakeTrials one({{0, 1e-6}});
  one.run(kHundredSeconds);
  EXPECT_TRUE(one.order().empty());
}

using SampleOf = std::function<float(Rng&)>;

/// What is known after `passes` passes of 40×24 pixels that are 1 in truth.
FilmState filmOf(std::uint64_t seed, int passes, const SampleOf& sample) {
  Film film(40, 24, false);
  Rng rng(seed);
  for (int pass = 0; pass < passes; ++pass) {
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 40; ++x) film.record(x, y, {.radiance = Vec3(sample(rng))});
    }
    film.commit();
  }
  return {film.passes(), film.mean(), film.standardError()};
}

/// Uniform around 1: variance halfWidth² / 3.
SampleOf uniform(float halfWidth) {
  return [halfWidth](Rng& rng) { return 1 + halfWidth * (2 * rng.uniform() - 1); };
}

std::vector<TrialPass> passesOf(double build, double seconds, std::size_t count = 16) {
  std::vector<TrialPass> passes;
  for (std::size_t i = 0; i < count; ++i) {
    const double jitter = 1 + 0.01 * std::sin(static_cast<double>(3 * i));  // a clock never says the same twice
    passes.push_back({(i == 0 ? build : 0) + seconds * jitter, i == 0 ? build / 2 : 0, true});
  }
  return passes;
}

TEST(JudgeTrials, InefficiencyIsVarianceTimesSeconds) {
  const std::vector<FilmState> films{filmOf(1, 16, uniform(1)), filmOf(2, 16, uniform(0.5f)),
                                     filmOf(3, 16, uniform(1))};
  const auto trials =
      judgeTrials(kThree, {passesOf(0, 0.01), passesOf(0, 0.02), passesOf(0, 0.02)}, films, kHundredSeconds, 16);
  // 960 pixels of 16 samples: the variance is known to 1 %, and its ratio to twice that.
  EXPECT_NEAR(trials[0].relativeVariance, 1.0 / 3 / 1.01, 0.02);
  EXPECT_NEAR(trials[0].passSeconds, 0.16, 0.002);
  EXPECT_NEAR(trials[0].inefficiency.value, 1, 1e-12);
  EXPECT_NEAR(trials[1].inefficiency.value, 0.25 * 2, 0.03);
  EXPECT_NEAR(trials[2].inefficiency.value, 2, 0.1);
  for (const QualityTrial& t : trials) {
    EXPECT_LE(t.inefficiency.low, t.inefficiency.value);
    EXPECT_GE(t.inefficiency.high, t.inefficiency.value);
  }
  EXPECT_EQ(bestTrial(trials), 1u);
}

TEST(JudgeTrials, BuildingIsSpreadOverThePlannedPasses) {
  const std::vector<FilmState> films{filmOf(1, 16, uniform(1)), filmOf(2, 16, uniform(1)), filmOf(3, 16, uniform(1))};
  const auto inefficiency = [&](const PlannedLength& length) {
    return judgeTrials(kThree, {passesOf(0, 0.01), passesOf(1.6, 0.01), passesOf(0, 0.01)}, films, length, 16)[1]
        .inefficiency.value;
  };
  EXPECT_NEAR(inefficiency({.passes = 10}), 2, 0.1);  // as much as ten passes of 0.16 s
  EXPECT_NEAR(inefficiency({.passes = 1000}), 1.01, 0.06);
  EXPECT_NEAR(inefficiency({.seconds = 3.2}), 2, 0.1);  // half of the time is left
  EXPECT_EQ(inefficiency({.seconds = 1}), std::numeric_limits<double>::infinity());
}

TEST(JudgeTrials, EqualSettingsLeaveTheFirst) {
  int others = 0;
  for (std::uint64_t seed = 0; seed < 100; seed += 5) {
    const std::vector<FilmState> films{filmOf(seed, 8, uniform(1)), filmOf(seed + 1, 8, uniform(1)),
                                       filmOf(seed + 2, 8, uniform(1))};
    const auto trials = judgeTrials(kThree, {passesOf(0, 0.01, 8), passesOf(0, 0.01, 8), passesOf(0, 0.01, 8)}, films,
                                    kHundredSeconds, 16);
    others += bestTrial(trials) != 0;
  }
  // One side of a 95 % interval errs in 2.5 % of trials: of 40 one; more than five once in a thousand.
  EXPECT_LE(others, 5);
}

/// The first setting met the firefly, and its mean variance is that of the others 300 times.
TEST(JudgeTrials, OneFireflyDecidesNothing) {
  FilmState unlucky = filmOf(1, 16, uniform(1));
  unlucky.mean.at(7, 5) += Vec3(100);
  unlucky.standardError.at(7, 5) = Vec3(100);
  const std::vector<FilmState> films{unlucky, filmOf(2, 16, uniform(1)), filmOf(3, 16, uniform(1))};
  const auto trials =
      judgeTrials(kThree, {passesOf(0, 0.01), passesOf(0, 0.01), passesOf(0, 0.01)}, films, kHundredSeconds, 16);
  EXPECT_NEAR(trials[0].relativeVariance / trials[1].relativeVariance, 1, 0.1);
  EXPECT_EQ(bestTrial(trials), 0u);
}

TEST(JudgeTrials, NothingIsKnownOfTooFewPassesNorOfABlackPicture) {
  const auto black = [](Rng&) { return 0.0f; };
  for (const SampleOf& sample : {uniform(1), SampleOf(black)}) {
    const bool isBlack = filmOf(0, 2, sample).mean.at(0, 0).x == 0;
    const std::size_t count = isBlack ? 16 : 2;
    const std::vector<FilmState> films(3, filmOf(0, static_cast<int>(count), sample));
    const auto trials =
        judgeTrials(kThree, {passesOf(0, 0.02, count), passesOf(0, 0.01, count), passesOf(0, 0.01, count)}, films,
                    kHundredSeconds, 16);
    EXPECT_TRUE(std::isnan(trials[1].inefficiency.value));
    EXPECT_EQ(bestTrial(trials), 0u);
  }
}

TEST(BestTrial, IsTheLeastInefficientOfThoseThatAreBetterBeyondDoubt) {
  const auto trial = [](double low, double value, double high) {
    QualityTrial t;
    t.inefficiency = {value, low, high};
    return t;
  };
  const QualityTrial first = trial(1, 1, 1), doubtful = trial(0.2, 0.5, 1.2), good = trial(0.7, 0.8, 0.9),
                     better = trial(0.6, 0.7, 0.99);
  EXPECT_EQ(bestTrial(std::vector{first}), 0u);
  EXPECT_EQ(bestTrial(std::vector{first, doubtful}), 0u);
  EXPECT_EQ(bestTrial(std::vector{first, doubtful, good, better}), 3u);
}

}  // namespace
}  // namespace cellcut
