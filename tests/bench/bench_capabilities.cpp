/// \file bench_capabilities.cpp
/// What a scene pays for what it lacks: passes of programs that can have all against passes of programs that cannot
/// have one thing (renderer/base/capabilities.h), on a scene that has none of them.
///
/// Instructions are those that Callgrind counts in a pass, the same in each run but for a few; where valgrind cannot
/// run them there is a dash. Seconds waver by a per cent with where a program lies in memory, so each round starts
/// programs anew.
#include "tests/bench/paired.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cellcut {
namespace {

constexpr int kRounds = 15;
constexpr int kPasses = 6;  ///< the fastest of them counts; the first ones find cells

std::string outputOf(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot start " + command);
  std::string text;
  for (std::array<char, 256> part; std::fgets(part.data(), part.size(), pipe);) text += part.data();
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command + "\n" + text);
  return text;
}

/// A program of plain_pass.cpp with what it is asked to render.
struct Passes {
  std::string program;
  std::string arguments;

  std::string command(int passes) const { return program + " " + arguments + " " + std::to_string(passes); }
};

struct Outcome {
  double seconds = 0;
  std::size_t bytes = 0;
  double sum = 0;
};

Outcome run(const Passes& passes) {
  Outcome outcome;
  const std::string text = outputOf(passes.command(kPasses));
  if (std::sscanf(text.c_str(), "%lf %zu %lf", &outcome.seconds, &outcome.bytes, &outcome.sum) != 3)
    throw std::runtime_error("no figures: " + text);
  return outcome;
}

double instructionsOf(const Passes& passes, int count) {
  const std::string text =
      outputOf("valgrind --tool=callgrind --callgrind-out-file=/dev/null " + passes.command(count) + " 2>&1");
  const std::size_t at = text.find("Collected : ");
  if (at == std::string::npos) throw std::runtime_error("Callgrind counted nothing:\n" + text);
  return std::stod(text.substr(at + 12));
}

/// Of a pass once the cells that it touches have been found.
double instructionsOf(const Passes& passes) {
  constexpr int kFirst = 3, kMore = 2;
  return (instructionsOf(passes, kFirst + kMore) - instructionsOf(passes, kFirst)) / kMore;
}

/// Whether there is a valgrind that knows all instructions of the libraries on this processor.
bool canCount(const Passes& passes) {
  return std::system(("valgrind --tool=none " + passes.command(1) + " > /dev/null 2>&1").c_str()) == 0;
}

std::string percent(double ratio) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%+.2f %%", 100 * (ratio - 1));
  return text.data();
}

/// A program that can have all, on one scene.
struct Baseline {
  Passes passes;
  std::optional<double> instructions;  ///< of a pass, where they can be counted

  explicit Baseline(const Passes& p) : passes(p) {
    if (canCount(p)) instructions = instructionsOf(p);
  }
};

void compare(const char* name, const Baseline& with, const Passes& without) {
  Outcome a, b;
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    if (round % 2 == 0) a = run(with.passes);
    b = run(without);
    if (round % 2 != 0) a = run(with.passes);
    ratios.push_back(a.seconds / b.seconds);
  }
  const auto at = [&](double share) { return percent(quantile(ratios, share)); };
  const std::string instructions = with.instructions ? percent(*with.instructions / instructionsOf(without)) : "–";
  std::printf("| %s | %s | %s (%s to %s) | %td |%s\n", name, instructions.c_str(), at(0.5).c_str(), at(0.25).c_str(),
              at(0.75).c_str(), static_cast<std::ptrdiff_t>(a.bytes) - static_cast<std::ptrdiff_t>(b.bytes),
              a.sum == b.sum ? "" : "  the pictures differ");
  std::fflush(stdout);
}

}  // namespace
}  // namespace cellcut

int main(int, char** argv) {
  using namespace cellcut;
  const std::string program(argv[0]);
  const std::string folder = program.substr(0, program.find_last_of('/') + 1);
  const auto passes = [&](const std::string& capability, const char* arguments) {
    return Passes{folder + "plain_pass_without_" + capability, arguments};
  };
  constexpr const char* kGlossy = "glossy 64 cell-cut";
  constexpr const char* kLambertian = "lambertian 64 cell-cut";
  std::printf("| a scene without | instructions | seconds (quartiles of %d rounds) | bytes |\n|---|---|---|---|\n",
              kRounds);
  const Baseline glossy(passes("nothing", kGlossy));
  compare("environment", glossy, passes("environment", kGlossy));
  compare("textures", glossy, passes("textures", kGlossy));
  compare("spots", glossy, passes("spots", kGlossy));
  compare("distant lights", glossy, passes("distant_lights", kGlossy));
  compare("alpha", glossy, passes("alpha", kGlossy));
  compare("GGX", Baseline(passes("nothing", kLambertian)), passes("ggx", kLambertian));
  // No program is without a second light: uniform is what needs nothing for it.
  compare("a second light", Baseline(passes("nothing", "glossy 1 cell-cut")), passes("nothing", "glossy 1 uniform"));
}
