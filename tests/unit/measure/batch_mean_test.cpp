#include "renderer/measure/batch_mean.h"

#include "renderer/base/relative_error.h"
#include "renderer/base/rng.h"
#include "renderer/measure/metrics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace cellcut {
namespace {

TEST(BatchMean, HasTheMeanAndTheDeviationsOfItsBatches) {
  BatchMean batches(2, 1);
  for (const float value : {1.0f, 2.0f, 6.0f}) {
    ImageRgb batch(2, 1);
    batch.at(0, 0) = Vec3(value, 4, 0);
    batches.add(batch);
  }
  EXPECT_EQ(batches.count, 3u);
  EXPECT_FLOAT_EQ(batches.mean.at(0, 0).x, 3);
  EXPECT_FLOAT_EQ(batches.deviation.at(0, 0).x, std::sqrt(4.0f + 1 + 9));
  EXPECT_EQ(batches.mean.at(0, 0).y, 4);
  EXPECT_EQ(batches.deviation.at(0, 0).y, 0);
  // Of the six channels one has noise: 14 / (3 · 2) relative to 3², with the epsilon of relMSE.
  const double mean = (3.0 + 4.0) / 6;
  EXPECT_NEAR(batches.relmse(), 14.0 / 6 / (9 + kRelativeEpsilon * mean * mean) / 6, 1e-7);
}

TEST(BatchMean, OwnErrorIsWhatTheMeanHasAgainstTheTruth) {
  constexpr int kWidth = 100, kHeight = 60, kBatchCount = 16;
  const ImageRgb truth(kWidth, kHeight, Vec3(2, 0.5f, 1));
  Rng rng(1);
  BatchMean batches(kWidth, kHeight);
  for (int b = 0; b < kBatchCount; ++b) {
    ImageRgb batch = truth;
    for (Vec3& pixel : batch) {
      for (int c = 0; c < 3; ++c) pixel[c] *= rng.uniform(0.9f, 1.1f);
    }
    batches.add(batch);
  }
  // A mean of the squares of 18,000 nearly normal numbers has a relative deviation of √(2 / 18,000) = 0.0105; five.
  EXPECT_NEAR(compareImages(batches.mean, truth).relmse / batches.relmse(), 1, 0.053);
}

}  // namespace
}  // namespace cellcut
