#include "renderer/sampling/descent.h"

#include <algorithm>
#include <array>

// Highway compiles what follows once per instruction set and chooses at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/sampling/descent.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "renderer/sampling/cluster_importance-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cellcut::HWY_NAMESPACE {
namespace {

constexpr std::size_t kLanes = 4;
using Tag = hn::FixedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;

Floats set(float value) {
  return hn::Set(kTag, value);
}

/// a, b, c, d become the columns of the matrix whose rows they are.
void transpose(Floats& a, Floats& b, Floats& c, Floats& d) {
  const auto abLower = hn::InterleaveLower(kTag, a, b), abUpper = hn::InterleaveUpper(kTag, a, b);
  const auto cdLower = hn::InterleaveLower(kTag, c, d), cdUpper = hn::InterleaveUpper(kTag, c, d);
  a = hn::ConcatLowerLower(kTag, cdLower, abLower);
  b = hn::ConcatUpperUpper(kTag, cdLower, abLower);
  c = hn::ConcatLowerLower(kTag, cdUpper, abUpper);
  d = hn::ConcatUpperUpper(kTag, cdUpper, abUpper);
}

/// π D(h) of a node's direction for a lobe that is widened by the node's extent; 1 where that says nothing: for a node
/// all around, and for a lobe that has become flat.
Floats lobeFactors(const NodeImportance& importance, Floats toX, Floats toY, Floats toZ, Floats cosU) {
  const NodeImportance::Lobe& lobe = *importance.lobe;
  const Vec3& n = importance.n;
  const auto one = set(1), zero = set(0);
  const auto a2 = hn::MulAdd(hn::Sub(one, cosU), set(lobe.perSpread), set(lobe.alpha2));
  const auto hX = hn::Add(toX, set(lobe.wo.x)), hY = hn::Add(toY, set(lobe.wo.y)), hZ = hn::Add(toZ, set(lobe.wo.z));
  // a² / (sin² θh + a² cos² θh)², for h that is not unit.
  const auto squared = dot(hX, hY, hZ, hX, hY, hZ), alongNormal = dot(hX, hY, hZ, set(n.x), set(n.y), set(n.z));
  const auto cos2 = hn::Min(squared, hn::Mul(alongNormal, alongNormal));
  const auto e = hn::MulAdd(a2, cos2, hn::Sub(squared, cos2));
  const auto says = hn::And(hn::And(hn::Gt(cosU, zero), hn::Lt(a2, one)), hn::Gt(e, zero));
  const auto ratio = hn::Div(squared, hn::IfThenElse(says, e, one));
  return hn::IfThenElse(says, hn::Mul(a2, hn::Mul(ratio, ratio)), one);
}

/// Importances of four nodes.
void weigh(const LightTree& tree, bool distant, const std::array<NodeId, kLanes>& nodes,
           const NodeImportance& importance, std::array<double, kLanes>& weights) {
  // A node is ten words: box, intensity, octahedral axis, angles, leaves.
  static_assert(sizeof(LightTreeNode) == 10 * sizeof(float));
  /// Words `word` to `word` + 3 of all nodes.
  const auto load = [&](std::size_t word, Floats& a, Floats& b, Floats& c, Floats& d) {
    const auto ofNode = [&](std::size_t lane) {
      return hn::LoadU(kTag, reinterpret_cast<const float*>(&tree.node(nodes[lane])) + word);
    };
    a = ofNode(0), b = ofNode(1), c = ofNode(2), d = ofNode(3);
    transpose(a, b, c, d);
  };
  Floats intensity, axisWord, angleWord, countAndSides;
  load(6, intensity, axisWord, angleWord, countAndSides);

  constexpr IntTag kIntTag;
  const auto axes = hn::BitCast(kIntTag, axisWord), angles = hn::BitCast(kIntTag, angleWord);
  const auto toFloat = [&](auto ints, float scale) { return hn::Mul(hn::ConvertTo(kTag, ints), set(scale)); };
  const auto one = set(1), zero = set(0);
  const auto codedX = toFloat(hn::ShiftRight<16>(hn::ShiftLeft<16>(axes)), 1.0f / 32767);
  const auto codedY = toFloat(hn::ShiftRight<16>(axes), 1.0f / 32767);
  const auto halfO = toFloat(hn::And(angles, hn::Set(kIntTag, 0xffff)), 1.0f / 65535);
  const auto cosO = hn::NegMulAdd(hn::Add(halfO, halfO), halfO, one);
  const auto sinO = hn::Mul(hn::Add(halfO, halfO), sinesOf(halfO));
  // fromOctahedral().
  auto axisZ = hn::Sub(hn::Sub(one, hn::Abs(codedX)), hn::Abs(codedY));
  const auto folded = hn::Lt(axisZ, zero);
  auto axisX = hn::IfThenElse(folded, hn::CopySign(hn::Sub(one, hn::Abs(codedY)), codedX), codedX);
  auto axisY = hn::IfThenElse(folded, hn::CopySign(hn::Sub(one, hn::Abs(codedX)), codedY), codedY);
  const auto perLength = hn::Div(one, hn::Sqrt(dot(axisX, axisY, axisZ, axisX, axisY, axisZ)));
  axisX = hn::Mul(axisX, perLength), axisY = hn::Mul(axisY, perLength), axisZ = hn::Mul(axisZ, perLength);

  Floats toX, toY, toZ, cosU, sinU, estimate;
  if (kCanHaveDistantLights && distant) {
    toX = hn::Neg(axisX), toY = hn::Neg(axisY), toZ = hn::Neg(axisZ);
    cosU = cosO, sinU = sinO;
    estimate = intensity;
  } else {
    Floats lowerX, lowerY, lowerZ, upperX, upperY, upperZ, unused6, unused7;
    load(0, lowerX, lowerY, lowerZ, upperX);
    load(4, upperY, upperZ, unused6, unused7);
    const auto half = set(0.5f);
    const auto radiusAlong = [&](auto lower, auto upper, auto& centre) {
      centre = hn::Add(hn::Mul(half, upper), hn::Mul(half, lower));
      return hn::Max(hn::Sub(upper, centre), hn::Sub(centre, lower));
    };
    const auto rX = radiusAlong(lowerX, upperX, toX), rY = radiusAlong(lowerY, upperY, toY),
               rZ = radiusAlong(lowerZ, upperZ, toZ);
    const auto radius = hn::Sqrt(dot(rX, rY, rZ, rX, rY, rZ));
    toX = hn::Sub(toX, set(importance.p.x)), toY = hn::Sub(toY, set(importance.p.y)),
    toZ = hn::Sub(toZ, set(importance.p.z));
    const auto distance = coneTo(toX, toY, toZ, radius, cosU, sinU);
    constexpr int kEBits = 16 + LightTreeNode::kTurnBits;
    const auto halfE =
        toFloat(hn::BitCast(kIntTag, hn::ShiftRight<kEBits>(hn::BitCast(hn::RebindToUnsigned<Tag>(), angles))),
                1 / LightTreeNode::kStepsE);
    const auto cosE = hn::NegMulAdd(hn::Add(halfE, halfE), halfE, one);
    const auto cosTheta = hn::Neg(dot(axisX, axisY, axisZ, toX, toY, toZ));
    const auto twoSided = hn::MaskFromVec(hn::BitCast(kTag, hn::BroadcastSignBit(hn::BitCast(kIntTag, countAndSides))));
    estimate = localEstimates(intensity, radius, distance, cosTheta, twoSided, cosO, sinO, cosE, cosU, sinU);
  }
  const Vec3& n = importance.n;
  const auto receiver = receiverCosines(dot(set(n.x), set(n.y), set(n.z), toX, toY, toZ), cosU, sinU);
  // A mirror does not weigh by the cosine: there the lobe's factor has it.
  const auto factor = importance.lobe
                          ? hn::IfThenElseZero(hn::Gt(receiver, zero), lobeFactors(importance, toX, toY, toZ, cosU))
                          : receiver;
  // In double: a large estimate times a sharp lobe leaves the range of a float.
  alignas(16) std::array<float, kLanes> estimates, factors;
  hn::Store(estimate, kTag, estimates.data());
  hn::Store(factor, kTag, factors.data());
  for (std::size_t i = 0; i < kLanes; ++i)
    weights[i] = static_cast<double>(estimates[i]) * static_cast<double>(factors[i]);
}

/// The nodes two levels below one, in the order of their leaves, with their importances; a child that is a light is
/// there itself, and the place beside it has none.
struct Below {
  std::array<NodeId, kLanes> nodes;
  std::array<double, kLanes> weights;
  double sum;

