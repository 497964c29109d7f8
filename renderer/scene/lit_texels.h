/// \file lit_texels.h
/// Whether a part of a picture is black, without a look at every texel each time that it is asked.
#pragma once

#include "renderer/scene/scene.h"

#include <mutex>

namespace cellcut {

/// Texels of one axis, both ends included.
struct TexelRange {
  int first;
  int last;
};

using ColorChannels = std::uint8_t;  ///< 1 red, 2 green, 4 blue, and sums of them

class LitTexels {
 public:
  /// One look at every texel. `texels` must outlive this.
  explicit LitTexels(const ImageRgba8& texels);

  /// True if a texel of the picture, or of a rectangle of it, has one of the channels above 0.
  bool any(ColorChannels channels) const { return channels_ & channels; }
  bool any(TexelRange columns, TexelRange rows, ColorChannels channels) const;

 private:
  const ImageRgba8& texels_;
  Image<ColorChannels> blocks_;  ///< what is above 0 somewhere in each
  ColorChannels channels_ = 0;   ///< what is above 0 anywhere
};

/// Those of a scene's pictures, each made when it is first asked for. Threads: of() may run concurrently.
class LitTexelsOfScene {
 public:
  /// `scene` must outlive this.
  explicit LitTexelsOfScene(const Scene& scene) : scene_(scene), entries_(scene.texels.size()) {}

  const LitTexels& of(TexelsId id);

 private:
  struct Entry {
    std::once_flag made;
    std::optional<LitTexels> lit;
  };
  const Scene& scene_;
  std::vector<Entry> entries_;
};

}  // namespace cellcut
