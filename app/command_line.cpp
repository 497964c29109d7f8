#include "app/command_line.h"

#include "app/console.h"
#include "app/verbs.h"
#include "renderer/base/error.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace cellcut {
namespace {

/// One argument in the form in which a POSIX shell reads it back.
std::string quoted(const std::string& argument) {
  const auto isPlain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=+,:@%").find(c) != std::string_view::npos;
  };
  if (!argument.empty() && std::all_of(argument.begin(), argument.end(), isPlain)) return argument;
  std::string result = "'";
  for (const char c : argument) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string joined(std::span<const char* const> args) {
  std::string line = "cellcut";
  for (const char* argument : args.subspan(std::min<std::size_t>(1, args.size()))) line += " " + quoted(argument);
  return line;
}

/// Nor with anything that commands a terminal: texts may quote files.
std::string oneLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text, text.size());
}

/// Help and version are no errors, though the parser reports them as such.
int reportParseOutcome(const CLI::App& program, const CLI::ParseError& outcome, const Console& console) {
  if (outcome.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    program.exit(outcome, console.out, console.err);
    return kDone;
  }
  const auto chosen = program.get_subcommands();
  const std::string place = chosen.empty() ? "cellcut" : "cellcut " + chosen.front()->get_name();
  std::string problem = outcome.what();
  if (outcome.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {  // whose text has them backwards
    problem = "not expected:";
    for (const std::string& argument : program.remaining(true)) problem += ' ' + argument;
  }
  console.err << place << ": " << oneLine(problem) << "; see '" << place << " --help'\n";
  return kBadInput;
}

#ifdef CELLCUT_UI
/// `cellcut` and `cellcut SCENE` are `cellcut view`: the verb is put in where there is none.
std::vector<const char*> withVerb(std::span<const char* const> args, const CLI::App& program) {
  std::vector<const char*> completed(args.begin(), args.end());
  const std::string first = args.size() > 1 ? args[1] : "";
  const bool ofProgram = first == "--help" || first == "-h" || first == "--version";
  const auto verbs = program.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == first; });
  // A word that is neither a verb nor a file is a verb that was mistyped.
  const bool isWord = !first.empty() && first[0] != '-' && first.find('.') == std::string::npos;
  if (ofProgram || !verbs.empty() || isWord || completed.empty()) return completed;
  completed.insert(completed.begin() + 1, "view");
  return completed;
}
#endif

int parseAndRun(std::span<const char* const> args, const Console& console) {
  CLI::App program("Renders scenes with very many lights.", "cellcut");
  program.set_version_flag("--version", "cellcut " CELLCUT_VERSION);
  program.require_subcommand(0, 1);
  program.get_formatter()->column_width(36);
  program.get_formatter()->label("SUBCOMMAND", "VERB");
  program.footer("Each verb has its own help with examples: cellcut render --help");
#ifdef CELLCUT_UI
  const std::array verbs{addView(program),    addScreenshot(program), addRender(program), addMeasure(program),
                         addCompare(program), addGenerate(program),   addInfo(program)};
  const std::vector<const char*> completed = withVerb(args, program);
#else
  const std::array verbs{addRender(program), addMeasure(program), addCompare(program), addGenerate(program),
                         addInfo(program)};
  const std::vector<const char*> completed(args.begin(), args.end());
#endif
  try {
    program.parse(static_cast<int>(completed.size()), completed.data());
  } catch (const CLI::ParseError& outcome) {
    return reportParseOutcome(program, outcome, console);
  }
  for (const Verb& verb : verbs) {
    if (verb.parser->parsed()) return verb.run(console);
  }
  console.err << program.help();
  return kBadInput;
}

}  // namespace

int runCommandLine(std::span<const char* const> args, std::ostream& out, std::ostream& err, bool terminal) {
  try {
    const Console console{out, err, terminal, joined(args)};
    const int code = parseAndRun(args, console);
    if (code == kDone && !out.flush()) {
      throw std::runtime_error("standard output: cannot be written to its end; make room or send it elsewhere");
    }
    return code;
  } catch (const InputError& error) {
    err << "cellcut: " << oneLine(error.what()) << '\n';
    return kBadInput;
  } catch (const std::bad_alloc&) {
    err << kNotEnoughMemory;
    return kFailed;
  } catch (const std::exception& error) {
    err << "cellcut: " << oneLine(error.what()) << '\n';
    return kFailed;
  }
}

}  // namespace cellcut
