/// \file script_recorder.h
/// Writes down what a person does, in the language of script.h.
///
/// What a widget was set to is one line however long it was dragged; a flight is the view that it ended with, for how
/// far a held key flies is a matter of time. Threads: one.
#pragma once

#include "ui/viewer/camera_control.h"
#include "ui/viewer/widgets.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace cellcut {

class ScriptRecorder {
 public:
  /// Begins the file anew. \throws InputError if it cannot be written
  explicit ScriptRecorder(const std::filesystem::path& file);
  /// As finish(), but what fails is not said.
  ~ScriptRecorder();
  ScriptRecorder(const ScriptRecorder&) = delete;
  ScriptRecorder& operator=(const ScriptRecorder&) = delete;

  /// Adds a line; one that sets the same label, size or view as the line before replaces it.
  void write(std::vector<std::string> words);
  /// The picture is not yet what the last line asks for: a position on it means nothing before `wait spp 1`.
  void pictureChanges() { pictureChanges_ = true; }
  void pictureChangesAfter(std::vector<std::string> words) {
    write(std::move(words));
    pictureChanges();
  }
  /// Before a line with a position on the picture. \param mayWait  there will be samples: the rendering is not paused
  void beforePosition(bool mayWait);

  void edits(const std::vector<WidgetEdit>& edits);
  void view(const CameraPose& pose);

  /// Why nothing has been written for some time, once; empty while all is well.
  std::string takeProblem() { return std::exchange(problem_, ""); }
  /// Writes the last line; until then the file lacks it.
  /// \throws std::runtime_error if it lacks this or another one
  void finish();

 private:
  void flush();
  std::string failure() const;

  std::filesystem::path file_;
  std::ofstream stream_;  ///< failed from the first line on that could not be written
  std::string problem_;
  std::vector<std::string> last_;
  bool pictureChanges_ = false;
};

}  // namespace cellcut
