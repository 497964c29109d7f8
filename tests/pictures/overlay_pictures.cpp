// Writes every overlay of a small `rooms`, its wireframes and an inspected pixel into a folder, to be looked at.
//
//     overlay_pictures FOLDER [PIXEL_X PIXEL_Y]

#include "renderer/base/tone_map.h"
#include "tests/support/frozen_render.h"
#include "tests/support/recipe_scene.h"
#include "ui/overlays/cell_inspector.h"
#include "ui/overlays/color_scale.h"
#include "ui/overlays/overlay.h"
#include "ui/overlays/wireframe.h"

#include <filesystem>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

namespace cellcut::test {
namespace {

constexpr glm::ivec2 kSize(480, 270);

/// The picture as the viewer shows it.
ImageRgba8 shown(const ImageRgb& radiance) {
  ImageRgba8 image(radiance.width(), radiance.height());
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = Rgba8(255.0f * toneMap(radiance[i]) + 0.5f, 255);
  return image;
}

class Pictures {
 public:
  Pictures(const Scene& scene, std::filesystem::path folder)
      : folder_(std::move(folder)), run_(scene, {.size = kSize, .passes = 4, .sampler = {.countVisits = true}}) {}

  void writeOverlays() const {
    const OverlayInputs inputs{
        .firstHits = &hits_, .sampler = run_.sampler.get(), .mean = &mean_, .standardError = &error_, .passes = 4};
    for (const OverlayName& o : kOverlays) {
      const Image<float> values = *computeOverlay(o.overlay, inputs, kSize, kNever);
      for (const ScaleKind kind : {ScaleKind::kLinear, ScaleKind::kLog}) {
        const ColorScale scale(values, {.kind = kind});
        ImageRgba8 image = shown(mean_);
        const ImageRgba8 colours = colorize(values, scale, 0.8f);
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = over(image[i], colours[i]);
        write(std::string(o.name) + (kind == ScaleKind::kLog ? "-log" : ""), image);
        describe(o, values, makeLegend(scale, o.title, o.unit, o.integral));
      }
    }
    const std::optional<TouchedCells> cells = touchedCells(*run_.sampler);
    std::cout << "touched " << cells->inside << " of " << cells->all << " (" << 100 * cells->share() << " %), "
              << cells->outside << " outside\n";
  }

  void writeWireframes(glm::ivec2 pixel) const {
    const Image<float> depth = depthOf(hits_);
    ImageRgba8 grid = shown(mean_);
    drawSegments(grid, depth, run_.camera(),
                 touchedCellSegments(*CutInspector::of(*run_.sampler), {255, 255, 255, 160}));
    write("grid", grid);

    const InspectionInputs inputs{run_.scene, run_.accel, run_.lights, *run_.sampler, run_.camera(), kSize, &mean_,
                                  &error_,    4};
    const PixelReport report = *inspectPixel(inputs, pixel, 4, kNever);
    std::vector<ClusterInspection> clusters;
    for (const ClusterRow& row : report.clusters) clusters.push_back(row.cluster);
    std::vector<Segment> segments = clusterSegments(clusters, probabilityScale(clusters, Colormap::kTurbo), 255, 0.1f);
    appendBox(segments, report.cellBox, {255, 0, 255, 255});
    ImageRgba8 image = shown(mean_);
    drawSegments(image, depth, run_.camera(), segments);
    write("clusters", image);
    ImageRgba8 through = shown(mean_);
    drawSegments(through, Image<float>(kSize.x, kSize.y, kInfinity), run_.camera(), segments);
    write("clusters-through", through);
    std::ofstream(folder_ / "pixel.json") << toJson(report).dump(2) << '\n';
  }

 private:
  void write(const std::string& name, const ImageRgba8& image) const {
    writeFileAtomically(folder_ / (name + ".png"), encodePng(image));
  }
  static void describe(const OverlayName& o, const Image<float>& values, const Legend& legend) {
    const OverlayStatistics s = statisticsOf(values);
    std::cout << o.name << ": " << s.count << " values, " << s.minimum << " .. " << s.maximum << ", mean " << s.mean
              << "; legend \"" << legend.title << "\" [" << legend.unit << "]:";
    for (const LegendTick& tick : legend.ticks) std::cout << ' ' << tick.label;
    std::cout << '\n';
  }

  std::filesystem::path folder_;
  FrozenRender run_;
  Image<FirstHit> hits_ = *traceFirstHits(run_.scene, run_.accel, run_.camera(), kSize, kNever);
  ImageRgb mean_ = run_.film.mean(), error_ = run_.film.standardError();
};

}  // namespace
}  // namespace cellcut::test

int main(int argc, char** argv) {
  using namespace cellcut;
  if (argc != 2 && argc != 4) {
    std::cerr << "usage: overlay_pictures FOLDER [PIXEL_X PIXEL_Y]\n";
    return 2;
  }
  std::filesystem::create_directories(argv[1]);
  const Scene scene = test::recipeScene(Recipe::kRooms, 4000);
  const test::Pictures pictures(scene, argv[1]);
  pictures.writeOverlays();
  pictures.writeWireframes(argc == 4 ? glm::ivec2(std::stoi(argv[2]), std::stoi(argv[3])) : glm::ivec2(240, 180));
  return 0;
}
