#include "app/measure/summary.h"

#include "renderer/base/exact_number.h"
#include "renderer/measure/convergence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace cellcut {
namespace {

std::vector<const RunRecord*> runsOf(const MeasureResults& results, std::size_t configuration) {
  std::vector<const RunRecord*> runs;
  for (const RunRecord& run : results.runs) {
    if (run.configuration == configuration) runs.push_back(&run);
  }
  // Runs may have been added to an interrupted measurement; the sums below do not depend on when.
  std::sort(runs.begin(), runs.end(), [](const RunRecord* a, const RunRecord* b) { return a->run < b->run; });
  return runs;
}

template <class Value>
Estimate estimateOf(const std::vector<Checkpoint>& points, const Value& value) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Checkpoint& point : points) values.push_back(static_cast<double>(value(point)));
  return estimatePositive(values);
}

/// Of counts, which differ little.
template <class Value>
double meanOf(const std::vector<Checkpoint>& points, const Value& value) {
  double sum = 0;
  for (const Checkpoint& point : points) sum += static_cast<double>(value(point));
  return sum / static_cast<double>(points.size());
}

SummaryRow rowOf(std::size_t configuration, bool equalTime, const std::vector<Checkpoint>& points) {
  const auto estimate = [&](const auto& value) { return estimateOf(points, value); };
  return {.configuration = configuration,
          .equalTime = equalTime,
          .runs = points.size(),
          .passes = meanOf(points, [](const Checkpoint& c) { return c.passes; }),
          .seconds = estimate([](const Checkpoint& c) { return c.seconds; }),
          .mse = estimate([](const Checkpoint& c) { return c.mse; }),
          .relmse = estimate([](const Checkpoint& c) { return c.relmse; }),
          .smape = estimate([](const Checkpoint& c) { return c.smape; }),
          .flip = estimate([](const Checkpoint& c) { return c.flip; }),
          .flipLdr = estimate([](const Checkpoint& c) { return c.flipLdr; }),
          .inefficiency = estimate([](const Checkpoint& c) { return c.relmse * c.seconds; }),
          .passSeconds = estimate([](const Checkpoint& c) { return c.passSeconds; }).value,
          .cutSize = meanOf(points, [](const Checkpoint& c) { return c.cutSize; }),
          .cells = meanOf(points, [](const Checkpoint& c) { return c.cells; }),
          .bytes = meanOf(points, [](const Checkpoint& c) { return c.bytes; })};
}

Checkpoint compared(const RunRecord& run, std::optional<double> seconds) {
  return seconds ? atTime(run, *seconds) : run.checkpoints.back();
}

/// Empty for what is no number.
std::string text(double value) {
  return std::isfinite(value) ? exactNumber(value) : "";
}

