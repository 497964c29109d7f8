/// Files that the viewer reads and writes: scenes and references come in; pictures, tables and what was rendered go out.
#include "ui/viewer/is_ready.h"
#include "ui/viewer/viewer.h"

#include <algorithm>
#include <ctime>

namespace cellcut {
namespace {

/// "20260131-235959", for names of files.
std::string timeStamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

}  // namespace

void Viewer::open(const std::filesystem::path& file) {
  const std::string kind = lowerExtension(file);
  if (kind == ".exr" || kind == ".pfm") {
    if (loadingReference_.valid()) return;
    loadingReference_ = std::async(std::launch::async, [file] {
      return Reference{std::make_shared<const ImageRgb>(readImage(file)), {}, 0};
    });
    return;
  }
  if (loading_.valid()) return;  // one at a time; the file can be dropped again
  loadingFile_ = file;
  loading_ = std::async(std::launch::async, [loader = loader_, file] { return loader(file); });
}

void Viewer::takeScene() {
  if (!isReady(loading_)) return;
  guarded([this] {
    scene_ = loading_.get();
    options_.file = loadingFile_;
    problem_.clear();
    showWarnings();
    state_.settings.camera = std::min(state_.settings.camera, scene_->cameras.size() - 1);
    state_.settings.view.reset();
    state_.settings.shownLights.reset();
    state_.bookmarks = {};
    state_.pick.reset();
    state_.selectedCluster.reset();
    state_.selectedLight = 0;
    pointedBefore_.reset();
    trials_.stop();
    trade_.reset();  // and with it the scene before
    recent_.add(options_.file);
    pose_ = poseOf(scene_->cameras[state_.settings.camera], scene_->bounds);
    window_.setTitle("cellcut: " + options_.file.filename().string());
    edited_ = true;
  });
}

void Viewer::showWarnings() {
  constexpr std::size_t kMost = 4;  // more would push the panels off the window
  const std::vector<std::string>& all = scene_->warnings;
  notice_.clear();
  for (std::size_t i = 0; i < std::min(all.size(), kMost); ++i) notice_.append(i > 0 ? "\n" : "").append(all[i]);
  if (all.size() > kMost) notice_.append("\n").append(std::to_string(all.size() - kMost)).append(" more: cellcut info");
}

void Viewer::openRecent() {
  if (state_.chosen < recent_.list().size()) open(recent_.list()[state_.chosen]);
}

void Viewer::save() {
  if (saving_.valid()) return;  // one at a time
  const std::filesystem::path stem = options_.saveFolder / ("cellcut-" + timeStamp());
  const std::vector<std::byte> png = encodePng(framebuffer_->read());
  writeFileAtomically(stem.string() + ".png", png);
  // The layers are the session's to make; compressing them takes as long as a pass.
  saving_ = std::async(std::launch::async, [stem = stem.string(), made = overlays_.layers(session_)]() mutable {
    LayeredImage layers = made.get();
    layers.metadata["software"] = "cellcut";
    writeExr(stem + ".exr", layers);
    return "saved " + stem + ".png and .exr";
  });
}

void Viewer::saveCsv() {
  std::vector<ConvergenceRun> runs{convergence_.run()};
  if (duel_) runs.push_back(secondConvergence_.run());
  runs.insert(runs.end(), keptRuns_.begin(), keptRuns_.end());
  const std::string text = toCsv(runs);
  const std::filesystem::path file = options_.saveFolder / ("cellcut-" + timeStamp() + ".csv");
  writeFileAtomically(file, std::as_bytes(std::span(text)));
  notice_ = "saved " + file.string();
}

}  // namespace cellcut
