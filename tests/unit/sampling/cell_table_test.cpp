#include "renderer/base/rng.h"
#include "renderer/sampling/cell_grid.h"
#include "tests/support/depth.h"
#include "tests/support/own_threads.h"
#include "tests/support/scenes.h"

#include <array>
#include <barrier>
#include <thread>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

constexpr int kThreads = 8;
constexpr int kSide = 6;
constexpr std::size_t kCells = kSide * kSide * kSide;

CellCoordinates cellAt(std::size_t i) {
  const auto n = static_cast<std::int32_t>(i);
  const std::int32_t layer = n / (kSide * kSide);
  // On both sides of zero, half of them coarse and otherwise like a fine one.
  return {n % kSide - 3, n / kSide % kSide - 3, layer / 2, layer % 2 == 1};
}

/// Runs a function on several threads at once. They are std::thread's, so that a race detector sees them.
void onThreads(const std::function<void(int)>& function) {
  std::barrier start(kThreads);
  std::array<std::thread, kThreads> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads[static_cast<std::size_t>(t)] = std::thread([&, t] {
      start.arrive_and_wait();
      function(t);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

class CellTableOnThreads : public testing::Test {
 protected:
  Cut cutOf(const CellCoordinates& cell) const {
    const Region region{{static_cast<float>(cell.x), static_cast<float>(cell.y), static_cast<float>(cell.z)}, 1};
    std::vector<Cluster> clusters;
    findCut(trees, region, {0, 20}, clusters);
    return Cut(trees, region, clusters);
  }
  OnlyOwnThreads onlyOwnThreads;
  const Scene scene = stage(LightMix::kAll, 100, 4);
  const Lights lights{scene};
  const LightTrees trees{lights};
};

TEST_F(CellTableOnThreads, EachCellIsMadeOnceAndAllSeeTheSameCut) {
  for (std::size_t round = 0; round < byDepth(30, 300); ++round) {
    CellTable table(std::size_t{8} << 20);
    std::array<std::atomic<int>, kCells> made{};
    std::array<std::array<const Cut*, kCells>, kThreads> found{};
    onThreads([&](int thread) {
      Rng rng(round * kThreads + static_cast<std::uint64_t>(thread));
      for (std::size_t i = 0; i < 20 * kCells; ++i) {
        // Mostly the same few cells, so that threads meet in them.
        const auto at = static_cast<std::size_t>(std::pow(rng.uniform(), 3.0f) * static_cast<float>(kCells));
        const CellCoordinates cell = cellAt(at);
        const Cut* cut = table.findOrMake(cell, [&] {
          ++made[at];
          return cutOf(cell);
        });
        const Cut*& before = found[static_cast<std::size_t>(thread)][at];
        if (before) {
          ASSERT_EQ(cut, before);
        }
        before = cut;
        // What the cut holds was written by another thread, as was the choice of each facing.
        ASSERT_EQ(cut->size(), cut->members().size());
        if (cut->farCount() == 0) continue;
        const std::size_t facing = i % 4;
        if (!cut->farChoice(facing)) cut->keep(facing, cut->makeFarChoice(facing));
        ASSERT_GT(cut->farChoice(facing)->distant().sum + cut->farChoice(facing)->local().sum, 0);
      }
    });
    std::size_t cells = 0;
    table.forEach([&](const CellCoordinates& cell, const Cut& cut) {
      ++cells;
      EXPECT_EQ(table.find(cell), &cut);
    });
    std::size_t touched = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
      const Cut* kept = table.find(cellAt(i));
      ASSERT_EQ(made[i].load(), kept ? 1 : 0);
      if (kept) ++touched;
      for (const auto& of : found) ASSERT_TRUE(!of[i] || of[i] == kept);
    }
    EXPECT_EQ(cells, touched);
  }
}

TEST_F(CellTableOnThreads, ATableWithoutRoomKeepsNothingAndNobodyWaits) {
  CellTable table(0);
  onThreads([&](int) {
    for (std::size_t i = 0; i < kCells; ++i) {
      EXPECT_EQ(table.findOrMake(cellAt(i), [&] { return cutOf(cellAt(i)); }), nullptr);
    }
  });
  table.forEach([&](const CellCoordinates&, const Cut&) { FAIL(); });
}

TEST_F(CellTableOnThreads, AFailureToMakeACellLeavesItToEachCaller) {
  CellTable table(std::size_t{1} << 20);
  onThreads([&](int) {
    for (std::size_t i = 0; i < kCells; ++i) {
      EXPECT_EQ(table.findOrMake(cellAt(i), []() -> Cut { throw std::bad_alloc(); }), nullptr);
    }
  });
}

}  // namespace
}  // namespace cellcut::test
