#include "app/command_line.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <sys/mman.h>
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

/// Global objects of libraries ask for memory before main() and end the program by a signal where there is none: Embree,
/// CLI11, oneTBB while it throws.
void requireMemoryOfLibraries() {
  constexpr std::size_t kBytes = std::size_t{8} << 20;  // they take 3 MB at most
  void* const block = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) {
    std::fputs(cellcut::kNotEnoughMemory, stderr);  // std::cerr is not there yet
    std::_Exit(cellcut::kFailed);
  }
  munmap(block, kBytes);
}

/// Called before the constructors of all global objects, those of shared libraries too.
[[gnu::used, gnu::section(".preinit_array")]] void (*const beforeLibraries)() = requireMemoryOfLibraries;

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(endInADestructor);
  const std::span<const char* const> args(argv, static_cast<std::size_t>(argc));
  return cellcut::runCommandLine(args, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
}
