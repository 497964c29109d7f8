#include "renderer/trace/noise_watch.h"

#include "renderer/base/rng.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

/// Independent samples, the same at every call.
class Passes {
 public:
  const Film& next() {
    for (int x = 0; x < 50; ++x) film_.record(x, 0, {.radiance = Vec3(rng_.uniform())});
    film_.commit();
    return film_;
  }

 private:
  Film film_{50, 1, false};
  Rng rng_{3};
};

TEST(NoiseWatch, KnowsNothingBeforePass16AndThenLooksNowAndThen) {
  Passes passes;
  NoiseWatch watch;
  double last = watch.noise().bound;
  EXPECT_TRUE(std::isinf(last));
  std::vector<std::uint64_t> changes;
  for (std::uint64_t pass = 1; pass <= 100; ++pass) {
    watch.look(passes.next());
    if (watch.noise().bound != last) changes.push_back(pass);
    last = watch.noise().bound;
  }
  EXPECT_EQ(changes, (std::vector<std::uint64_t>{16, 20, 25, 32, 40, 50, 64, 80, 100}));
}

TEST(NoiseWatch, SeesTheSameHoweverOftenItLooksAtAPass) {
  Passes passes;
  NoiseWatch once, often;
  for (int pass = 1; pass <= 40; ++pass) {
    const Film& film = passes.next();
    once.look(film);
    for (int i = 0; i < 3; ++i) often.look(film);
    EXPECT_EQ(once.noise().bound, often.noise().bound);
  }
}

TEST(NoiseWatch, ThatBeginsLateKnowsNothingUntilItHasMetHalf) {
  Passes passes;
  NoiseWatch all, late;
  for (int pass = 1; pass <= 40; ++pass) {
    const Film& film = passes.next();
    all.look(film);
    if (pass < 18) continue;
    late.look(film);
    EXPECT_EQ(std::isinf(late.noise().bound), pass < 40) << pass;
  }
  EXPECT_EQ(late.noise().bound, all.noise().bound);
}

}  // namespace
}  // namespace cellcut
