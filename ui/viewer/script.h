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
///     expect LABEL VALUE       numbers are compared as numbers, whole ones digit by digit
///     quit
///
/// What is not there yet is waited for while something is looked up, and what is scrolled out of its panel comes in.
/// A LABEL of several words stands in quotes; # begins a comment. Positions: framebuffer pixels, origin top left.
#pragma once

#include "ui/viewer/viewer.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cellcut {

struct ScriptAction {
  std::string place;  ///< "FILE:LINE", lines from 1
  std::vector<std::string> words;
};

/// \throws InputError naming file, line and remedy; as readFile(), and for scripts of more than a megabyte
std::vector<ScriptAction> readScript(const std::filesystem::path& file);

/// Plays the actions to their end, frame by frame.
/// \param actions  of readScript()
/// \param folder  that files in them are meant from
/// \throws InputError naming the line when a label is not there, an expectation fails, samples are waited for that a
/// limit keeps from coming, or waiting takes longer than ten minutes
void playScript(std::span<const ScriptAction> actions, const std::filesystem::path& folder, Viewer& viewer,
                Window& window);

}  // namespace cellcut
