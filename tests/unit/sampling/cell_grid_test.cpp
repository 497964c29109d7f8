#include "renderer/sampling/cell_grid.h"

#include "renderer/base/rng.h"
#include "renderer/sampling/cell_cut.h"
#include "renderer/sampling/facing.h"
#include "renderer/sampling/inspection.h"
#include "tests/support/depth.h"
#include "tests/support/scenes.h"

#include <array>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

double distance(const Vec3& a, const Vec3& b) {
  // Through memory, one coordinate at a time: not the vector code that is under test.
  volatile double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const volatile double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum = sum + d * d;
  }
  return std::sqrt(sum);
}

TEST(GridGeometry, IndirectAndRemotePointsHaveCoarseCells) {
  Bounds box;
  box.lower = Vec3(0);
  box.upper = Vec3(16, 7, 1);
  const GridGeometry grid(box, 16);
  // Four fine cells wide, and centred on the box: one begins with it along x and y, and a cell before it along z.
  EXPECT_EQ(grid.cellOf(Vec3(0.5f), true), (CellCoordinates{0, 0, 0, true}));
  EXPECT_EQ(grid.box({0, 0, 0, true}).lower, Vec3(0, 0, -1));
  EXPECT_EQ(grid.box({0, 0, 0, true}).upper, Vec3(4, 4, 3));
  EXPECT_EQ(grid.cellOf(Vec3(-0.5f, 4.5f, -1.5f), true), (CellCoordinates{-1, 1, -1, true}));

  // Remote are coarse cells that lie whole beyond a quarter of the longest axis, on any axis.
  const auto coarse = [&](const Vec3& p) { return grid.cellOf(p)->coarse; };
  for (const Vec3& near : {Vec3(0.5f), Vec3(-3.9f, 3, 0), Vec3(19.9f, 11.9f, 0), Vec3(3, 3, -4.9f), Vec3(3, 3, 6.9f)})
    EXPECT_FALSE(coarse(near)) << near.x << " " << near.y << " " << near.z;
  for (const Vec3& far : {Vec3(-4.1f, 3, 0), Vec3(20.1f, 3, 0), Vec3(3, 12.1f, 0), Vec3(3, 3, -5.1f), Vec3(3, 3, 7.1f)})
    EXPECT_TRUE(coarse(far)) << far.x << " " << far.y << " " << far.z;

  EXPECT_EQ(cutSettingsOf({.maxCut = 1024}, {0, 0, 0}).maxSize, 1024);
  EXPECT_EQ(cutSettingsOf({.maxCut = 1024}, {0, 0, 0, true}).maxSize, 256);
  EXPECT_EQ(cutSettingsOf({.maxCut = 2}, {0, 0, 0, true}).maxSize, 2);
}

// Points have fine or coarse cells by where they are, and never both: no light is chosen from a coarse cell among the
// fine but after a bounce.
TEST(GridGeometry, RemoteCellsHaveNoFineOnesInThem) {
  Rng rng(5);
  for (const int resolution : {1, 2, 3, 5, 6, 7, 10, 16, 20}) {
    Bounds box;
    box.lower = Vec3(0);
    box.upper = Vec3(9, 4, 6.5f);
    const GridGeometry grid(box, resolution);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 p(rng.uniform(-20, 30), rng.uniform(-20, 30), rng.uniform(-20, 30));
      ASSERT_EQ(grid.cellOf(p)->coarse, grid.isRemote(*grid.cellOf(p, true)));
      const bool inside = glm::clamp(p, box.lower, box.upper) == p;
      if (inside) {
        ASSERT_FALSE(grid.cellOf(p)->coarse);
      }
    }
  }
}

// Cells of 3.8 floats: of four in a row the farthest is 2 floats from the rounded centre, and half of the cell is 1.9.
TEST(GridGeometry, CellsHoldTheirPointsWhereFloatsAreCoarse) {
  Bounds box;
  box.add(Vec3(5000.013f, 5000.011f, 5000.017f));
  box.add(Vec3(5000.1317f, 5000.09f, 5000.08f));
  const GridGeometry grid(box, 64);
  Rng rng(1);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 p = Vec3(5000) + 0.13f * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    for (const bool indirect : {false, true}) {
      const Region region = grid.region(*grid.cellOf(p, indirect));
      ASSERT_LE(distance(p, region.centre), static_cast<double>(region.radius));
    }
  }
}

