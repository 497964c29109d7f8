#include "app/interrupt.h"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

TEST(Interrupt, FirstSignalIsARequest) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptRequest interrupt;
    EXPECT_FALSE(interrupt.requested());
    std::raise(signal);
    EXPECT_TRUE(interrupt.requested());
  }
}

TEST(Interrupt, RequestIsForgottenByTheNextOne) {
  {
    const InterruptRequest interrupt;
    std::raise(SIGINT);
  }
  const InterruptRequest next;
  EXPECT_FALSE(next.requested());
}

TEST(InterruptDeathTest, SecondSignalQuitsAtOnce) {
  const auto interruptTwice = [] {
    const InterruptRequest interrupt;
    std::raise(SIGINT);
    std::raise(SIGTERM);
    std::exit(0);
  };
  EXPECT_EXIT(interruptTwice(), testing::ExitedWithCode(1), "once more to quit");
}

TEST(InterruptDeathTest, SignalsMeanWhatTheyDidBeforeOnceItIsGone) {
  const auto interruptAfterwards = [] {
    std::signal(SIGINT, SIG_DFL);  // a shell lets what it starts in the background ignore it
    { const InterruptRequest interrupt; }
    std::raise(SIGINT);
    std::exit(0);
  };
  EXPECT_EXIT(interruptAfterwards(), testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace cellcut