/// RFC 4180.
std::string csvField(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string result = "\"";
  for (const char c : field) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

struct Column {
  std::string name, meaning;
  std::function<std::string(const MeasureResults&, const SummaryRow&)> value;
};

void addEstimate(std::vector<Column>& columns, const std::string& name, const std::string& meaning,
                 Estimate SummaryRow::*estimate) {
  columns.push_back({name, meaning, [=](const auto&, const SummaryRow& r) { return text((r.*estimate).value); }});
  columns.push_back({name + "_low", "", [=](const auto&, const SummaryRow& r) { return text((r.*estimate).low); }});
  columns.push_back({name + "_high", "", [=](const auto&, const SummaryRow& r) { return text((r.*estimate).high); }});
}

void addNumber(std::vector<Column>& columns, const std::string& name, const std::string& meaning,
               double SummaryRow::*number) {
  columns.push_back({name, meaning, [=](const auto&, const SummaryRow& r) { return text(r.*number); }});
}

const Configuration& configurationOf(const MeasureResults& results, const SummaryRow& row) {
  return results.plan.configurations[row.configuration];
}

const MeasureCase& caseOf(const MeasureResults& results, const SummaryRow& row) {
  return results.plan.cases[configurationOf(results, row).caseIndex];
}

/// A parameter that only strategies with cuts have.
template <class Value>
Column parameter(const std::string& name, const std::string& meaning, const Value& value) {
  return {name, meaning, [value](const MeasureResults& results, const SummaryRow& row) -> std::string {
            const Configuration& c = configurationOf(results, row);
            return hasCuts(c.strategy) ? value(c.sampler) : std::string();
          }};
}

std::uint64_t totalOf(const LightCounts& n) {
  return n.point + n.spot + n.triangle + n.directional + n.environment;
}

std::vector<Column> makeColumns() {
  std::vector<Column> columns{
      {"configuration", "name, unique; its picture is images/NAME.exr",
       [](const auto& results, const auto& row) { return csvField(configurationOf(results, row).name); }},
      {"case", "scene, lights and depth: what has one reference",
       [](const auto& results, const auto& row) { return csvField(caseOf(results, row).name); }},
      {"lights", "number of lights, tiles of the environment included",
       [](const auto& results, const auto& row) {
         return std::to_string(totalOf(results.cases[configurationOf(results, row).caseIndex].lights));
       }},
      {"max_depth", "times a path may scatter",
       [](const auto& results, const auto& row) { return std::to_string(caseOf(results, row).maxDepth); }},
      {"strategy", "as in --strategies",
       [](const auto& results, const auto& row) {
         return std::string(nameOf(configurationOf(results, row).strategy));
       }},
      parameter("threshold", "share of the cut's estimate above which a cluster is split",
                [](const SamplerSettings& s) { return exactNumber(s.threshold); }),
      parameter("max_cut", "most clusters of a cut", [](const SamplerSettings& s) { return std::to_string(s.maxCut); }),
      parameter("grid_resolution", "cells along the longest axis",
                [](const SamplerSettings& s) { return std::to_string(s.gridResolution); }),
      parameter("in_cluster", "choice inside a cluster",
                [](const SamplerSettings& s) { return std::string(nameOf(s.inCluster)); }),
      {"base", "1: the parameters of the command line, 0: a point of a sweep",
       [](const auto& results, const auto& row) {
         return std::string(configurationOf(results, row).isBase ? "1" : "0");
       }},
      {"at", "passes: a checkpoint; time: the time of comparison, interpolated between checkpoints",
       [](const auto&, const auto& row) { return std::string(row.equalTime ? "time" : "passes"); }},
      {"runs", "runs that got so far", [](const auto&, const auto& row) { return std::to_string(row.runs); }}};
  addNumber(columns, "spp", "samples per pixel", &SummaryRow::passes);
  addEstimate(columns, "seconds", "s of rendering, without build and comparisons", &SummaryRow::seconds);
  addEstimate(columns, "mse", "(W/(m2 sr))^2, as in `cellcut compare`, all errors", &SummaryRow::mse);
  addEstimate(columns, "relmse", "relative squared error", &SummaryRow::relmse);
  addEstimate(columns, "smape", "symmetric relative error, 0 to 1", &SummaryRow::smape);
  addEstimate(columns, "flip", "HDR-FLIP, 0 to 1", &SummaryRow::flip);
  addEstimate(columns, "flip_ldr", "FLIP of the tone-mapped pictures, 0 to 1", &SummaryRow::flipLdr);
  addEstimate(columns, "inefficiency", "s, relmse * seconds", &SummaryRow::inefficiency);
  addNumber(columns, "pass_seconds", "s, median of a run's passes", &SummaryRow::passSeconds);
  addNumber(columns, "build_seconds", "s before the first pass", &SummaryRow::buildSeconds);
  addNumber(columns, "cut_size", "clusters per cut, mean; 0 without kept cuts", &SummaryRow::cutSize);
  addNumber(columns, "cells", "cells made", &SummaryRow::cells);
  addNumber(columns, "memory_bytes", "bytes of the lights and the strategy's tables", &SummaryRow::bytes);
  return columns;
}

}  // namespace

Checkpoint atTime(const RunRecord& run, double seconds) {
  const std::vector<Checkpoint>& points = run.checkpoints;
  if (!(seconds > points.front().seconds)) return points.front();
  if (seconds >= points.back().seconds) return points.back();
  // What only grows by steps is that of the checkpoint after.
  Checkpoint result =
      *std::find_if(points.begin(), points.end(), [&](const Checkpoint& c) { return c.seconds > seconds; });
  const auto at = [&](const auto& value) {
    std::vector<CurvePoint> curve;
    curve.reserve(points.size());
    for (const Checkpoint& c : points) curve.push_back({c.seconds, static_cast<double>(value(c))});
    return interpolateLogLog(curve, seconds);
  };
  result.seconds = seconds;
  result.passes = static_cast<std::uint64_t>(std::llround(at([](const Checkpoint& c) { return c.passes; })));
  result.mse = at([](const Checkpoint& c) { return c.mse; });
  result.relmse = at([](const Checkpoint& c) { return c.relmse; });
  result.smape = at([](const Checkpoint& c) { return c.smape; });
  result.flip = at([](const Checkpoint& c) { return c.flip; });
  result.flipLdr = at([](const Checkpoint& c) { return c.flipLdr; });
  return result;
}

