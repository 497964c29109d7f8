#include "app/measure/reference.h"

#include "app/measure/scene_hash.h"
#include "app/output.h"
#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/base/rng.h"
#include "renderer/base/stopwatch.h"
#include "renderer/measure/batch_mean.h"
#include "renderer/trace/renderer.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kFewestBatches = 4;  // fewer say too little of how far they differ
constexpr std::uint64_t kBatches = 16;       // of a reference whose passes are given
constexpr std::uint64_t kMostBatchPasses = 256;
constexpr std::uint64_t kUnaskedBatchPasses = 32;
constexpr std::uint64_t kSeed = 0x7265666572656e63ull;  // far from the seeds that people choose
constexpr std::uint64_t kFormat = 1;                    // of the cache's files

struct Batches {
  BatchMean pictures;
  double seconds = 0;  ///< that they took
};

std::uint64_t batchPassesOf(const ReferenceRequest& request) {
  if (!request.passes) return kUnaskedBatchPasses;
  return std::clamp<std::uint64_t>(std::bit_floor(*request.passes / kBatches), 1, kMostBatchPasses);
}

/// Where the batches of a request lie: their content, then how many they are.
class BatchFiles {
 public:
  BatchFiles(const ReferenceRequest& request, std::uint64_t batchPasses) : folder_(request.folder) {
    const RenderSettings& s = request.settings;
    key_ = hexOf(hashOf(kFormat, hashOfScene(request.scene), hashOfCamera(viewOf(request.scene, s)), s.width, s.height,
                        s.maxDepth, static_cast<std::uint64_t>(s.sampling), batchPasses));
  }

  fs::path pixels(std::uint64_t count) const {
    return folder_ / ("reference-" + key_ + "-" + std::to_string(count) + ".pfm");
  }
  fs::path seconds(std::uint64_t count) const { return pixels(count).replace_extension(".seconds"); }

  /// The largest number of batches up to `most` that is there and can be read.
  Batches load(std::uint64_t most, const RenderSettings& settings) const {
    Batches empty{BatchMean(settings.width, settings.height)};
    for (std::uint64_t count : counts()) {
      if (count > most) continue;
      if (auto batches = read(count, empty)) return *batches;
    }
    return empty;
  }

  /// \throws std::runtime_error
  void store(const Batches& batches) const {
    const auto& [count, mean, deviation] = batches.pictures;
    ImageRgb both(mean.width(), 2 * mean.height());
    std::copy(mean.begin(), mean.end(), both.begin());
    std::copy(deviation.begin(), deviation.end(), both.begin() + static_cast<std::ptrdiff_t>(mean.size()));
    writeText(seconds(count), std::to_string(batches.seconds) + "\n");
    writePicture({pixels(count), PictureKind::kPfm}, both);
  }
  void remove(std::uint64_t count) const {
    std::error_code ignored;  // a file too many does no harm
    fs::remove(pixels(count), ignored);
    fs::remove(seconds(count), ignored);
  }

 private:
  /// From the largest down.
  std::vector<std::uint64_t> counts() const {
    std::vector<std::uint64_t> found;
    const std::string prefix = "reference-" + key_ + "-";
    std::error_code ignored;  // what cannot be listed is not there
    for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(prefix) || !name.ends_with(".pfm")) continue;
      std::uint64_t count = 0;
      const char* end = name.data() + name.size() - 4;
      const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, count);
      if (error == std::errc{} && stop == end && count > 0) found.push_back(count);
    }
    std::sort(found.rbegin(), found.rend());
    return found;
  }

  std::optional<Batches> read(std::uint64_t count, Batches batches) const {
    try {
      const ImageRgb both = readImage(pixels(count));
      auto& [total, mean, deviation] = batches.pictures;
      if (both.width() != mean.width() || both.height() != 2 * mean.height()) return std::nullopt;
      const auto middle = both.begin() + static_cast<std::ptrdiff_t>(mean.size());
      std::copy(both.begin(), middle, mean.begin());
      std::copy(middle, both.end(), deviation.begin());
      const std::vector<std::byte> text = readFile(seconds(count), 100);
      const char* begin = reinterpret_cast<const char*>(text.data());
      std::from_chars(begin, begin + text.size(), batches.seconds);
      total = count;
      return batches;
    } catch (const InputError&) {
      return std::nullopt;  // damaged, or taken away by another process: made again
    }
  }

  fs::path folder_;
  std::string key_;
};