  /// \pre `node` is no leaf
  Below(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance) {
    std::array<bool, 2> light;
    for (std::size_t side = 0; side < 2; ++side) {
      const NodeId child = side == 0 ? tree.left(node) : tree.right(node);
      light[side] = tree.isLeaf(child);
      nodes[2 * side] = light[side] ? child : tree.left(child);
      nodes[2 * side + 1] = light[side] ? child : tree.right(child);
    }
    weigh(tree, distant, nodes, importance, weights);
    if (light[0]) weights[1] = 0;
    if (light[1]) weights[3] = 0;
    sum = weights[0] + weights[1] + weights[2] + weights[3];
  }
};

}  // namespace

std::optional<SampledLeaf> sampleIn(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance,
                                    double u) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const Below below(tree, distant, node, importance);
    if (!(below.sum > 0)) return std::nullopt;
    // Sums in the order of below.sum, and a target below it: what has no weight is not chosen.
    const double target = u * below.sum;
    const double first = below.weights[0], second = first + below.weights[1], third = second + below.weights[2];
    const std::array<double, kLanes> before{0, first, second, third};
    const auto chosen = static_cast<std::size_t>((target >= first) + (target >= second) + (target >= third));
    u = std::clamp((target - before[chosen]) / below.weights[chosen], 0.0, kAlmostOne);
    pmf *= below.weights[chosen] / below.sum;
    node = below.nodes[chosen];
  }
  return SampledLeaf{tree.firstLeaf(node), pmf};
}