std::vector<SummaryRow> summaryOf(const MeasureResults& results, std::optional<double> seconds) {
  std::vector<SummaryRow> rows;
  for (std::size_t i = 0; i < results.plan.configurations.size(); ++i) {
    const auto runs = runsOf(results, i);
    if (runs.empty()) continue;
    std::map<std::uint64_t, std::vector<Checkpoint>> byPasses;
    std::vector<Checkpoint> atEnd;
    std::vector<double> builds;
    for (const RunRecord* run : runs) {
      for (const Checkpoint& c : run->checkpoints) byPasses[c.passes].push_back(c);
      atEnd.push_back(compared(*run, seconds));
      builds.push_back(run->buildSeconds);
    }
    const std::size_t first = rows.size();
    for (const auto& [passes, points] : byPasses) rows.push_back(rowOf(i, false, points));
    rows.push_back(rowOf(i, true, atEnd));
    for (std::size_t row = first; row < rows.size(); ++row) rows[row].buildSeconds = estimatePositive(builds).value;
  }
  return rows;
}

Slopes slopesOf(const MeasureResults& results, std::size_t configuration) {
  std::vector<double> overPasses, overSeconds;
  for (const RunRecord* run : runsOf(results, configuration)) {
    std::vector<CurvePoint> passes, seconds;
    for (const Checkpoint& c : run->checkpoints) {
      passes.push_back({static_cast<double>(c.passes), c.relmse});
      seconds.push_back({c.seconds, c.relmse});
    }
    const double slope = logLogSlope(passes);
    if (std::isnan(slope)) continue;  // a single checkpoint
    overPasses.push_back(slope);
    overSeconds.push_back(logLogSlope(seconds));
  }
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (overPasses.empty()) return {{kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}};
  return {estimateMean(overPasses), estimateMean(overSeconds)};
}

std::vector<Gain> gainsOf(const MeasureResults& results, std::optional<double> seconds) {
  std::vector<Gain> gains;
  const std::vector<Configuration>& all = results.plan.configurations;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto base = std::find_if(all.begin(), all.end(), [&](const Configuration& c) {
      return c.caseIndex == all[i].caseIndex && c.strategy == Strategy::kCellCut && c.isBase;
    });
    if (base == all.end() || base - all.begin() == static_cast<std::ptrdiff_t>(i)) continue;
    std::map<int, const RunRecord*> baseRuns;
    for (const RunRecord* run : runsOf(results, static_cast<std::size_t>(base - all.begin()))) baseRuns[run->run] = run;
    std::vector<double> relmse, inefficiency;
    for (const RunRecord* run : runsOf(results, i)) {
      const auto partner = baseRuns.find(run->run);
      if (partner == baseRuns.end()) continue;
      const Checkpoint other = compared(*run, seconds), own = compared(*partner->second, seconds);
      if (!(own.relmse > 0)) continue;
      relmse.push_back(other.relmse / own.relmse);
      inefficiency.push_back(other.relmse * other.seconds / (own.relmse * own.seconds));
    }
    if (!relmse.empty()) gains.push_back({i, estimatePositive(relmse), estimatePositive(inefficiency)});
  }
  return gains;
}

std::string toCsv(const MeasureResults& results, const std::vector<SummaryRow>& rows) {
  const std::vector<Column> columns = makeColumns();
  std::string table;
  const auto addLine = [&](const auto& field) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) table += ',';
      table += field(columns[i]);
    }
    table += "\r\n";
  };
  addLine([](const Column& column) { return column.name; });
  for (const SummaryRow& row : rows) addLine([&](const Column& column) { return column.value(results, row); });
  return table;
}

std::string csvHelp() {
  std::string help;
  for (const Column& column : makeColumns()) {
    if (!column.meaning.empty()) help += "  " + column.name + ": " + column.meaning + "\n";
  }
  return help;
}

}  // namespace cellcut
