#include "ui/viewer/script_recorder.h"

#include "renderer/base/error.h"
#include "renderer/base/exact_number.h"
#include "renderer/base/image_io.h"

#include <stdexcept>

namespace cellcut {
namespace {

/// Lines that only the last of a row matters of.
bool replaces(const std::vector<std::string>& next, const std::vector<std::string>& last) {
  if (next.empty() || last.empty() || next[0] != last[0]) return false;
  if (next[0] == "size" || next[0] == "view") return true;
  return next[0] == "set" && next[1] == last[1];
}

std::string asWord(const std::string& word) {
  return word.empty() || word.find_first_of(" \t#") != std::string::npos ? '"' + word + '"' : word;
}

}  // namespace

ScriptRecorder::ScriptRecorder(const std::filesystem::path& file) : file_(file), stream_(writtenFile(file)) {
  if (!stream_) throw InputError(file.string(), "cannot be written; name a file in a folder that is there");
  stream_ << "# Recorded by cellcut; replay with: cellcut view --script FILE SCENE\n" << std::flush;
  if (!stream_) throw InputError(file.string(), "cannot be written; make room or choose another place");
}

ScriptRecorder::~ScriptRecorder() {
  flush();
}

std::string ScriptRecorder::failure() const {
  return file_.string() + ": not all that was done could be recorded; make room or choose another place";
}

void ScriptRecorder::flush() {
  const bool sound = stream_.good();
  for (std::size_t i = 0; i < last_.size(); ++i) stream_ << (i > 0 ? " " : "") << asWord(last_[i]);
  if (!last_.empty()) stream_ << '\n' << std::flush;
  last_.clear();
  if (sound && !stream_) problem_ = failure();
}

void ScriptRecorder::finish() {
  flush();
  if (!stream_) throw std::runtime_error(failure());
}

void ScriptRecorder::write(std::vector<std::string> words) {
  if (!replaces(words, last_)) flush();
  last_ = std::move(words);
}

void ScriptRecorder::beforePosition(bool mayWait) {
  if (pictureChanges_ && mayWait) write({"wait", "spp", "1"});
  pictureChanges_ = false;
}

void ScriptRecorder::edits(const std::vector<WidgetEdit>& edits) {
  for (const WidgetEdit& edit : edits) {
    if (edit.label == "Paste") continue;  // what is pasted lies in no script: view() says what came of it
    if (edit.value) {
      write({"set", edit.label, *edit.value});
    } else {
      write({"click", edit.label});
    }
  }
}

void ScriptRecorder::view(const CameraPose& pose) {
  std::vector<std::string> words{"view"};
  const Camera& c = pose.camera;
  for (const Vec3& v : {c.position, c.back, c.up}) {
    for (int axis = 0; axis < 3; ++axis) words.push_back(exactNumber(v[axis]));
  }
  words.push_back(exactNumber(c.halfHeight));
  words.push_back(exactNumber(pose.focus));
  words.emplace_back(c.orthographic ? "orthographic" : "perspective");
  write(std::move(words));
}

}  // namespace cellcut
