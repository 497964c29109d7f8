#include "renderer/sampling/cut_choice.h"

#include "renderer/sampling/mirrored_lights.h"

#include <array>
#include <cassert>

namespace cellcut {
namespace {

/// Weights of the near clusters at a point; on the stack, no allocation.
struct NearWeights {
  alignas(64) std::array<float, static_cast<std::size_t>(kMaxCutSize) + kClusterBlock> weight;
  std::array<float, static_cast<std::size_t>(kMaxCutSize) / kClusterBlock + 1> blockSum;
  double sum = 0;

  NearWeights(const Cut& cut, const ShadingPoint& point) {
    assert(cut.near().size() <= static_cast<std::size_t>(kMaxCutSize));
    if (cut.near().size() > 0) sum = nearWeights(cut.near(), point.p, point.n, weight.data(), blockSum.data());
    for (const Cut::LargeLight& large : cut.largeLights()) {
      const double exact = std::min<double>(large.emitter.irradiance(point.p, point.n), kMaxWeight);
      // What is too little for a float is not nothing.
      weight[large.near] = exact > 0 ? std::max(static_cast<float>(exact), std::numeric_limits<float>::min()) : 0.0f;
      blockSum[large.near / kClusterBlock] += weight[large.near];
      sum += static_cast<double>(weight[large.near]);
    }
  }
};

/// Position of the element of `weights` that holds target ∈ [0, Σ); `target` becomes the uniform number that is left.
/// Elements of weight 0 are never returned. \pre Σ > 0
std::size_t choose(std::span<const float> weights, double& target) {
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto weight = static_cast<double>(weights[i]);
    if (!(weight > 0)) continue;
    chosen = i;
    if (target < weight) break;
    target -= weight;
  }
  target = std::min(target / static_cast<double>(weights[chosen]), kAlmostOne);
  return chosen;
}

/// Two steps: a block by the sums that SIMD gave, then a cluster by their exact sum, so that rounding loses none.
/// \param u  in [0, 1); becomes the uniform number that is left
std::size_t chooseNear(const NearWeights& w, std::size_t blocks, double& u) {
  u *= w.sum;
  const std::size_t block = choose({w.blockSum.data(), blocks}, u);
  const std::span<const float> inBlock(w.weight.data() + block * kClusterBlock, kClusterBlock);
  double sum = 0;
  for (const float weight : inBlock) sum += static_cast<double>(weight);
  u *= sum;
  return block * kClusterBlock + choose(inBlock, u);
}

/// The weights of all clusters of a cut at a point, as the probabilities that they become.
struct CutWeights {
  NearWeights near;
  double toDistant = 0, toFar = 0, toNear = 0;  ///< probability of each kind; toFar: of local ones; all 0: no choice

  CutWeights(const Cut& cut, const FarChoice& far, const ShadingPoint& point) : near(cut, point) {
    const double local = far.local().sum + near.sum, distant = far.distant().sum;
    if (!(local + distant > 0)) return;
    toDistant = distantShare(local, distant);
    if (!(local > 0)) return;
    toFar = (1 - toDistant) * (far.local().sum / local);
    toNear = (1 - toDistant) * (near.sum / local);
  }
  bool empty() const { return toDistant + toFar + toNear == 0; }
  double nearPmf(std::size_t i) const { return static_cast<double>(near.weight[i]) / near.sum * toNear; }
  /// Probability of a member.
  double pmf(const Cut& cut, const FarChoice& far, std::size_t member) const {
    if (member < cut.distantCount()) return far.distant().cdf.pmf(member) * toDistant;
    if (member < cut.farCount()) return far.local().cdf.pmf(member - cut.distantCount()) * toFar;
    return toNear > 0 ? nearPmf(member - cut.farCount()) : 0.0;
  }
};

/// Most lights of a cluster that is descended into. The nodes of larger ones are seldom in a cache: with 10⁶ lights
/// choosing by intensity gives 14 % more noise in two thirds of the time.
constexpr std::uint32_t kMaxDescentLights = 64;

bool descends(InCluster inCluster, const Cut::Member& member) {
  return inCluster == InCluster::kDescent && member.leafCount <= kMaxDescentLights;
}

/// The choice between the clusters of a cut and, at a glossy surface, the lights that it mirrors.
class CutChoice {
 public:
  CutChoice(const LightTrees& trees, const Cut& cut, const FarChoice& far, InCluster inCluster,
            const ShadingPoint& point)
      : trees_(trees),
        cut_(cut),
        far_(far),
        inCluster_(inCluster),
        point_(point),
        weights_(cut, far, point),
        mirrored_(trees, point) {}

