/// \file cell_grid.h
/// The regular grid of cubic cells, and a table of what was made of the cells that were touched.
///
/// Cells are addressed by integer coordinates and hashed, so that only touched cells take memory and space has no
/// border. The first thread that asks for a cell makes it; others that ask meanwhile wait for that one cell; there is
/// no global lock. What is made is never changed.
///
/// They come in two sizes. Later vertices of paths have coarse cells, for paths scatter into many places, and in each a
/// light is asked for seldom: fine cells would cost more time in the making and in missed caches than they save noise.
/// Coarse are also those far from what is mostly seen, towards a horizon, where few pixels share one.
#pragma once

#include "renderer/sampling/cut.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cellcut {

struct CellCoordinates {
  std::int32_t x, y, z;  ///< in cells of its size
  bool coarse = false;
  bool operator==(const CellCoordinates&) const = default;
};

/// Where the cells lie.
class GridGeometry {
 public:
  /// \param box         of the points that the scene is mostly shaded at; empty or flat boxes are valid
  /// \param resolution  cells along its longest axis, ≥ 1
  GridGeometry(const Bounds& box, int resolution);

  /// The cell that a light for `p` is chosen from, coarse for indirect and for remote points. Nothing for points beyond
  /// 2²⁰ cells from the box on any axis, and for points that are not finite.
  std::optional<CellCoordinates> cellOf(const Vec3& p, bool indirect = false) const;
  /// A sphere around all float points of a cell, rounding included.
  Region region(const CellCoordinates& cell) const;
  /// The cube itself, its corners rounded to floats. Neighbours share their corners exactly.
  Bounds box(const CellCoordinates& cell) const;
  /// Whether a coarse cell lies farther from the box than a quarter of its longest axis: it has all of its points for
  /// itself. The others share theirs with fine cells.
  bool isRemote(const CellCoordinates& coarse) const;
  /// Of the fine cells, metres.
  double cellSize() const { return size_; }
  /// Fine cells that cover the box, per axis.
  glm::ivec3 resolution() const { return resolution_; }

 private:
  double sizeOf(const CellCoordinates& cell) const;
  glm::dvec3 corner(const CellCoordinates& cell, double step) const;

  glm::dvec3 origin_;
  double size_;
  double inverseSize_;
  glm::ivec3 resolution_;
  glm::ivec3 coarseShift_;  ///< fine cells from the lower corner of coarse cell 0 to that of the fine one
};

/// What the cut of a cell is found with: a coarse cell gets a quarter of the clusters.
CutSettings cutSettingsOf(const SamplerSettings& settings, const CellCoordinates& cell);

/// Corners of the middle of a cloud of points: per axis from its 5 % to its 95 % quantile, so that the horizon seen
/// from a house does not stretch the house's cells. Empty for no points.
Bounds centralBox(std::span<const Vec3> points);

/// Cuts by cell. Threads: every member may run concurrently, but the destructor.
class CellTable {
 public:
  /// \param maxBytes  for cuts and for the table itself; beyond it cells are not kept
  explicit CellTable(std::size_t maxBytes);
  ~CellTable();
  CellTable(const CellTable&) = delete;
  CellTable& operator=(const CellTable&) = delete;

  /// The cell's cut: found, or made by `make` once for all threads. Null when the memory is used up: the caller makes
  /// its own.
  /// \throws what `make` throws, but for std::bad_alloc, which is no room; the cell is not asked for again.
  const Cut* findOrMake(const CellCoordinates& cell, const std::function<Cut()>& make);
  /// Takes memory for something that belongs to a kept cut; false when half of the table's share is used up.
  bool reserve(std::size_t bytes);
  /// Gives back what was reserved and is not used after all.
  void release(std::size_t bytes) {
    reserved_.fetch_sub(bytes, std::memory_order_relaxed);
    bytes_.fetch_sub(bytes, std::memory_order_relaxed);
  }
  /// The cell's cut if it was made.
  const Cut* find(const CellCoordinates& cell) const;

  /// Calls `visit` for each cell that was made, in no order; those that are being made meanwhile may be left out.
  void forEach(const std::function<void(const CellCoordinates&, const Cut&)>& visit) const;
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Slot {
    std::atomic<std::uint64_t> key;
    std::atomic<const Cut*> cut;
  };
  /// Makes the cut of a slot that this thread has taken, and wakes those that wait for it.
  const Cut* fill(Slot& slot, const std::function<Cut()>& make);

  std::size_t maxBytes_;
  std::vector<Slot> slots_;  ///< open addressing, a power of two
  std::atomic<std::size_t> bytes_;
  std::atomic<std::size_t> reserved_{0};  ///< of these, by reserve()
};

}  // namespace cellcut
