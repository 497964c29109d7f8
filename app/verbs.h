/// \file verbs.h
/// The verbs of the command line, one file each.
#pragma once

#include "app/console.h"

#include <functional>

namespace CLI {
class App;
}

namespace cellcut {

/// A verb as the parser knows it, and what it does once its options are read.
struct Verb {
  CLI::App* parser;  ///< owned by the program's parser
  /// Returns an ExitCode.
  /// \throws InputError if the input cannot be used, any other std::exception if something else
  /// went wrong
  std::function<int(const Console&)> run;
};

Verb addRender(CLI::App& program);
Verb addMeasure(CLI::App& program);
Verb addCompare(CLI::App& program);
Verb addGenerate(CLI::App& program);
Verb addInfo(CLI::App& program);
#ifdef CELLCUT_UI
Verb addView(CLI::App& program);
Verb addScreenshot(CLI::App& program);
#endif

}  // namespace cellcut
