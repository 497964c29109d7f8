#include "ui/viewer/script.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "ui/viewer/script_performer.h"

#include <algorithm>
#include <sstream>

namespace cellcut {
namespace {

/// A person's day of work has a hundredth of it.
constexpr std::uintmax_t kMaxScriptBytes = std::uintmax_t{1} << 20;

std::vector<std::string> split(const std::string& text, const std::string& place) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ' || text[i] == '\t' || text[i] == '\r') {
      ++i;
    } else if (text[i] == '#') {
      break;
    } else if (text[i] == '"') {
      const std::size_t end = text.find('"', i + 1);
      if (end == std::string::npos) throw InputError(place, "a quote has no end; add another");
      words.push_back(text.substr(i + 1, end - i - 1));
      i = end + 1;
    } else {
      const std::size_t end = text.find_first_of(" \t\r", i);
      words.push_back(text.substr(i, end - i));
      i = end == std::string::npos ? text.size() : end;
    }
  }
  return words;
}

struct Verb {
  std::string_view name;
  std::size_t words;                         ///< with the verb; 0: several forms
  void (ScriptPerformer::*perform)() const;  ///< null: the script ends
};
constexpr Verb kVerbs[] = {
    {"size", 3, &ScriptPerformer::size},     {"click", 2, &ScriptPerformer::click},
    {"set", 3, &ScriptPerformer::set},       {"drag", 6, &ScriptPerformer::drag},
    {"move", 3, &ScriptPerformer::move},     {"scroll", 4, &ScriptPerformer::scroll},
    {"key", 2, &ScriptPerformer::key},       {"pick", 3, &ScriptPerformer::pick},
    {"view", 13, &ScriptPerformer::view},    {"drop", 2, &ScriptPerformer::drop},
    {"wait", 0, &ScriptPerformer::wait},     {"screenshot", 2, &ScriptPerformer::screenshot},
    {"expect", 3, &ScriptPerformer::expect}, {"quit", 1, nullptr},
};

const Verb* findVerb(std::string_view name) {
  const auto* verb = std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const Verb& v) { return v.name == name; });
  return verb == std::end(kVerbs) ? nullptr : verb;
}

void checkAction(const ScriptAction& action) {
  const std::vector<std::string>& words = action.words;
  const Verb* verb = findVerb(words[0]);
  if (!verb) {
    throw InputError(action.place, "no action '" + printable(words[0]) + "'; cellcut view --help lists them");
  }
  if (verb->words > 0 && words.size() != verb->words) {
    throw InputError(action.place, "'" + words[0] + "' takes " + std::to_string(verb->words - 1) +
                                       " words; names of several words stand in quotes");
  }
  if (words[0] == "wait") {
    const bool idle = words.size() == 2 && words[1] == "idle";
    const bool spp = words.size() == 3 && words[1] == "spp";
    if (!idle && !spp) throw InputError(action.place, "'wait' is followed by 'idle' or by 'spp N'");
  }
  if (words[0] == "screenshot" && lowerExtension(words[1]) != ".png") {
    throw InputError(action.place, "'" + words[1] + "' does not end in .png, as a screenshot does");
  }
}

}  // namespace

std::vector<ScriptAction> readScript(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = readFile(file, kMaxScriptBytes);
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::vector<ScriptAction> actions;
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    const std::string place = file.string() + ":" + std::to_string(++line);
    ScriptAction action{place, split(text, place)};
    if (action.words.empty()) continue;
    checkAction(action);
    actions.push_back(std::move(action));
  }
  return actions;
}

void playScript(std::span<const ScriptAction> actions, const std::filesystem::path& folder, Viewer& viewer,
                Window& window) {
  // Two frames: the first one sizes the rendering, the second shows it.
  drawScriptFrames(viewer, window, 2);
  for (const ScriptAction& action : actions) {
    const Verb& verb = *findVerb(action.words[0]);
    if (!verb.perform) return;
    (ScriptPerformer(action, folder, viewer, window).*verb.perform)();
  }
}

}  // namespace cellcut
