/// \file command_line.h
/// The whole program as a function: command line → verb → exit code.
#pragma once

#include <ostream>
#include <span>

namespace cellcut {

/// What the program returns to its caller.
enum ExitCode : int {
  kDone = 0,
  kFailed =
      1,  ///< anything that is not the caller's doing: no memory, no space, interrupted before there was a picture
  kBadInput = 2,  ///< usage or input that cannot be used
};

inline constexpr const char* kNotEnoughMemory =
    "cellcut: not enough memory; a smaller --size or a scene with fewer triangles needs less\n";

/// Runs the program. Never throws: what went wrong is one line on `err`.
/// \param args      the program's name and its arguments, as main() gets them
/// \param terminal  `err` is a terminal: progress is one line that is redrawn
/// \return an ExitCode
int runCommandLine(std::span<const char* const> args, std::ostream& out, std::ostream& err, bool terminal = false);

}  // namespace cellcut