double pmfIn(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance, std::uint32_t leaf) {
  double pmf = 1;
  while (!tree.isLeaf(node)) {
    const Below below(tree, distant, node, importance);
    if (!(below.sum > 0)) return 0;
    // A light that takes two places is found at the first.
    std::size_t holder = 0;
    for (std::size_t i = 1; i < kLanes; ++i) {
      if (below.nodes[i] != below.nodes[i - 1] && leaf >= tree.firstLeaf(below.nodes[i])) holder = i;
    }
    pmf *= below.weights[holder] / below.sum;
    node = below.nodes[holder];
  }
  return pmf;
}

double importanceIn(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance) {
  std::array<double, kLanes> weights;
  weigh(tree, distant, {node, node, node, node}, importance, weights);
  return weights[0];
}

}  // namespace cellcut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace cellcut {

HWY_EXPORT(sampleIn);
HWY_EXPORT(pmfIn);
HWY_EXPORT(importanceIn);

double importanceOf(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance) {
  return HWY_DYNAMIC_DISPATCH(importanceIn)(tree, distant, node, importance);
}

std::optional<SampledLeaf> sampleByDescent(const LightTree& tree, bool distant, NodeId node,
                                           const NodeImportance& importance, double u) {
  return HWY_DYNAMIC_DISPATCH(sampleIn)(tree, distant, node, importance, u);
}

double pmfByDescent(const LightTree& tree, bool distant, NodeId node, const NodeImportance& importance,
                    std::uint32_t leaf) {
  return HWY_DYNAMIC_DISPATCH(pmfIn)(tree, distant, node, importance, leaf);
}

TreesDescent::TreesDescent(const LightTrees& trees, const NodeImportance& importance)
    : trees_(trees), importance_(importance) {
  if (!trees.local.empty()) local_ = importanceOf(trees.local, false, trees.local.root(), importance);
  if (kCanHaveDistantLights && !trees.distant.empty())
    distant_ = importanceOf(trees.distant, true, trees.distant.root(), importance);
}

std::optional<SampledLight> TreesDescent::sample(double u) const {
  const double toDistant = distantShare(local_, distant_);
  const bool distant = u < toDistant;
  const double share = distant ? toDistant : 1 - toDistant;
  const LightTree& tree = trees_.of(distant);
  const double rest = std::min((distant ? u : u - toDistant) / share, kAlmostOne);
  const std::optional<SampledLeaf> leaf = sampleByDescent(tree, distant, tree.root(), importance_, rest);
  if (!leaf) return std::nullopt;
  return sampledLight(tree.light(leaf->leaf), share * leaf->pmf);
}

double TreesDescent::pmf(bool distant, std::uint32_t leaf) const {
  const LightTree& tree = trees_.of(distant);
  const double toDistant = distantShare(local_, distant_);
  return (distant ? toDistant : 1 - toDistant) * pmfByDescent(tree, distant, tree.root(), importance_, leaf);
}

}  // namespace cellcut
#endif
