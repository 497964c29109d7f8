// Proof 3 of every strategy for pictures: at first and at later vertices, against a path tracer that chooses no light, and against
// each other.
#include "tests/support/depth.h"
#include "tests/support/images.h"
#include "tests/support/strategies.h"

namespace cellcut::test {
namespace {

/// Shadows of unequal lights leave few hits in a dark tile; a tile of 4² pixels with this many paths has thousands.
std::size_t passes() { return byDepth(256, 4096); }
/// The reference sums over all lights: far less variance per path, far more time.
std::size_t referencePasses() { return byDepth(48, 512); }

RenderSettings settingsFor(int maxDepth) {
  RenderSettings settings;
  settings.width = settings.height = static_cast<int>(byDepth(32, 64));
  settings.maxDepth = maxDepth;
  settings.seed = 21 + static_cast<std::uint64_t>(maxDepth);
  return settings;
}

class Pictures : public testing::TestWithParam<std::tuple<LightMix, int>> {
 protected:
  LightMix mix() const { return std::get<0>(GetParam()); }
  int maxDepth() const { return std::get<1>(GetParam()); }
};

TEST_P(Pictures, AllStrategiesAndTheReferenceAgree) {
  const Scene scene = stage(mix(), 15, 3);
  RenderSettings settings = settingsFor(maxDepth());
  std::vector<std::pair<std::string, Image<Estimate>>> pictures;
  pictures.emplace_back("reference", referenceEstimates(scene, settings, referencePasses()));
  for (const StrategyName& strategy : kStrategies) {
    settings.strategy = strategy.strategy;
    ++settings.seed;  // no two pictures share random numbers
    pictures.emplace_back(strategy.name, renderEstimates(scene, settings, passes()));
  }
  const std::size_t pairs = pictures.size() * (pictures.size() - 1) / 2;
  for (std::size_t a = 0; a < pictures.size(); ++a) {
    for (std::size_t b = a + 1; b < pictures.size(); ++b) {
      EXPECT_EQ(difference(pictures[a].second, pictures[b].second, pairs), "")
          << pictures[a].first << " against " << pictures[b].first;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Pictures, testing::Combine(testing::ValuesIn(kLightMixes), testing::Values(1, 3)),
                         [](const auto& info) {
                           return nameOf(std::get<0>(info.param)) + "_depth" + std::to_string(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace cellcut::test
