#include "tests/support/command_run.h"

#include "app/command_line.h"

#include <csignal>
#include <string_view>

namespace cellcut::test {

Outcome runCommand(const std::vector<std::string>& arguments, std::ostream* err, bool terminal) {
  std::vector<const char*> args{"cellcut"};
  for (const std::string& argument : arguments) args.push_back(argument.c_str());
  std::ostringstream out, ownErr;
  const int code = runCommandLine(args, out, err != nullptr ? *err : ownErr, terminal);
  return {code, out.str(), ownErr.str()};
}

std::streamsize InterruptingBuffer::xsputn(const char* text, std::streamsize size) {
  if (std::string_view(text, static_cast<std::size_t>(size)).find(text_) != std::string_view::npos && --count_ == 0) {
    std::raise(SIGINT);
  }
  return std::stringbuf::xsputn(text, size);
}

}  // namespace cellcut::test
