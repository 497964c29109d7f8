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

ImageView::ImageView()
    : pictureProgram_("image.vert", {"picture.frag", "texel.frag"}),
      overlayProgram_("image.vert", {"overlay.frag", "texel.frag"}),
      vertices_(makeGlVertexArray()) {}

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
  setScissor(framebuffer, clip);
  glBindVertexArray(vertices_.name());

  // One image at a time: OpenGL by software looks up all images that a shader has a branch for.
  const auto drawColumns = [&](const GlProgram& program, const GlTexture& image, const Vec2& columns) {
    if (columns.x >= columns.y) return;
    image.bind(0);
    program.set("image", 0);
    program.set("framebufferHeight", static_cast<float>(framebuffer.height));
    program.set("origin", placement.origin);
    program.set("imageSize", Vec2(imageSize().width, imageSize().height));
    program.set("scale", placement.scale);
    program.set("columns", columns);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  };
  pictureProgram_.use();
  pictureProgram_.set("gain", std::exp2(settings.exposure));
  pictureProgram_.set("channel", static_cast<int>(settings.channel));
  pictureProgram_.set("toneMapped", settings.toneMap ? 1 : 0);
  const float split = images_[1].empty() ? 1 : settings.split;
  drawColumns(pictureProgram_, images_[0], {0, split});
  drawColumns(pictureProgram_, images_[1], {split, 1});
  if (!overlay_.empty() && settings.overlayOpacity > 0) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    overlayProgram_.use();
    overlayProgram_.set("opacity", settings.overlayOpacity);
    drawColumns(overlayProgram_, overlay_, {0, split});
    glBlendFunc(GL_ONE, GL_ZERO);
    glDisable(GL_BLEND);
  }

  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  checkGl("drawing the picture");
}

}  // namespace cellcut
