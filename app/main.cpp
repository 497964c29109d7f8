#include "app/command_line.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <unistd.h>

namespace {

const std::terminate_handler ordinaryEnd = std::get_terminate();

/// Destructors of nlohmann-json ask for memory, and nobody can catch what they throw.
void endInADestructor() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::cerr << cellcut::kNotEnoughMemory << std::flush;
    std::_Exit(cellcut::kFailed);
  } catch (...) {
  }
  ordinaryEnd();
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(endInADestructor);
  const std::span<const char* const> args(argv, static_cast<std::size_t>(argc));
  return cellcut::runCommandLine(args, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
}
