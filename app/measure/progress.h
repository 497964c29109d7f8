/// \file progress.h
/// What a person sees while `measure` works.
#pragma once

#include "renderer/base/stopwatch.h"

#include <ostream>
#include <string>

namespace cellcut {

/// On a terminal one line that is redrawn; elsewhere a line per finished piece of work and one every half minute between.
class MeasureProgress {
 public:
  MeasureProgress(std::ostream& stream, bool terminal) : stream_(stream), terminal_(terminal) {}

  /// Seconds of rendering that there are to do, by which the share that is done is counted.
  void expect(double seconds) { expected_ += seconds; }
  /// \param label    what is worked on
  /// \param share    of this piece, [0, 1]
  /// \param seconds  that were expected of it
  void update(const std::string& label, double share, double seconds);
  /// The piece is done.
  void finish(const std::string& label, double seconds);

 private:
  void draw(const std::string& text);
  std::string left(double done) const;

  std::ostream& stream_;
  bool terminal_;
  Stopwatch watch_;
  double expected_ = 0, done_ = 0;
  double drawn_ = 0;  ///< when, by watch_
};

}  // namespace cellcut
