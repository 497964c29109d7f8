#include "app/options.h"
#include "tests/fuzz/fuzzing.h"

#include <CLI/CLI.hpp>

// Each line is an argument of `render`.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcut;
  std::vector<std::string> arguments(1);
  for (const char c : std::string_view(reinterpret_cast<const char*>(data), size)) {
    if (c == '\n') {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes a vector
  return fuzz::read([&] {
    CLI::App render;
    RenderOptions options;
    addRenderOptions(render, options);
    try {
      render.parse(arguments);
    } catch (const CLI::ParseError&) {
    }
  });
}
