/// \file script.h
/// Input that was written down: one action a line, replayed through the events that a person's mouse and keys make.
///
///     size W H                 of the window
///     click LABEL              a button, a checkbox, a name in an open list
///     set LABEL VALUE          a checkbox (on, off), a number, a choice
///     drag left|middle|right X0 Y0 X1 Y1
///     move X Y                 of the pointer
///     scroll X Y DY            notches, > 0 away from the person
///     key NAME                 "F1", "G", "Ctrl+C"
///     pick X Y                 a click on that pixel of the picture
///     view POSITION BACK UP HALF_HEIGHT FOCUS perspective|orthographic
///                              three numbers each; pasted from the clipboard
///     drop FILE
///     wait spp N | wait idle   idle: nothing is left to render, load or look up
///     screenshot FILE          .png
///     expect LABEL VALUE       numbers are compared as numbers
///     quit
///
/// What is not there yet is waited for while something is looked up, and what is scrolled out of its panel comes in.
/// A LABEL of several words stands in quotes; # begins a comment. Positions: framebuffer pixels, origin top left.
#pragma once

#include "ui/viewer/viewer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cellcut {

struct ScriptAction {
  int line;  ///< from 1
  std::vector<std::string> words;
};

/// \throws InputError naming file, line and remedy; as readFile(), and for scripts of more than a megabyte
std::vector<ScriptAction> readScript(const std::filesystem::path& file);

class ScriptPlayer {
 public:
  /// \param folder  that files in the script are meant from
  ScriptPlayer(std::filesystem::path name, std::vector<ScriptAction> actions, std::filesystem::path folder);

  /// Plays the script to its end, frame by frame.
  /// \throws InputError naming the line when a label is not there, an expectation fails, samples are waited for that a
  /// limit keeps from coming, or waiting takes longer than ten minutes
  void play(Viewer& viewer, Window& window);

 private:
  struct Stage {
    Viewer& viewer;
    Window& window;
  };
  void perform(const ScriptAction& action, Stage& stage);
  void frames(Stage& stage, int count) const;
  void clickAt(Stage& stage, Vec2 position, MouseButton button = MouseButton::kLeft) const;
  void press(const ScriptAction& action, Stage& stage, const std::string& keys) const;
  void type(Stage& stage, const std::string& text) const;
  void set(const ScriptAction& action, Stage& stage) const;
  /// Draws frames with the news that come in.
  void waitUntil(const ScriptAction& action, Stage& stage, const std::function<bool()>& done) const;
  void wait(const ScriptAction& action, Stage& stage) const;
  void expect(const ScriptAction& action, Stage& stage) const;
  void drag(const ScriptAction& action, Stage& stage) const;
  void paste(const ScriptAction& action, Stage& stage) const;
  /// Where it can be clicked: waits for it and scrolls to it.
  WidgetItem item(const ScriptAction& action, Stage& stage, const std::string& label) const;
  /// The widget once it stays where it is.
  WidgetItem still(const ScriptAction& action, Stage& stage, const std::string& label) const;
  [[noreturn]] void failMissing(const ScriptAction& action, const Stage& stage, const std::string& label) const;
  float number(const ScriptAction& action, std::size_t word) const;
  Vec2 position(const ScriptAction& action, std::size_t word) const;
  [[noreturn]] void fail(const ScriptAction& action, const std::string& problem) const;

  std::filesystem::path name_;
  std::vector<ScriptAction> actions_;
  std::filesystem::path folder_;
};

}  // namespace cellcut
