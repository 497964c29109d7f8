/// \file console.h
/// Where a verb prints, and what it knows of how it was called.
#pragma once

#include "renderer/base/error.h"

#include <ostream>
#include <string>

namespace cellcut {

/// Results (JSON) go to `out`, everything meant for a person to `err`.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;    ///< `err` is a terminal: a line may be redrawn
  std::string commandLine;  ///< as a shell would take it again; becomes part of a picture's metadata

  /// A line for what a person should know though the work goes on. It may quote a file, which is not to command the
  /// terminal.
  void warn(const std::string& text) const { err << "cellcut: warning: " << printable(text, text.size()) << '\n'; }
};

}  // namespace cellcut
