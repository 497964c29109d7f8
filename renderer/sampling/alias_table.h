/// \file alias_table.h
/// Constant-time sampling of a discrete distribution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {

/// Source: Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given Distribution"; pbrt 4th ed.
/// section A.1.
class AliasTable {
 public:
  /// \param weights  ≥ 0 and finite, with a finite sum; all zero or none: an empty distribution
  explicit AliasTable(std::span<const double> weights);

  bool empty() const { return bins_.empty(); }
  struct Sample {
    std::size_t index;  ///< its weight is > 0
    double rest;        ///< uniform in [0, 1) and independent of the index
  };
  /// \param u  in [0, 1) \pre !empty()
  Sample sample(double u) const;
  float pmf(std::size_t i) const { return empty() ? 0.0f : bins_[i].pmf; }
  std::size_t bytes() const { return bins_.capacity() * sizeof(Bin); }

 private:
  struct Bin {
    float own;  ///< share of the bin that is its own
    float pmf;
    std::uint32_t alias;  ///< who has the rest
  };
  std::vector<Bin> bins_;
};

}  // namespace cellcut
