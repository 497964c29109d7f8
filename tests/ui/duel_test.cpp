#include "ui/viewer/duel.h"

#include "tests/support/scenes.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

TEST(Duel, ThatBeginsPastItsLimitEndsWhenBothHaveHadTheSameTime) {
  SessionInput input;
  input.scene = std::make_shared<const Scene>(stage(LightMix::kPoint, 8, 1));
  input.settings.width = 32;
  input.settings.height = 24;
  input.settings.strategy = Strategy::kUniform;
  input.timeLimit = 1;
  RenderSession first;
  first.edit(input);
  first.waitIdle();
  ASSERT_GE(first.snapshot()->seconds, 1);

  input.timeLimit = 0.1;
  Duel duel([] {});
  const std::uint64_t generation = first.edit(duel.edit(input, Strategy::kPower));
  const auto start = std::chrono::steady_clock::now();
  while (!duel.finished()) {
    ASSERT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(2));
    duel.drive(first, generation);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(duel.second()->seconds, first.snapshot()->seconds);
}

}  // namespace
}  // namespace cellcut::test