TEST(CellCut, WithoutPilotCellsAreOfTheScenesSize) {
  for (const float scale : {0x1p-20f, 1.0f, 0x1p20f}) {
    Scene scene;
    for (const Vec3& p : {Vec3(0), Vec3(1, 2, 4)}) {
      scene.pointLights.push_back({scale * p, Vec3(1)});
      scene.bounds.add(scale * p);
    }
    const Lights lights(scene);
    const CellCutSampler sampler(lights, {.gridResolution = 16}, {});
    EXPECT_EQ(CutInspector::of(sampler)->grid()->cellSize(), static_cast<double>(scale) / 4);
  }
}

TEST(CellTable, HasNoMoreSlotsThanPicturesHaveCells) {
  const CellTable table(std::size_t{1} << 40);
  EXPECT_LE(table.bytes(), std::size_t{64} << 20);
}

TEST(CellTable, GivesReservedMemoryBack) {
  CellTable table(1 << 20);
  const std::size_t before = table.bytes();
  ASSERT_TRUE(table.reserve(5000));
  EXPECT_EQ(table.bytes(), before + 5000);
  table.release(5000);
  EXPECT_EQ(table.bytes(), before);
}

TEST(CellTable, KeepsHalfOfItsMemoryForCuts) {
  CellTable table(1 << 20);
  const std::size_t before = table.bytes();
  while (table.reserve(5000)) continue;
  EXPECT_NEAR(static_cast<double>(table.bytes() - before), 1 << 19, 5000);
  EXPECT_NE(table.findOrMake({1, 2, 3}, [] { return Cut(); }), nullptr);
}

TEST(CellTable, DoesNotKeepOthersWaitingForACellThatCouldNotBeMade) {
  const auto table = std::make_shared<CellTable>(1 << 20);
  const CellCoordinates cell{1, 2, 3};
  EXPECT_THROW(table->findOrMake(cell, []() -> Cut { throw std::runtime_error("made no cut"); }), std::runtime_error);
  // In a thread of its own, which a failure leaves behind: it would wait for ever.
  std::promise<const Cut*> answer;
  std::future<const Cut*> answered = answer.get_future();
  std::thread([table, cell, promise = std::move(answer)]() mutable {
    promise.set_value(table->findOrMake(cell, [] { return Cut(); }));
  }).detach();
  ASSERT_EQ(answered.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_EQ(answered.get(), nullptr);
}

TEST(BlockedFloats, ThrowWhenThereIsNoMemory) {
  if (isSanitized()) GTEST_SKIP() << "the sanitizer ends the program when memory is short";
  EXPECT_THROW(BlockedFloats(std::size_t{1} << 50, kNearFields), std::bad_alloc);
}

TEST(Cut, KeepsTheFirstChoiceOfAFacing) {
  const Scene scene = stage(LightMix::kEnvironment, 16, 1);
  const Lights lights(scene);
  const LightTrees trees(lights);
  const Cut cut(trees, {Vec3(0), 1}, {distantCluster(trees.distant, trees.distant.root())});
  const Cut::Kept first = cut.keep(7, cut.makeFarChoice(7)), second = cut.keep(7, cut.makeFarChoice(7));
  EXPECT_TRUE(first.isNew);
  EXPECT_FALSE(second.isNew);
  EXPECT_EQ(first.choice, second.choice);
  EXPECT_EQ(cut.farChoice(7), first.choice);
}

// Threads that make the same choice at once: one of them is kept, and the memory of the others is free again.
TEST(CellCut, CountsTheMemoryThatItsCutsHold) {
  const Scene scene = stage(LightMix::kAll, 2000, 5);
  const Lights lights(scene);
  std::vector<Vec3> pilot(1000);
  Rng rng(4);
  for (Vec3& p : pilot) p = {rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)};
  const CellCutSampler sampler(lights, {.gridResolution = 2}, pilot);
  const std::size_t empty = sampler.bytes();
  std::array<std::thread, 8> threads;
  for (std::thread& thread : threads) {
    thread = std::thread([&] {
      for (std::size_t i = 0; i < kFacings; ++i) (void)sampler.sample({pilot[i], facing(i).axis}, 0.5);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sampler.bytes() - empty, sampler.statistics().cut->bytes);
}

}  // namespace
}  // namespace cellcut::test
