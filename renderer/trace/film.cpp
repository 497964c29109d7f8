#include "renderer/trace/film.h"

#include "renderer/base/relative_error.h"

#include <atomic>

#include <oneapi/tbb/parallel_for.h>

namespace cellcut {
namespace {

using DVec3 = glm::dvec3;

std::vector<float> interleaved(const ImageRgb& image) {
  std::vector<float> values;
  values.reserve(image.size() * 3);
  for (const Vec3& v : image) {
    for (int c = 0; c < 3; ++c) values.push_back(v[c]);
  }
  return values;
}

}  // namespace

Film::Film(int width, int height, bool auxiliary)
    : sums_(width, height), pendingRadiance_(width, height), badCounts_(width, height) {
  if (auxiliary) {
    auxiliary_ = Image<Auxiliary>(width, height);
    pendingAuxiliary_ = Image<PendingAuxiliary>(width, height);
  }
}

void Film::record(int x, int y, const PathSample& sample) {
  pendingRadiance_.at(x, y) = sample.radiance;
  if (!auxiliary_.empty()) pendingAuxiliary_.at(x, y) = {sample.albedo, sample.normal, sample.depth};
}

void Film::commit() {
  tbb::parallel_for(0, height(), [&](int y) { commitRow(y); });
  finishCommit();
}

void Film::commitRow(int y) {
  const auto n = static_cast<double>(passes_ + 1);
  const bool first = passes_ == 0;  // what lies there may be from before clear()
  for (int x = 0; x < width(); ++x) {
    Vec3 radiance = pendingRadiance_.at(x, y);
    if (!isFinite(radiance)) {
      const bool isNan = std::isnan(radiance.x) || std::isnan(radiance.y) || std::isnan(radiance.z);
      std::atomic_ref(isNan ? bad_.nan : bad_.inf).fetch_add(1, std::memory_order_relaxed);
      std::uint16_t& count = badCounts_.at(x, y);
      if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
      radiance = Vec3(0);
    }
    Sums& sums = sums_.at(x, y);
    if (first) sums = {};
    const DVec3 before = DVec3(radiance) - sums.mean;
    sums.mean += before / n;
    sums.squares += before * (DVec3(radiance) - sums.mean);
    if (!auxiliary_.empty()) {
      Auxiliary& auxiliary = auxiliary_.at(x, y);
      if (first) auxiliary = {};
      const PendingAuxiliary& pending = pendingAuxiliary_.at(x, y);
      auxiliary.albedo += (DVec3(pending.albedo) - auxiliary.albedo) / n;
      auxiliary.normal += (DVec3(pending.normal) - auxiliary.normal) / n;
      auxiliary.depth += (static_cast<double>(pending.depth) - auxiliary.depth) / n;
    }
  }
}

void Film::clear() {
  passes_ = 0;
  bad_ = {};
  std::fill(badCounts_.begin(), badCounts_.end(), std::uint16_t{0});
}

ImageRgb Film::mean() const {
  ImageRgb image(width(), height());
  if (passes_ == 0) return image;
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = Vec3(sums_[i].mean);
  return image;
}

DVec3 Film::errorOf(const Sums& sums) const {
  const auto n = static_cast<double>(passes_);
  return glm::sqrt(sums.squares / (n * (n - 1)));
}

ImageRgb Film::standardError() const {
  ImageRgb image(width(), height());
  if (passes_ < 2) return image;
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = Vec3(errorOf(sums_[i]));
  return image;
}

double Film::relativeError() const {
  if (passes_ < 2) return std::numeric_limits<double>::infinity();
  double mean = 0;
  for (const Sums& sums : sums_) mean += (sums.mean.x + sums.mean.y + sums.mean.z) / 3;
  mean /= static_cast<double>(sums_.size());
  if (mean == 0) return 0;
  // In units of the picture's mean, so that squares neither overflow nor vanish.
  double sum = 0;
  for (const Sums& sums : sums_) {
    const DVec3 error = errorOf(sums) / mean, value = sums.mean / mean;
    for (int c = 0; c < 3; ++c) sum += error[c] * error[c] / (value[c] * value[c] + kRelativeEpsilon);
  }
  return std::sqrt(sum / (3 * static_cast<double>(sums_.size())));
}

std::size_t Film::bytes() const {
  return sums_.bytes() + auxiliary_.bytes() + pendingRadiance_.bytes() + pendingAuxiliary_.bytes() + badCounts_.bytes();
}

LayeredImage Film::layers() const {
  LayeredImage image{width(), height(), {}, {}};
  image.layers.push_back({"", {"R", "G", "B"}, interleaved(mean())});
  if (!auxiliary_.empty()) {
    ImageRgb albedo(width(), height()), normal(width(), height());
    std::vector<float> depth;
    depth.reserve(auxiliary_.size());
    for (std::size_t i = 0; i < auxiliary_.size(); ++i) {
      albedo[i] = Vec3(auxiliary_[i].albedo);
      normal[i] = Vec3(auxiliary_[i].normal);
      depth.push_back(static_cast<float>(auxiliary_[i].depth));
    }
    image.layers.push_back({"albedo", {"R", "G", "B"}, interleaved(albedo)});
    image.layers.push_back({"normal", {"X", "Y", "Z"}, interleaved(normal)});
    image.layers.push_back({"depth", {"Z"}, std::move(depth)});
  }
  image.layers.push_back({"error", {"R", "G", "B"}, interleaved(standardError())});
  return image;
}

}  // namespace cellcut
