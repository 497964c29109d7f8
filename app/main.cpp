#include "app/command_line.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <unistd.h>

namespace {

std::terminate_handler ordinaryEnd;
bool started = false;  ///< main() was called

/// Nobody can catch what global objects of libraries throw, who ask for memory before main(), nor what destructors of
/// nlohmann-json do. std::cerr may not be there yet, and an exception that does not fit into memory is none.
void endUncaught() {
  bool noMemory = !started;
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    noMemory = true;
  } catch (...) {
  }
  if (!noMemory) ordinaryEnd();
  std::fputs(cellcut::kNotEnoughMemory, stderr);
  std::_Exit(cellcut::kFailed);
}

void handleUncaught() {
  ordinaryEnd = std::set_terminate(endUncaught);
}

/// Called before the constructors of all global objects, those of shared libraries too.
[[gnu::used, gnu::section(".preinit_array")]] void (*const beforeLibraries)() = handleUncaught;

}  // namespace

int main(int argc, char** argv) {
  started = true;
  const std::span<const char* const> args(argv, static_cast<std::size_t>(argc));
  return cellcut::runCommandLine(args, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
}
