/// \file command_run.h
/// The command line, called as a person calls it but in the test's own process.
#pragma once

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace cellcut::test {

struct Outcome {
  int code;  ///< exit code
  std::string out;
  std::string err;
};

/// \param arguments  without the program's name
/// \param err        takes what is written there, which the outcome then has not
/// \param terminal   whether err is one, and shows progress
Outcome runCommand(const std::vector<std::string>& arguments, std::ostream* err = nullptr, bool terminal = false);

/// Sends the process a SIGINT when a text is written to it for the n-th time, as a person would who has seen it.
class InterruptingBuffer : public std::stringbuf {
 public:
  InterruptingBuffer(std::string text, int count) : text_(std::move(text)), count_(count) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override;

 private:
  std::string text_;
  int count_;
};

}  // namespace cellcut::test