bool suffices(const ReferenceRequest& request, const Batches& batches, std::uint64_t batchPasses) {
  if (batches.pictures.count < kFewestBatches) return false;
  if (request.passes) return batches.pictures.count * batchPasses >= *request.passes;
  return batches.seconds >= kReferenceFactor * request.seconds;
}

std::uint64_t mostBatches(const ReferenceRequest& request, std::uint64_t batchPasses) {
  if (!request.passes) return std::numeric_limits<std::uint64_t>::max();
  return std::max(kFewestBatches, (*request.passes + batchPasses - 1) / batchPasses);
}

/// Passes that the whole will take.
std::uint64_t aim(const ReferenceRequest& request, const Batches& batches, std::uint64_t batchPasses) {
  if (request.passes) return mostBatches(request, batchPasses) * batchPasses;
  const double needed = batches.seconds > 0 ? static_cast<double>(batches.pictures.count) * kReferenceFactor *
                                                  request.seconds / batches.seconds
                                            : 0;
  return batchPasses * std::max(kFewestBatches, static_cast<std::uint64_t>(std::ceil(needed)));
}

}  // namespace

fs::path cacheFolder(const fs::path& otherwise) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  fs::path folder;
  if (cache != nullptr && *cache == '/') {  // the specification: paths that are not absolute are to be ignored
    folder = fs::path(cache) / "cellcut";
  } else if (home != nullptr && *home == '/') {
    folder = fs::path(home) / ".cache" / "cellcut";
  }
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  const bool usable = !folder.empty() && !error && fs::is_directory(folder, error) && isWritable(folder);
  return usable ? folder : otherwise;
}

std::optional<MeasureReference> makeReference(const ReferenceRequest& request, const std::atomic<bool>& cancel,
                                              const std::function<void(std::uint64_t, double, std::uint64_t)>& onPass) {
  RenderSettings settings = request.settings;
  settings.strategy = Strategy::kCellCut;
  settings.sampler = {};
  settings.auxiliary = false;
  const std::uint64_t batchPasses = batchPassesOf(request);
  const BatchFiles files(request, batchPasses);
  Batches batches = files.load(mostBatches(request, batchPasses), settings);
  const std::uint64_t found = batches.pictures.count;
  while (!suffices(request, batches, batchPasses)) {
    settings.seed = hashOf(kSeed, batches.pictures.count);
    Renderer renderer(request.scene, settings);
    double seconds = 0;
    while (renderer.film().passes() < batchPasses) {
      const Stopwatch pass;
      if (!renderer.renderPass(cancel)) return std::nullopt;
      seconds += pass.seconds();
      onPass(batches.pictures.count * batchPasses + renderer.film().passes(), batches.seconds + seconds,
             aim(request, batches, batchPasses));
    }
    batches.pictures.add(renderer.film().mean());
    batches.seconds += seconds;
    files.store(batches);
    if (batches.pictures.count > found + 1) files.remove(batches.pictures.count - 1);
  }
  const BatchMean& made = batches.pictures;
  return MeasureReference{made.mean, made.relmse(), made.count * batchPasses, batches.seconds,
                          files.pixels(made.count)};
}

void requireFineReference(const MeasureReference& reference, double smallestRelmse) {
  // NaN: nothing is known of it, which is said where it was read.
  if (!(reference.relmse > kMostReferenceShare * smallestRelmse)) return;
  const double factor = std::ceil(reference.relmse / (kMostReferenceShare * smallestRelmse));
  std::ostringstream problem;
  problem << "its own relMSE of " << reference.relmse << " is more than " << kMostReferenceShare * 100 << " % of the "
          << smallestRelmse << " that it is to judge; ";
  if (reference.passes > 0) {
    problem << "make one with --reference-spp " << std::llround(factor * 1.25 * static_cast<double>(reference.passes));
  } else {
    problem << "use one with less noise";
  }
  throw InputError(reference.file.string(), problem.str());
}

}  // namespace cellcut
