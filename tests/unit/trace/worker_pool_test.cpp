#include "renderer/trace/worker_pool.h"

#include <algorithm>
#include <numeric>
#include <semaphore>
#include <stdexcept>

#include <gtest/gtest.h>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace cellcut::test {
namespace {

class Pool : public testing::Test {
 protected:
  void run(int count, std::function<void(int)> piece) {
    pool_.start(count, std::move(piece));
    done_.acquire();
  }
  std::counting_semaphore<> done_{0};
  WorkerPool pool_{4, [this] { done_.release(); }};
};

TEST_F(Pool, TakesEachPieceOnce) {
  for (int count = 1; count < 500; ++count) {
    std::vector<int> taken(static_cast<std::size_t>(count), 0);
    run(count, [&](int i) { ++taken[static_cast<std::size_t>(i)]; });
    ASSERT_EQ(std::accumulate(taken.begin(), taken.end(), 0), count);
    ASSERT_EQ(*std::max_element(taken.begin(), taken.end()), 1);
    EXPECT_FALSE(done_.try_acquire());
  }
}

TEST_F(Pool, WhatAPieceThrowsIsThrownOnAndTheRestIsLeft) {
  std::atomic<int> after{0};
  run(1000, [&](int i) {
    if (i == 0) throw std::runtime_error("piece 0");
    ++after;
  });
  EXPECT_THROW(pool_.rethrow(), std::runtime_error);
  run(10, [&](int) {});
  EXPECT_NO_THROW(pool_.rethrow());
}

#ifdef __linux__
TEST_F(Pool, WorksAtTheLowestPriority) {
  const auto niceness = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); };
  const int own = niceness();
  std::atomic<int> others{0};
  run(64, [&](int) { others += niceness() != 19; });
  EXPECT_EQ(others, 0);
  EXPECT_EQ(niceness(), own) << "the caller keeps its own";
}
#endif

}  // namespace
}  // namespace cellcut::test
