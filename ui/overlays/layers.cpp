#include "ui/overlays/layers.h"

#include <atomic>

namespace cellcut {
namespace {

/// \pre there is a layer "error", of the mean
ImageLayer varianceLayer(const LayeredImage& image, std::uint64_t passes) {
  ImageLayer layer{"variance", {"R", "G", "B"}, {}};
  for (const ImageLayer& error : image.layers) {
    if (error.name == "error") layer.values = error.values;
  }
  for (float& value : layer.values) value *= value * static_cast<float>(passes);
  return layer;
}

float cellId(const CutInspector& inspector, const FirstHit& hit) {
  if (!hit.hit()) return -1;
  const std::optional<CellCoordinates> cell = inspector.cellOf(hit.point.p);
  const glm::ivec3 size = inspector.grid()->resolution();
  if (!cell || cell->coarse || cell->x < 0 || cell->y < 0 || cell->z < 0) return -1;
  if (cell->x >= size.x || cell->y >= size.y || cell->z >= size.z) return -1;
  return static_cast<float>(cell->x + size.x * (cell->y + size.y * cell->z));
}

}  // namespace

LayeredImage layersOf(const Film& film, const LightSampler& sampler, const Image<FirstHit>& firstHits) {
  LayeredImage image = film.layers();
  image.layers.push_back(varianceLayer(image, film.passes()));
  const std::optional<CutInspector> inspector = CutInspector::of(sampler);
  if (!inspector || !inspector->grid()) return image;
  const OverlayInputs inputs{.firstHits = &firstHits, .sampler = &sampler};
  const std::atomic<bool> never{false};
  const auto sizes = *computeOverlay(Overlay::kCutSize, inputs, {film.width(), film.height()}, never);
  ImageLayer cell{"cell", {"id"}, {}}, cut{"cut", {"size"}, {}};
  cell.values.reserve(firstHits.size());
  cut.values.reserve(firstHits.size());
  for (std::size_t i = 0; i < firstHits.size(); ++i) {
    cell.values.push_back(cellId(*inspector, firstHits[i]));
    cut.values.push_back(std::isnan(sizes[i]) ? 0 : sizes[i]);
  }
  image.layers.push_back(std::move(cell));
  image.layers.push_back(std::move(cut));
  return image;
}

}  // namespace cellcut
