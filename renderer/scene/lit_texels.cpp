#include "renderer/scene/lit_texels.h"

namespace cellcut {
namespace {

/// Texels per side of a block: a picture has a thousand times as many texels as blocks, and a block is searched in less
/// than a microsecond.
constexpr int kBlockSize = 32;

ColorChannels litChannels(const ImageRgba8::value_type& texel) {
  return static_cast<ColorChannels>((texel.x ? 1 : 0) | (texel.y ? 2 : 0) | (texel.z ? 4 : 0));
}

/// What of the range lies in a block.
TexelRange clipped(const TexelRange& range, int block) {
  return {std::max(range.first, block * kBlockSize), std::min(range.last, block * kBlockSize + kBlockSize - 1)};
}

}  // namespace

LitTexels::LitTexels(const ImageRgba8& texels)
    : texels_(texels),
      blocks_((texels.width() + kBlockSize - 1) / kBlockSize, (texels.height() + kBlockSize - 1) / kBlockSize) {
  for (int y = 0; y < texels.height(); ++y) {
    for (int x = 0; x < texels.width(); ++x) blocks_.at(x / kBlockSize, y / kBlockSize) |= litChannels(texels.at(x, y));
  }
  for (const ColorChannels block : blocks_) channels_ |= block;
}

bool LitTexels::any(TexelRange columns, TexelRange rows, ColorChannels channels) const {
  if (!any(channels)) return false;
  for (int v = rows.first / kBlockSize; v <= rows.last / kBlockSize; ++v) {
    for (int u = columns.first / kBlockSize; u <= columns.last / kBlockSize; ++u) {
      if (!(blocks_.at(u, v) & channels)) continue;
      const TexelRange xs = clipped(columns, u), ys = clipped(rows, v);
      for (int y = ys.first; y <= ys.last; ++y) {
        for (int x = xs.first; x <= xs.last; ++x) {
          if (litChannels(texels_.at(x, y)) & channels) return true;
        }
      }
    }
  }
  return false;
}

const LitTexels& LitTexelsOfScene::of(TexelsId id) {
  Entry& entry = entries_[indexOf(id)];
  std::call_once(entry.made, [&] { entry.lit.emplace(scene_.texels[indexOf(id)]); });
  return *entry.lit;
}

}  // namespace cellcut
