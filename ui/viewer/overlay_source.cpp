#include "ui/viewer/overlay_source.h"

#include "renderer/scene/camera.h"
#include "ui/viewer/is_ready.h"

#include <atomic>

namespace cellcut {
/// First hits change with the view alone: kept from overlay to overlay.
struct OverlaySource::Cache {
  std::weak_ptr<const Scene> scene;  ///< its address may be another scene's later
  Camera camera;
  glm::ivec2 size{0};
  Image<FirstHit> hits;

  /// Nothing if it was stopped.
  const Image<FirstHit>* of(const SessionView& view, const std::atomic<bool>& cancel) {
    const Camera& now = viewOf(*view.scene, view.settings);
    const glm::ivec2 wanted(view.settings.width, view.settings.height);
    if (scene.lock() == view.scene && size == wanted && isSameView(camera, now)) return &hits;
    std::optional<Image<FirstHit>> traced = traceFirstHits(*view.scene, view.accel, now, wanted, cancel);
    if (!traced) return nullptr;
    scene = view.scene;
    camera = now;
    size = wanted;
    hits = std::move(*traced);
    return &hits;
  }
};

namespace {

/// Shadow rays per light and side of a square for the truth by brute force: about two million rays, a second or two.
int samplesPerSide(std::size_t lights) {
  return std::clamp(static_cast<int>(std::sqrt(2e6 / static_cast<double>(std::max<std::size_t>(lights, 1)))), 1, 8);
}

bool isOfCells(Overlay overlay) {
  return overlay >= Overlay::kTouched && overlay <= Overlay::kTreeDepth;
}

ImageRgba8 drawLines(const SessionView& view, const Image<FirstHit>& hits, const OverlayChoice& choice,
                     const PixelReport* inspection) {
  constexpr Rgba8 kCells(255, 255, 255, 110), kPickedCell(255, 200, 40, 255), kSlice(255, 255, 255, 60);
  constexpr std::uint8_t kClusterAlpha = 200;
  std::vector<Segment> segments;
  const auto inspector = CutInspector::of(view.sampler);
  if (choice.grid && inspector) segments = touchedCellSegments(*inspector, kCells);
  if (choice.slice.axis != SliceAxis::kNone && inspector && inspector->grid()) {
    const std::vector<Segment> plane = sliceSegments(choice.slice, *inspector->grid(), kSlice);
    segments.insert(segments.end(), plane.begin(), plane.end());
  }
  if (inspection) {
    std::vector<ClusterInspection> clusters;
    for (const ClusterRow& row : inspection->clusters) clusters.push_back(row.cluster);
    const float pointSize = 0.01f * view.scene->bounds.radius();
    const std::vector<Segment> boxes =
        clusterSegments(clusters, probabilityScale(clusters, Colormap::kViridis), kClusterAlpha, pointSize);
    segments.insert(segments.end(), boxes.begin(), boxes.end());
    appendBox(segments, inspection->cellBox, kPickedCell);
  }
  if (segments.empty()) return {};
  ImageRgba8 lines(hits.width(), hits.height());
  drawSegments(lines, depthOf(hits), viewOf(*view.scene, view.settings), segments);
  return lines;
}

/// Nothing if it was stopped.
std::optional<OverlayPicture> makePicture(const SessionView& view, const Image<FirstHit>& hits,
                                          const OverlayChoice& choice, std::optional<glm::ivec2> pick,
                                          const ImageRgb* reference) {
  const bool ofMean = choice.overlay == Overlay::kError && !reference;
  OverlayPicture picture{.generation = view.generation,
                         .overlay = choice.overlay,
                         .title = ofMean ? "standard error of the mean" : describe(choice.overlay).title};
  picture.lightCount = view.lights.size();
  const Camera& camera = viewOf(*view.scene, view.settings);
  const glm::ivec2 size(view.settings.width, view.settings.height);
  OverlayInputs inputs{.firstHits = &hits,
                       .sampler = &view.sampler,
                       .passes = view.film.passes(),
                       .reference = reference,
                       .badSamples = &view.film.badSampleCounts()};
  ImageRgb mean, error;
  if (pick || choice.overlay == Overlay::kVariance || choice.overlay == Overlay::kError) {
    mean = view.film.mean();
    if (view.cancel) return std::nullopt;
    error = view.film.standardError();
    inputs.mean = &mean;
    inputs.standardError = &error;
  }
  std::optional<Image<FirstHit>> plane;
  const auto inspector = CutInspector::of(view.sampler);
  if (choice.slice.axis != SliceAxis::kNone && inspector && inspector->grid()) {
    picture.slice = coordinateOf(choice.slice, *inspector->grid());
    if (isOfCells(choice.overlay)) {
      plane = sliceHits(choice.slice, *inspector->grid(), camera, hits, view.cancel);
      if (!plane) return std::nullopt;
      inputs.firstHits = &*plane;
      inputs.everyCell = true;
    }
  }
  if (choice.overlay != Overlay::kNone) {
    std::optional<Image<float>> values = computeOverlay(choice.overlay, inputs, size, view.cancel);
    if (!values) return std::nullopt;
    picture.values = std::move(*values);
    picture.statistics = statisticsOf(picture.values);
  }
  picture.touched = touchedCells(view.sampler);
  if (pick && pick->x >= 0 && pick->y >= 0 && pick->x < size.x && pick->y < size.y) {
    const InspectionInputs looked{.scene = *view.scene,
                                  .accel = view.accel,
                                  .lights = view.lights,
                                  .sampler = view.sampler,
                                  .camera = camera,
                                  .size = size,
                                  .mean = &mean,
                                  .standardError = &error,
                                  .passes = view.film.passes()};
    picture.inspection = inspectPixel(looked, *pick, samplesPerSide(view.lights.size()), view.cancel);
    if (!picture.inspection) return std::nullopt;
  }
  picture.lines = drawLines(view, hits, choice, picture.inspection ? &*picture.inspection : nullptr);
  return picture;
}

}  // namespace

OverlaySource::OverlaySource() : cache_(std::make_shared<Cache>()) {}

void OverlaySource::request(RenderSession& session, const OverlayChoice& choice, std::optional<glm::ivec2> pick,
                            const std::shared_ptr<const ImageRgb>& reference) {
  if (busy()) return;
  pending_ = session.inspect([cache = cache_, choice, pick, reference](const SessionView& view) {
    const Image<FirstHit>* hits = cache->of(view, view.cancel);
    return hits ? makePicture(view, *hits, choice, pick, reference.get()) : std::nullopt;
  });
}

std::future<LayeredImage> OverlaySource::layers(RenderSession& session) const {
  return session.inspect([cache = cache_](const SessionView& view) {
    const std::atomic<bool> never{false};
    return layersOf(view.film, view.sampler, *cache->of(view, never));
  });
}

bool OverlaySource::ready() const {
  return isReady(pending_);
}

std::optional<OverlayPicture> OverlaySource::take() {
  if (!ready()) return std::nullopt;
  return pending_.get();
}

void OverlaySource::wait() const {
  if (busy()) pending_.wait();
}

}  // namespace cellcut
