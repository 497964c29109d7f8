#include "app/command_line.h"

#include <iostream>
#include <span>
#include <unistd.h>

int main(int argc, char** argv) {
  const std::span<const char* const> args(argv, static_cast<std::size_t>(argc));
  return cellcut::runCommandLine(args, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
}
