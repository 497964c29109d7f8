/// \file options.h
/// The command line of `measure`.
#pragma once

#include "app/measure/plan.h"

namespace cellcut {

/// Declares the options on `verb`; parsing then fills `options`, which must stay where it is until then. Parsing throws
/// InputError for a value that cannot be used.
void addMeasureOptions(CLI::App& verb, MeasureOptions& options);

/// What only all options together tell.
/// \throws InputError if they contradict one another
void requireConsistent(const MeasureOptions& options);

}  // namespace cellcut
