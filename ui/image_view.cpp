#include "ui/image_view.h"

#include "ui/gl_error.h"

#include <cassert>
#include <cmath>

#include <epoxy/gl.h>

namespace cellcut {

namespace {

std::size_t indexOf(ImageSlot slot) {
  return static_cast<std::size_t>(slot);
}

/// The whole pixels of `rect` that the framebuffer has. OpenGL counts rows from below.
void setScissor(PixelSize framebuffer, const PixelRect& rect) {
  const auto pixel = [](float position, int most) {
    return static_cast<int>(std::clamp(std::round(position), 0.0f, static_cast<float>(most)));
  };
  const int left = pixel(rect.origin.x, framebuffer.width);
  const int right = pixel(rect.origin.x + rect.size.x, framebuffer.width);
  const int top = pixel(rect.origin.y, framebuffer.height);
  const int bottom = pixel(rect.origin.y + rect.size.y, framebuffer.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(left, framebuffer.height - bottom, std::max(0, right - left), std::max(0, bottom - top));
}

}  // namespace

ImagePlacement fitImage(PixelSize image, const PixelRect& area) {
  const Vec2 size(image.width, image.height);
  const Vec2 ratio = area.size / size;
  const float scale = std::min(ratio.x, ratio.y);
  return {glm::round(area.origin + 0.5f * (area.size - size * scale)), scale};
}

std::optional<glm::ivec2> imagePixelAt(const ImagePlacement& placement, PixelSize image, const Vec2& position) {
  const Vec2 at = placement.toImage(position);
  // Compared as floats: a position far outside would overflow an integer.
  if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(image.width) && at.y < static_cast<float>(image.height)))
    return std::nullopt;
  return glm::ivec2(at);
}

ImageView::ImageView() : program_("image.vert", "image.frag"), vertices_(makeGlVertexArray()) {}

void ImageView::setImage(ImageSlot slot, PixelSize size, std::span<const Vec3> pixels) {
  images_[indexOf(slot)].upload(size, pixels);
}

void ImageView::setImage(ImageSlot slot, const ImageRgb& image) {
  setImage(slot, {image.width(), image.height()}, std::span(image.data(), image.size()));
}

void ImageView::clearImage(ImageSlot slot) {
  images_[indexOf(slot)] = GlTexture();
}

void ImageView::setOverlay(const ImageRgba8& overlay) {
  overlay_.upload(overlay);
}
void ImageView::clearOverlay() {
  overlay_ = GlTexture();
}

void ImageView::draw(PixelSize framebuffer, const PixelRect& clip, const ImagePlacement& placement,
                     const ImageViewSettings& settings) const {
  assert(placement.scale > 0);
  if (images_[0].empty() || framebuffer.empty()) return;
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  setScissor(framebuffer, clip);

  program_.use();
  const GlTexture& b = images_[1].empty() ? images_[0] : images_[1];
  images_[0].bind(0);
  b.bind(1);
  (overlay_.empty() ? images_[0] : overlay_).bind(2);
  program_.set("imageA", 0);
  program_.set("imageB", 1);
  program_.set("overlay", 2);
  program_.set("framebufferHeight", static_cast<float>(framebuffer.height));
  program_.set("origin", placement.origin);
  program_.set("imageSize", Vec2(imageSize().width, imageSize().height));
  program_.set("scale", placement.scale);
  program_.set("gain", std::exp2(settings.exposure));
  program_.set("split", images_[1].empty() ? 1.0f : settings.split);
  program_.set("overlayOpacity", overlay_.empty() ? 0.0f : settings.overlayOpacity);
  program_.set("channel", static_cast<int>(settings.channel));
  program_.set("toneMapped", settings.toneMap ? 1 : 0);

  glBindVertexArray(vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  checkGl("drawing the picture");
}

}  // namespace cellcut
