/// \file light_tree.h
/// Binary hierarchy over the lights of one group; a cluster is a node, and its lights a contiguous range of leaves.
///
/// Nodes lie in depth-first order: the left child of node i is i + 1, the right child i + 2 · (leaves of the left
/// child), and a node with one leaf is a light. Before node i lie its ancestors and whole subtrees to the left, two
/// nodes per leaf but one: with f leaves to its left and l turns to the left on the way down to it, i = 2 f + l.
///
/// Source: Conty Estevez and Kulla 2018, section 4. Space: metres for local lights; distant lights have no box.
/// Threads: const members may run concurrently.
#pragma once

#include "renderer/base/octahedral.h"
#include "renderer/lights/leaf_sums.h"
#include "renderer/lights/light_bounds.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cellcut {

enum class NodeId : std::uint32_t {};

/// 40 bytes, so that two nodes per light with what belongs to them stay below 120 bytes. descent.cpp reads the members
/// as ten words in this order.
class LightTreeNode {
 public:
  LightTreeNode() = default;
  /// \param leftTurns  on the way down from the root, < 128
  LightTreeNode(const LightBounds& bounds, std::uint32_t leftTurns, std::uint32_t leafCount);

  const Vec3& lower() const { return lower_; }
  const Vec3& upper() const { return upper_; }
  float intensity() const { return intensity_; }
  std::uint32_t leftTurns() const { return sinHalfEAndTurns_ & ((1u << kTurnBits) - 1); }
  std::uint32_t leafCount() const { return leafCountAndSides_ & ~kTwoSided; }
  bool twoSided() const { return (leafCountAndSides_ & kTwoSided) != 0; }
  /// Wider than what was stored by the rounding of 16-bit coordinates, at most 2·10⁻⁴ rad and more only near π.
  Cone axes() const;
  /// θe, rounded up: 90° becomes 90.03°.
  float cosThetaE() const;

  static constexpr int kTurnBits = 7;
  /// Steps of sin(θe/2), of the bits that the turns leave; √½ is 359.92 of them, which loses little by being rounded
  /// up.
  static constexpr float kStepsE = 509;
  static_assert(kStepsE < 1 << (16 - kTurnBits));

 private:
  static constexpr std::uint32_t kTwoSided = 0x80000000u;

  Vec3 lower_, upper_;
  float intensity_;
  std::int16_t axisX_, axisY_;      ///< octahedral
  std::uint16_t sinHalfO_;          ///< sin(θo/2) · 65535, rounded up
  std::uint16_t sinHalfEAndTurns_;  ///< sin(θe/2) · kStepsE, rounded up, above the turns
  std::uint32_t leafCountAndSides_;
};
static_assert(sizeof(LightTreeNode) == 40);

// Inline: every step of a descent asks for them.
inline Cone LightTreeNode::axes() const {
  const float s = static_cast<float>(sinHalfO_) * (1.0f / 65535);
  const Vec2 coded(static_cast<float>(axisX_) * (1.0f / 32767), static_cast<float>(axisY_) * (1.0f / 32767));
  return {fromOctahedral(coded), 1 - 2 * s * s, 2 * s * safeSqrt(1 - s * s)};
}

inline float LightTreeNode::cosThetaE() const {
  const float s = static_cast<float>(sinHalfEAndTurns_ >> kTurnBits) * (1 / kStepsE);
  return 1 - 2 * s * s;
}

class LightTree {
 public:
  /// O(N log N), parallel, the same tree on any number of threads. Lights with intensity 0 have no leaf.
  /// \param bounds   one per light; consecutive ids from `firstId`
  /// \param distant  boxes are ignored: lights are grouped by the direction that they shine in
  LightTree(std::span<const LightBounds> bounds, LightId firstId, bool distant);

  bool empty() const { return leaves_.empty(); }
  std::size_t leafCount() const { return leaves_.size(); }
  NodeId root() const { return NodeId{0}; }
  const LightTreeNode& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  bool isLeaf(NodeId id) const { return node(id).leafCount() == 1; }
  NodeId left(NodeId id) const { return static_cast<NodeId>(static_cast<std::uint32_t>(id) + 1); }
  NodeId right(NodeId id) const {
    return static_cast<NodeId>(static_cast<std::uint32_t>(id) + 2 * node(left(id)).leafCount());
  }

  std::uint32_t firstLeaf(NodeId id) const { return (static_cast<std::uint32_t>(id) - node(id).leftTurns()) / 2; }
  LightId light(std::uint32_t leaf) const { return leaves_[leaf]; }
  /// Leaf of a light of this tree, or kNoLeaf when it has none.
  std::uint32_t leafOf(LightId light) const {
    return leafOfLight_[static_cast<std::uint32_t>(light) - static_cast<std::uint32_t>(firstId_)];
  }
  static constexpr std::uint32_t kNoLeaf = 0xffffffffu;

  /// Chooses a leaf of a node with probability proportional to J: child by child down to a block of LeafSums, and not
  /// by sums over all leaves, in which faint lights beside strong ones are lost.
  /// \param first, count  the node's leaves, which the caller knows: most nodes are in no cache
  /// \param u  uniform in [0, 1)
  SampledLeaf sampleByIntensity(NodeId id, std::uint32_t first, std::uint32_t count, double u) const;
  /// Its probability. \pre the leaf is below the node
  double pmfByIntensity(NodeId id, std::uint32_t leaf) const;

  std::span<const LightTreeNode> nodes() const { return {nodes_.get(), empty() ? 0 : 2 * leafCount() - 1}; }
  int depth() const;
  std::size_t bytes() const;

 private:
  bool isInBlock(NodeId id) const;
  std::uint32_t endOf(NodeId id) const { return firstLeaf(id) + node(id).leafCount(); }
  /// J of each child / J of both. \pre not a leaf
  struct Shares {
    double left, right;
  };
  Shares intensityShares(NodeId id) const;
  void addBlocks(NodeId id, std::span<const float> intensities);

  std::unique_ptr<LightTreeNode[]> nodes_;  ///< no vector: its zeros would touch all of the memory on one thread
  std::vector<LightId> leaves_;             ///< in depth-first order
  std::vector<std::uint32_t> leafOfLight_;
  LeafSums sums_;
  LightId firstId_;
};

}  // namespace cellcut
