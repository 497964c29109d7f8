#include "renderer/sampling/descent.h"
#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

/// One random descent from the roots.
class LightTreeSampler final : public LightSampler {
 public:
  explicit LightTreeSampler(const Lights& lights) : trees_(lights) {}

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override {
    const TreesDescent descent = descentAt(point);
    return descent.sum() > 0 ? descent.sample(u) : std::nullopt;
  }

  float pmf(const ShadingPoint& point, LightId light) const override {
    const bool distant = light >= trees_.firstDistant;
    const std::uint32_t leaf = trees_.of(distant).leafOf(light);
    const TreesDescent descent = descentAt(point);
    if (leaf == LightTree::kNoLeaf || !(descent.sum() > 0)) return 0;
    return static_cast<float>(descent.pmf(distant, leaf));
  }
  std::size_t bytes() const override { return trees_.bytes(); }
  SamplerStatistics statistics() const override { return {.tree = trees_.statistics()}; }

 private:
  TreesDescent descentAt(const ShadingPoint& point) const { return {trees_, {point.p, point.n}}; }

  LightTrees trees_;
};

}  // namespace

std::unique_ptr<LightSampler> makeLightTreeSampler(const Lights& lights) {
  return std::make_unique<LightTreeSampler>(lights);
}

}  // namespace cellcut
