#include "renderer/sampling/alias_table.h"

#include "renderer/base/rng.h"

#include <algorithm>
#include <numeric>

namespace cellcut {

AliasTable::AliasTable(std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) return;
  const auto n = static_cast<double>(weights.size());
  bins_.resize(weights.size());
  std::vector<double> own(weights.size());
  std::vector<std::uint32_t> under, over;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double pmf = weights[i] / sum;
    own[i] = pmf * n;
    bins_[i] = {0, static_cast<float>(pmf), static_cast<std::uint32_t>(i)};
    (own[i] < 1 ? under : over).push_back(static_cast<std::uint32_t>(i));
  }
  while (!under.empty() && !over.empty()) {
    const std::uint32_t poor = under.back(), rich = over.back();
    under.pop_back();
    bins_[poor].alias = rich;
    own[rich] -= 1 - own[poor];
    if (own[rich] < 1) {
      over.pop_back();
      under.push_back(rich);
    }
  }
  // Rounding leaves some bins a little off 1. A bin without weight must not keep any of itself: its rest goes to the
  // largest.
  const auto largest = static_cast<std::uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const auto& rest : {under, over}) {
    for (const std::uint32_t i : rest) {
      if (weights[i] > 0) {
        own[i] = 1;
      } else {
        bins_[i].alias = largest;
      }
    }
  }
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i].own = static_cast<float>(own[i]);
}

AliasTable::Sample AliasTable::sample(double u) const {
  const double scaled = u * static_cast<double>(bins_.size());
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), bins_.size() - 1);
  const double inBin = scaled - static_cast<double>(i), own = static_cast<double>(bins_[i].own);
  if (inBin < own) return {i, std::min(inBin / own, kAlmostOne)};
  return {bins_[i].alias, std::clamp((inBin - own) / (1 - own), 0.0, kAlmostOne)};
}

}  // namespace cellcut
