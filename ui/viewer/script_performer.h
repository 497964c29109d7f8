/// \file script_performer.h
/// The actions of a script, made through the events of mouse and keys.
#pragma once

#include "renderer/base/error.h"
#include "ui/viewer/script.h"

#include <functional>

namespace cellcut {

/// Frames as a script has them: of the same length on any machine.
void drawScriptFrames(Viewer& viewer, Window& window, int count);

/// One action of a script at work; each public member is that of its name. All throw as playScript().
class ScriptPerformer {
 public:
  /// All outlive it.
  ScriptPerformer(const ScriptAction& action, const std::filesystem::path& folder, Viewer& viewer, Window& window)
      : words_(action.words), place_(action.place), folder_(folder), viewer_(viewer), window_(window) {}

  void size() const;
  void click() const;
  void set() const;
  void drag() const;
  void move() const;
  void scroll() const;
  void key() const { press(words_[1]); }
  void pick() const;
  void view() const;
  void drop() const;
  void wait() const;
  void screenshot() const;
  void expect() const;

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(place_, problem); }
  [[noreturn]] void failMissing(const std::string& label) const;
  void frames(int count) const { drawScriptFrames(viewer_, window_, count); }
  float number(std::size_t word) const;
  Vec2 position(std::size_t word) const { return {number(word), number(word + 1)}; }
  /// Draws frames with the news that come in.
  void waitUntil(const std::function<bool()>& done) const;
  /// Where it can be clicked: waits for it and scrolls to it.
  WidgetItem item(const std::string& label) const;
  /// The widget once it stays where it is.
  WidgetItem still(const std::string& label) const;
  void clickAt(Vec2 position, MouseButton button = MouseButton::kLeft) const;
  void press(const std::string& keys) const;
  void type(const std::string& text) const;

  const std::vector<std::string>& words_;
  const std::string& place_;
  const std::filesystem::path& folder_;
  Viewer& viewer_;
  Window& window_;
};

}  // namespace cellcut