  std::optional<SampledLight> sample(double u) const {
    if (weights_.empty()) return std::nullopt;
    const double share = mirrored_.share();
    const bool mirrored = u < share;
    std::optional<SampledLight> light =
        mirrored ? mirrored_.sample(u / share) : sampleFromCut(std::min((u - share) / (1 - share), kAlmostOne));
    if (!light || share == 0) return light;
    const Place at = placeOf(light->light);
    const double fromCut = mirrored ? pmfFromCut(at) : static_cast<double>(light->pmf);
    const double fromMirrored = mirrored ? static_cast<double>(light->pmf) : mirrored_.pmf(at.distant, at.leaf);
    return sampledLight(light->light, mixed(fromCut, fromMirrored));
  }

  float pmf(LightId light) const {
    const Place at = placeOf(light);
    if (at.leaf == LightTree::kNoLeaf || weights_.empty()) return 0;
    return static_cast<float>(mixed(pmfFromCut(at), mirrored_.share() > 0 ? mirrored_.pmf(at.distant, at.leaf) : 0.0));
  }

 private:
  std::optional<SampledLight> sampleFromCut(double u) const {
    const CutWeights& w = weights_;
    std::size_t chosen;
    double pmf;
    const auto chooseFar = [&](const DiscreteCdf& cdf, double share) {
      const DiscreteCdf::Sample sample = cdf.sample(std::min(u / share, kAlmostOne));
      chosen = sample.index;
      u = sample.rest;
      pmf = sample.pmf * share;
    };
    if (u < w.toDistant) {
      chooseFar(far_.distant().cdf, w.toDistant);
    } else if (u -= w.toDistant; u < w.toFar || w.toNear == 0) {
      chooseFar(far_.local().cdf, w.toFar);
      chosen += cut_.distantCount();
    } else {
      u = std::min((u - w.toFar) / w.toNear, kAlmostOne);
      const std::size_t i = chooseNear(w.near, cut_.near().blocks(), u);
      chosen = cut_.farCount() + i;
      pmf = w.nearPmf(i);
    }
    const Cut::Member& member = cut_.members()[chosen];
    const LightTree& tree = trees_.of(member.distant);
    const std::uint32_t first = member.firstLeaf - firstLeafOf(member.distant);
    if (member.leafCount == 1) return sampledLight(tree.light(first), pmf);
    const std::optional<SampledLeaf> leaf =
        descends(inCluster_, member)
            ? sampleByDescent(tree, member.distant, member.node, NodeImportance{point_.p, point_.n}, u)
            : tree.sampleByIntensity(member.node, first, member.leafCount, u);
    if (!leaf) return std::nullopt;
    return sampledLight(tree.light(leaf->leaf), pmf * leaf->pmf);
  }

  /// Where the trees have a light.
  struct Place {
    bool distant;
    std::uint32_t leaf;
  };
  Place placeOf(LightId light) const {
    const bool distant = kCanHaveDistantLights && light >= trees_.firstDistant;
    return {distant, trees_.of(distant).leafOf(light)};
  }

  /// The number of a tree's first leaf through both trees.
  std::uint32_t firstLeafOf(bool distant) const {
    return distant ? static_cast<std::uint32_t>(trees_.local.leafCount()) : 0;
  }

  double mixed(double fromCut, double fromMirrored) const {
    return (1 - mirrored_.share()) * fromCut + mirrored_.share() * fromMirrored;
  }

  double pmfFromCut(const Place& at) const {
    const auto [distant, leaf] = at;
    const LightTree& tree = trees_.of(distant);
    const std::optional<std::size_t> found = cut_.memberOf(leaf + firstLeafOf(distant));
    if (!found) return 0;
    const Cut::Member& member = cut_.members()[*found];
    const double inside = descends(inCluster_, member)
                              ? pmfByDescent(tree, distant, member.node, NodeImportance{point_.p, point_.n}, leaf)
                              : tree.pmfByIntensity(member.node, leaf);
    return weights_.pmf(cut_, far_, *found) * inside;
  }

  const LightTrees& trees_;
  const Cut& cut_;
  const FarChoice& far_;
  InCluster inCluster_;
  const ShadingPoint& point_;
  CutWeights weights_;
  MirroredLights mirrored_;
};

}  // namespace

std::optional<SampledLight> sampleCut(const LightTrees& trees, const Cut& cut, const FarChoice& far,
                                      InCluster inCluster, const ShadingPoint& point, double u) {
  return CutChoice(trees, cut, far, inCluster, point).sample(u);
}

float pmfInCut(const LightTrees& trees, const Cut& cut, const FarChoice& far, InCluster inCluster,
               const ShadingPoint& point, LightId light) {
  return CutChoice(trees, cut, far, inCluster, point).pmf(light);
}

std::vector<double> clusterPmfs(const Cut& cut, const FarChoice& far, const ShadingPoint& point) {
  std::vector<double> pmfs(cut.size());
  const CutWeights w(cut, far, point);
  for (std::size_t i = 0; i < pmfs.size(); ++i) pmfs[i] = w.pmf(cut, far, i);
  return pmfs;
}

}  // namespace cellcut
