/// \file light_mask.h
/// Which lights are shown: what one light, or all but some, contribute to a picture.
///
/// The strategy chooses as if all were there, and the light of the others counts as none: unbiased for the lights that
/// are shown, with the noise of being chosen as rarely as before. What a camera ray meets itself is always shown.
#pragma once

#include "renderer/lights/lights.h"

#include <utility>
#include <vector>

namespace cellcut {

class LightMask {
 public:
  /// \param shown  by LightId; lights past its end are shown
  explicit LightMask(std::vector<bool> shown) : shown_(std::move(shown)) {}

  bool shows(LightId light) const {
    const auto i = static_cast<std::size_t>(light);
    return i >= shown_.size() || shown_[i];
  }
  const std::vector<bool>& shown() const { return shown_; }

 private:
  std::vector<bool> shown_;
};

}  // namespace cellcut
