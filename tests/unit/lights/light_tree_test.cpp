#include "renderer/lights/light_tree.h"

#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

/// Lights of intensity 1 that shine everywhere, at these places.
LightTree pointTree(const std::vector<Vec3>& positions) {
  std::vector<LightBounds> bounds(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    bounds[i].axes = {{0, 0, 1}, -1, 0};
    bounds[i].box.add(positions[i]);
    bounds[i].intensity = 1;
  }
  return LightTree(bounds, LightId{0}, false);
}

TEST(LightTree, StandsExtentsWhoseReciprocalOverflows) {
  const LightTree tree = pointTree({{0, 0, 0}, {1e-39f, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(tree.leafCount(), 3u);
  EXPECT_EQ(tree.depth(), 3);
}

TEST(LightTree, StandsExtentsThatOverflow) {
  const LightTree tree = pointTree({{-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(tree.leafCount(), 3u);
  EXPECT_EQ(tree.depth(), 3);
}

}  // namespace
}  // namespace cellcut::test
