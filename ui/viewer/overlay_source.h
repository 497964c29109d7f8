/// \file overlay_source.h
/// Overlays and inspections of a running session, made on the session's own thread so that the UI never waits.
#pragma once

#include "renderer/trace/session.h"
#include "ui/overlays/cell_inspector.h"
#include "ui/overlays/layers.h"
#include "ui/overlays/wireframe.h"
#include "ui/viewer/viewer_state.h"

#include <future>
#include <memory>
#include <optional>

namespace cellcut {

/// What is drawn over a picture, and the numbers behind it.
struct OverlayPicture {
  std::uint64_t generation = 0;  ///< of the session's edit that it belongs to
  Overlay overlay = Overlay::kNone;
  std::string_view title;  ///< of the values: which of two the overlay of errors shows
  Image<float> values;     ///< empty without an overlay
  OverlayStatistics statistics;
  std::optional<TouchedCells> touched;
  ImageRgba8 lines;            ///< wireframe, transparent elsewhere; empty without lines
  std::optional<float> slice;  ///< where the plane lies on its axis, metres
  std::optional<PixelReport> inspection;
  std::size_t lightCount = 0;  ///< of the scene
};

/// At most one request is on its way. Threads: one (the UI's).
class OverlaySource {
 public:
  OverlaySource();

  /// Asks for a new one unless a request is on its way. An edit of the session stops it.
  /// \param reference  may be null
  void request(RenderSession& session, const OverlayChoice& choice, std::optional<glm::ivec2> pick,
               const std::shared_ptr<const ImageRgb>& reference);
  /// The rendering as layersOf(). An edit waits for it: a file that was asked for is written. The future is broken when
  /// there is no picture.
  std::future<LayeredImage> layers(RenderSession& session) const;
  /// What came in since the last call; nothing came of a request that was stopped.
  std::optional<OverlayPicture> take();
  bool busy() const { return pending_.valid(); }
  /// Whether take() has one.
  bool ready() const;
  /// Until the request is answered: for scripts and screenshots.
  void wait() const;

 private:
  struct Cache;
  std::shared_ptr<Cache> cache_;  ///< touched by the session's thread only
  std::future<std::optional<OverlayPicture>> pending_;
};

}  // namespace cellcut
