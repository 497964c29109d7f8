/// \file program_run.h
/// The program itself as a process of its own, for what a call of runCommandLine cannot show: signals and how it ends.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace cellcut::test {

/// How a process ended: one of the two is 0.
struct ProgramEnd {
  int code;    ///< exit code
  int signal;  ///< that killed it
};

class ProgramRun {
 public:
  /// Starts it with these arguments (without its name), its standard streams into files in `folder`.
  /// \param before  shell commands that set limits for it: "ulimit -v 300000"
  /// \throws std::runtime_error if no process can be started
  ProgramRun(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
             const std::string& before = "");
  /// Kills it if it still runs.
  ~ProgramRun();
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  void send(int signal) const;
  /// Whether it has a handler of its own for a signal by now.
  bool handles(int signal) const;
  /// False once it has ended, though nobody has waited for it.
  bool runs() const;
  ProgramEnd wait();
  /// What it has written to its standard error stream so far.
  std::string err() const;

 private:
  std::filesystem::path err_;
  pid_t pid_;  ///< 0: waited for
};

}  // namespace cellcut::test
