#include "tests/support/images.h"

#include "renderer/scene/camera.h"
#include "tests/support/reference.h"
#include "tests/support/statistics.h"

#include <sstream>

#include <gtest/gtest.h>

namespace cellcut::test {

Image<LuminanceEstimate> estimatesOf(const Film& film) {
  const ImageRgb mean = film.mean(), error = film.standardError();
  Image<LuminanceEstimate> result(film.width(), film.height());
  for (std::size_t i = 0; i < result.size(); ++i) {
    // The lights of the tests colour all channels by nearly one pattern, so the channels' errors add up and not their
    // squares: the bound that holds for any correlation.
    const double sigma = luminance(glm::dvec3(error[i]));
    result[i] = {luminance(glm::dvec3(mean[i])), sigma * sigma};
  }
  return result;
}

ImageRgb renderPasses(Renderer& renderer, std::size_t passes) {
  for (std::size_t i = 0; i < passes; ++i) EXPECT_TRUE(renderer.renderPass(kNever));
  return renderer.film().mean();
}

Image<LuminanceEstimate> renderEstimates(const Scene& scene, RenderSettings settings, std::size_t passes) {
  settings.sampling = PixelSampling::kIndependent;
  settings.auxiliary = false;
  Renderer renderer(scene, settings);
  renderPasses(renderer, passes);
  return estimatesOf(renderer.film());
}

Film renderPasses(const PathContext& context, glm::ivec2 size, std::size_t passes, std::uint64_t seed,
                  PathCounts& counts, PixelSampling sampling) {
  Film film(size.x, size.y, context.auxiliary);
  for (std::size_t pass = 0; pass < passes; ++pass) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        PixelSampler random(sampling, seed, x, y, pass);
        const Sample4 position = random.next();
        const Ray ray = cameraRay(context.scene.cameras[0], Vec2(x, y) + Vec2(position[0], position[1]), size);
        film.record(x, y, tracePath(context, ray, random, counts));
      }
    }
    film.commit();
  }
  return film;
}

Image<LuminanceEstimate> referenceEstimates(const Scene& scene, const RenderSettings& settings, std::size_t passes) {
  const Accel accel(scene);
  const ReferenceTracer tracer(scene, accel);
  Image<LuminanceEstimate> result(settings.width, settings.height);
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      Rng random(hashOf(settings.seed, x, y, 77));
      Moments moments;
      for (std::size_t i = 0; i < passes; ++i) {
        const Vec2 film(static_cast<float>(x) + random.uniform(), static_cast<float>(y) + random.uniform());
        const Ray ray = cameraRay(scene.cameras[settings.camera], film, {settings.width, settings.height});
        moments.add(static_cast<double>(luminance(tracer.trace(ray, settings.maxDepth, random))));
      }
      result.at(x, y) = {moments.mean(), moments.meanVariance()};
    }
  }
  return result;
}

std::vector<LuminanceEstimate> tilesOf(const Image<LuminanceEstimate>& image, int tilesPerSide) {
  const int width = image.width() / tilesPerSide, height = image.height() / tilesPerSide;
  const double pixels = static_cast<double>(width) * height;
  std::vector<LuminanceEstimate> tiles(static_cast<std::size_t>(tilesPerSide) * static_cast<std::size_t>(tilesPerSide));
  for (int y = 0; y < height * tilesPerSide; ++y) {
    for (int x = 0; x < width * tilesPerSide; ++x) {
      const auto row = static_cast<std::size_t>(y / height), column = static_cast<std::size_t>(x / width);
      LuminanceEstimate& tile = tiles[row * static_cast<std::size_t>(tilesPerSide) + column];
      tile.mean += image.at(x, y).mean / pixels;
      tile.variance += image.at(x, y).variance / (pixels * pixels);
    }
  }
  return tiles;
}

std::string difference(const Image<LuminanceEstimate>& a, const Image<LuminanceEstimate>& b, std::size_t comparisons) {
  constexpr int kTiles = 8;
  std::ostringstream text;
  int compared = 0;
  // A dark tile that lives of a few bright paths is no normal variable: mean and error go together, and |z| is too
  // large too often. 1,000 equally bright paths have this relative error; the picture as a whole has many more.
  const auto fewHits = [](const LuminanceEstimate& e) { return e.mean * e.mean < 1000 * e.variance; };
  const auto compare = [&](const std::vector<LuminanceEstimate>& as, const std::vector<LuminanceEstimate>& bs,
                           const char* what) {
    const double limit = criticalZ(as.size() * comparisons);
    for (std::size_t i = 0; i < as.size(); ++i) {
      if (as.size() > 1 && (fewHits(as[i]) || fewHits(bs[i]))) continue;
      ++compared;
      const double z = zScore(as[i].mean, as[i].variance, bs[i].mean, bs[i].variance);
      if (std::abs(z) <= limit) continue;
      text << what << " " << i << ": " << as[i].mean << " against " << bs[i].mean << ", z = " << z << " beyond "
           << limit << "\n";
    }
  };
  compare(tilesOf(a, kTiles), tilesOf(b, kTiles), "tile");
  if (4 * compared < kTiles * kTiles) text << "only " << compared << " tiles have enough paths to be compared\n";
  compare(tilesOf(a, 1), tilesOf(b, 1), "picture");
  return text.str();
}

}  // namespace cellcut::test
