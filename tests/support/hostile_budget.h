/// \file hostile_budget.h
/// What a hostile file may take of the machine before it is refused or read.
#pragma once

#include <cstddef>
#include <ctime>
#include <string>

namespace cellcut::test {

/// Expects, when its scope ends, that less than 2 s of processor time and 512 MB of memory were taken since it began. A
/// hang ends the program after a minute of the clock. Under sanitizers ten times these times, and no word of the
/// memory, most of which is theirs.
class HostileBudget {
 public:
  /// \param what         for messages, mostly a file's name
  /// \param mostSeconds  instead of the 2
  explicit HostileBudget(std::string what, double mostSeconds = 2);
  ~HostileBudget();
  HostileBudget(const HostileBudget&) = delete;
  HostileBudget& operator=(const HostileBudget&) = delete;

  /// Processor time of all threads. Of the wall clock other programs take some.
  double seconds() const;
  /// Largest resident memory since it began, less what there was then.
  std::size_t bytes() const;

 private:
  std::string what_;
  double mostSeconds_;
  std::clock_t start_;
  std::size_t before_;
};

}  // namespace cellcut::test
