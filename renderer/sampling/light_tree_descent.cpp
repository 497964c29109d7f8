#include "renderer/sampling/cut_choice.h"
#include "renderer/sampling/strategies.h"

namespace cellcut {
namespace {

/// One random descent from the root. Source: Conty Estevez and Kulla 2018, section 5, without their splitting.
class LightTreeSampler final : public LightSampler {
 public:
  explicit LightTreeSampler(const Lights& lights) : trees_(lights) {}

  std::optional<SampledLight> sample(const ShadingPoint& point, double u) const override {
    const double toLocal = localProbability(point);
    if (toLocal < 0) return std::nullopt;
    const bool distant = !(u < toLocal);
    const double share = distant ? 1 - toLocal : toLocal;
    const LightTree& tree = distant ? trees_.distant : trees_.local;
    const double rest = std::min((distant ? u - toLocal : u) / share, 1 - 0x1p-53);
    const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, tree.root(), point, rest);
    if (!leaf) return std::nullopt;
    return SampledLight{tree.light(leaf->leaf), static_cast<float>(share * leaf->pmf)};
  }

  float pmf(const ShadingPoint& point, LightId light) const override {
    const bool distant = light >= trees_.firstDistant;
    const LightTree& tree = distant ? trees_.distant : trees_.local;
    const std::uint32_t leaf = tree.leafOf(light);
    const double toLocal = localProbability(point);
    if (leaf == LightTree::kNoLeaf || toLocal < 0) return 0;
    const double share = distant ? 1 - toLocal : toLocal;
    return static_cast<float>(share * pmfByDescent(tree, distant, tree.root(), point, leaf));
  }
  std::size_t bytes() const override { return trees_.bytes(); }
  SamplerStatistics statistics() const override { return {.tree = trees_.statistics()}; }

 private:
  /// Probability of the local tree; negative when neither can contribute.
  double localProbability(const ShadingPoint& point) const {
    const auto importance = [&](const LightTree& tree, bool distant) {
      return tree.empty() ? 0.0 : static_cast<double>(nodeImportance(tree, distant, tree.root(), point.p, point.n));
    };
    const double local = importance(trees_.local, false), distant = importance(trees_.distant, true);
    return local + distant > 0 ? local / (local + distant) : -1;
  }

  LightTrees trees_;
};

}  // namespace

std::unique_ptr<LightSampler> makeLightTreeSampler(const Lights& lights) {
  return std::make_unique<LightTreeSampler>(lights);
}

}  // namespace cellcut
