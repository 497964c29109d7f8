/// \file console.h
/// Where a verb prints, and what it knows of how it was called.
#pragma once

#include <ostream>
#include <string>

namespace cellcut {

/// Results (JSON) go to `out`, everything meant for a person to `err`.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;    ///< `err` is a terminal: a line may be redrawn
  std::string commandLine;  ///< as a shell would take it again; becomes part of a picture's metadata
};

}  // namespace cellcut
