/// \file image_view.h
/// Shows a rendering: exposure, tone map and channel of one or two HDR pictures, and an overlay upon them.
#pragma once

#include "renderer/base/image.h"
#include "renderer/base/image_io.h"
#include "ui/gl_handle.h"
#include "ui/gl_program.h"
#include "ui/gl_texture.h"
#include "ui/pixel_size.h"

#include <optional>
#include <span>

namespace cellcut {

/// Where a picture lies on the framebuffer. Image pixel (i, j) covers [i, i + 1) × [j, j + 1), from the top left.
struct ImagePlacement {
  Vec2 origin{0};   ///< framebuffer position of the picture's top left corner
  float scale = 1;  ///< framebuffer pixels per image pixel; > 0

  Vec2 toImage(const Vec2& framebufferPosition) const { return (framebufferPosition - origin) / scale; }
  Vec2 toFramebuffer(const Vec2& imagePosition) const { return origin + imagePosition * scale; }
};

/// The largest picture that fits into `area`, centred, its corner on a whole pixel; 1:1 if the sizes are equal.
/// \pre neither is empty
ImagePlacement fitImage(PixelSize image, const PixelRect& area);

/// The image pixel under a framebuffer position; nothing outside the picture.
std::optional<glm::ivec2> imagePixelAt(const ImagePlacement& placement, PixelSize image, const Vec2& position);

enum class ImageChannel { kRgb, kRed, kGreen, kBlue, kLuminance };
/// Which of the two pictures.
enum class ImageSlot { kA, kB };

struct ImageViewSettings {
  float exposure = 0;                         ///< EV: the picture is multiplied by 2^exposure
  bool toneMap = true;                        ///< toneMap() of tone_map.h, else sRGB clipped at 1
  ImageChannel channel = ImageChannel::kRgb;  ///< one channel, or Rec. 709 luminance, is shown as grey
  float overlayOpacity = 1;                   ///< [0, 1], times the overlay's own alpha
  float split = 1;  ///< A is shown left of this share of the picture's width, B right of it; [0, 1]. 1 while B is empty
};

/// \pre the window's context is current, in every member. The two pictures may differ in size: B is stretched over A.
class ImageView {
 public:
  /// \throws GlError if a shader does not compile
  ImageView();

  /// \pre pixels.size() = size.width · size.height; linear Rec. 709
  void setImage(ImageSlot slot, PixelSize size, std::span<const Vec3> pixels);
  void setImage(ImageSlot slot, const ImageRgb& image);
  void clearImage(ImageSlot slot);
  /// sRGB-encoded colour and straight alpha, stretched over the picture; magnified as squares.
  void setOverlay(const ImageRgba8& overlay);
  void clearOverlay();

  /// Of A; empty before the first setImage.
  PixelSize imageSize() const { return images_[0].size(); }

  /// Draws into the bound framebuffer of that size: the picture within `clip`, nothing beside it. From 1:1 up each
  /// pixel is a square, below it is a mean over its area. Nothing while A is empty.
  void draw(PixelSize framebuffer, const PixelRect& clip, const ImagePlacement& placement,
            const ImageViewSettings& settings) const;

 private:
  GlProgram pictureProgram_;
  GlProgram overlayProgram_;
  GlVertexArrayHandle vertices_;
  GlTexture images_[2];
  GlTexture overlay_;
};

}  // namespace cellcut
