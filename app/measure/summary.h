/// \file summary.h
/// The runs of each configuration taken together: values with intervals.
#pragma once

#include "app/measure/results.h"
#include "renderer/measure/intervals.h"

#include <string>
#include <vector>

namespace cellcut {

/// One configuration at one number of passes, or at the time at which all are compared.
struct SummaryRow {
  std::size_t configuration = 0;
  bool equalTime = false;
  std::size_t runs = 0;  ///< that got so far
  double passes = 0;     ///< mean over the runs
  /// Geometric means over the runs.
  Estimate seconds, mse, relmse, smape, flip, flipLdr;
  Estimate inefficiency;  ///< relMSE · seconds
  double passSeconds = 0, buildSeconds = 0, cutSize = 0, cells = 0, bytes = 0;
};

/// How relMSE falls: exponent of passes and of seconds, over all checkpoints of a run.
struct Slopes {
  Estimate overPasses, overSeconds;
};

/// relMSE of another configuration over that of the case's base `cell-cut`, run by run at the time of comparison.
struct Gain {
  std::size_t configuration = 0;
  Estimate relmse;        ///< > 1: cell-cut has less error at the compared times
  Estimate inefficiency;  ///< the same times the seconds that each took
};

/// The checkpoints that at least one run reached and then the equal-time row, configuration by configuration in the plan's
/// order; none for a configuration without runs.
/// \param seconds  the time of comparison; nothing: at the last checkpoint
std::vector<SummaryRow> summaryOf(const MeasureResults& results, std::optional<double> seconds);

Slopes slopesOf(const MeasureResults& results, std::size_t configuration);

std::vector<Gain> gainsOf(const MeasureResults& results, std::optional<double> seconds);

/// A run as it was after `seconds`, between its checkpoints by logLog interpolation; at its first checkpoint or its last
/// where `seconds` lies outside of them.
Checkpoint atTime(const RunRecord& run, double seconds);

/// The table for spreadsheets: a line of names, then a line per row. Numbers that are not known are empty.
std::string toCsv(const MeasureResults& results, const std::vector<SummaryRow>& rows);

/// Names of the table's columns with what they mean, one per line, for --help.
std::string csvHelp();

}  // namespace cellcut
