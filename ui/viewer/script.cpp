#include "ui/viewer/script.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/base/stopwatch.h"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace cellcut {
namespace {

/// What a frame of a script takes for animations: the same picture on any machine.
constexpr double kFrameSeconds = 1.0 / 60;
constexpr double kLongestWait = 600;  // seconds
/// A person's day of work has a hundredth of it.
constexpr std::uintmax_t kMaxScriptBytes = std::uintmax_t{1} << 20;
/// More than panels take to come to rest; what still moves then (a row that scrolls) is taken where it is.
constexpr int kMostUnsettledFrames = 10;

struct Verb {
  std::string_view name;
  std::size_t words;  ///< with the verb
};
constexpr Verb kVerbs[] = {{"size", 3},       {"click", 2},  {"set", 3}, {"drag", 6}, {"scroll", 4},
                           {"move", 3},       {"view", 13},  {"key", 2}, {"pick", 3}, {"drop", 2},
                           {"screenshot", 2}, {"expect", 3}, {"quit", 1}};

std::string placeOf(const std::filesystem::path& file, int line) {
  return file.string() + ":" + std::to_string(line);
}

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

void checkAction(const ScriptAction& action, const std::string& place) {
  if (action.words[0] == "wait") {
    const bool idle = action.words.size() == 2 && action.words[1] == "idle";
    const bool spp = action.words.size() == 3 && action.words[1] == "spp";
    if (!idle && !spp) throw InputError(place, "'wait' is followed by 'idle' or by 'spp N'");
    return;
  }
  for (const Verb& verb : kVerbs) {
    if (verb.name != action.words[0]) continue;
    if (action.words.size() == verb.words) {
      if (verb.name == "screenshot" && lowerExtension(action.words[1]) != ".png") {
        throw InputError(place, "'" + action.words[1] + "' does not end in .png, as a screenshot does");
      }
      return;
    }
    throw InputError(place, "'" + action.words[0] + "' takes " + std::to_string(verb.words - 1) +
                                " words; names of several words stand in quotes");
  }
  throw InputError(place, "no action '" + printable(action.words[0]) + "'; cellcut view --help lists them");
}

std::optional<double> asNumber(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::vector<ScriptAction> readScript(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = readFile(file, kMaxScriptBytes);
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::vector<ScriptAction> actions;
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ScriptAction action{++line, split(text, placeOf(file, line))};
    if (action.words.empty()) continue;
    checkAction(action, placeOf(file, line));
    actions.push_back(std::move(action));
  }
  return actions;
}

ScriptPlayer::ScriptPlayer(std::filesystem::path name, std::vector<ScriptAction> actions, std::filesystem::path folder)
    : name_(std::move(name)), actions_(std::move(actions)), folder_(std::move(folder)) {}

void ScriptPlayer::fail(const ScriptAction& action, const std::string& problem) const {
  throw InputError(placeOf(name_, action.line), problem);
}

float ScriptPlayer::number(const ScriptAction& action, std::size_t word) const {
  const std::optional<double> value = asNumber(action.words[word]);
  if (!value) fail(action, "'" + action.words[word] + "' is no number");
  return static_cast<float>(*value);
}

Vec2 ScriptPlayer::position(const ScriptAction& action, std::size_t word) const {
  return {number(action, word), number(action, word + 1)};
}

WidgetItem ScriptPlayer::item(const ScriptAction& action, Stage& stage, const std::string& label) const {
  waitUntil(action, stage,
            [&] { return stage.viewer.widgets().find(label) || stage.viewer.settled() || stage.viewer.panelsHeld(); });
  const WidgetItem* found = stage.viewer.widgets().find(label);
  if (found && !found->visible) {
    stage.viewer.reveal(label);
    frames(stage, 2);
  }
  return still(action, stage, label);
}

WidgetItem ScriptPlayer::still(const ScriptAction& action, Stage& stage, const std::string& label) const {
  std::optional<WidgetItem> before;
  // A panel whose content has just grown takes some frames until its scroll bar, its wrapped lines and its scrolling
  // agree.
  for (int i = 0; i < kMostUnsettledFrames; ++i) {
    const WidgetItem* found = stage.viewer.widgets().find(label);
    if (!found) failMissing(action, stage, label);
    if (before && before->lower == found->lower && before->upper == found->upper) break;
    before = *found;
    frames(stage, 1);
  }
  return *before;
}

void ScriptPlayer::failMissing(const ScriptAction& action, const Stage& stage, const std::string& label) const {
  std::string known;
  for (const WidgetItem& i : stage.viewer.widgets().items()) known += (known.empty() ? "" : ", ") + i.label;
  fail(action, "nothing is labelled '" + label + "'; there are " + known);
}

void ScriptPlayer::play(Viewer& viewer, Window& window) {
  Stage stage{viewer, window};
  // Two frames: the first one sizes the rendering, the second shows it.
  frames(stage, 2);
  for (const ScriptAction& action : actions_) {
    if (action.words[0] == "quit") return;
    perform(action, stage);
  }
}

void ScriptPlayer::frames(Stage& stage, int count) const {
  for (int i = 0; i < count; ++i) {
    stage.window.pollEvents();
    stage.viewer.frame(kFrameSeconds);
  }
}

namespace {

/// A widget stays where it is from when it is found to when it has been clicked.
class StillPanels {
 public:
  explicit StillPanels(Viewer& viewer) : viewer_(viewer) { viewer_.holdPanels(true); }
  ~StillPanels() { viewer_.holdPanels(false); }
  StillPanels(const StillPanels&) = delete;
  StillPanels& operator=(const StillPanels&) = delete;

 private:
  Viewer& viewer_;
};

}  // namespace

void ScriptPlayer::waitUntil(const ScriptAction& action, Stage& stage, const std::function<bool()>& done) const {
  for (const Stopwatch waited; !done(); frames(stage, 1)) {
    if (waited.seconds() > kLongestWait) fail(action, "waited for ten minutes");
    // Until there is news: frames drawn meanwhile would take the cores from the rendering.
    stage.window.waitEvents(0.1);
  }
}

void ScriptPlayer::clickAt(Stage& stage, Vec2 position, MouseButton button) const {
  stage.window.post(MouseMove{position});
  frames(stage, 1);
  stage.window.post(MouseButtonChange{button, true});
  frames(stage, 1);
  stage.window.post(MouseButtonChange{button, false});
  frames(stage, 2);
}

void ScriptPlayer::press(const ScriptAction& action, Stage& stage, const std::string& keys) const {
  std::vector<Key> pressed;
  for (std::size_t begin = 0; begin <= keys.size();) {
    const std::size_t end = std::min(keys.find('+', begin), keys.size());
    const std::optional<Key> key = keyFromName(keys.substr(begin, end - begin));
    if (!key) fail(action, "no key is called '" + printable(keys) + "'; F1 in the viewer shows them");
    pressed.push_back(*key);
    begin = end + 1;
  }
  for (const Key key : pressed) {
    stage.window.post(KeyChange{key, true});
    frames(stage, 1);
  }
  for (auto key = pressed.rbegin(); key != pressed.rend(); ++key) {
    stage.window.post(KeyChange{*key, false});
    frames(stage, 1);
  }
}

void ScriptPlayer::type(Stage& stage, const std::string& text) const {
  for (const char c : text) {
    stage.window.post(TextInput{static_cast<char32_t>(static_cast<unsigned char>(c))});
    frames(stage, 1);
  }
}

void ScriptPlayer::set(const ScriptAction& action, Stage& stage) const {
  const WidgetItem target = item(action, stage, action.words[1]);
  const std::string& value = action.words[2];
  const Vec2 middle = 0.5f * (target.lower + target.upper);
  switch (target.kind) {
    case WidgetItem::Kind::kCheckbox:
      if (value != "on" && value != "off") fail(action, "'" + action.words[1] + "' is on or off");
      if (target.value != value) clickAt(stage, {target.lower.x + 0.5f * (target.upper.y - target.lower.y), middle.y});
      return;
    case WidgetItem::Kind::kChoice: {
      clickAt(stage, middle);
      const WidgetItem* option = stage.viewer.widgets().findOption(value);
      if (option && !option->visible) {
        stage.viewer.reveal(value);
        frames(stage, 2);
        option = stage.viewer.widgets().findOption(value);
      }
      if (!option) failMissing(action, stage, value);
      clickAt(stage, 0.5f * (option->lower + option->upper));
      return;
    }
    case WidgetItem::Kind::kNumber:
      number(action, 2);  // refuses what is none
      // Ctrl+click turns a slider into a field; a field takes it as a click.
      stage.window.post(KeyChange{Key::kLeftControl, true});
      frames(stage, 1);
      clickAt(stage, middle);
      stage.window.post(KeyChange{Key::kA, true});
      frames(stage, 1);
      stage.window.post(KeyChange{Key::kA, false});
      stage.window.post(KeyChange{Key::kLeftControl, false});
      frames(stage, 2);
      type(stage, value);
      press(action, stage, "Enter");
      frames(stage, 2);
      return;
    default:
      fail(action, "'" + action.words[1] + "' cannot be set; click it");
  }
}

void ScriptPlayer::drag(const ScriptAction& action, Stage& stage) const {
  const auto name = std::find(kMouseButtonNames.begin(), kMouseButtonNames.end(), action.words[1]);
  if (name == kMouseButtonNames.end()) fail(action, "'" + action.words[1] + "' is none of left, right, middle");
  const auto button = static_cast<MouseButton>(name - kMouseButtonNames.begin());
  const Vec2 from = position(action, 2), to = position(action, 4);
  stage.window.post(MouseMove{from});
  frames(stage, 1);
  stage.window.post(MouseButtonChange{button, true});
  frames(stage, 1);
  constexpr int kSteps = 5;
  for (int i = 1; i <= kSteps; ++i) {
    stage.window.post(MouseMove{from + (to - from) * (static_cast<float>(i) / kSteps)});
    frames(stage, 1);
  }
  stage.window.post(MouseButtonChange{button, false});
  frames(stage, 2);
}

void ScriptPlayer::paste(const ScriptAction& action, Stage& stage) const {
  const auto vector = [&](std::size_t word) {
    return Vec3(number(action, word), number(action, word + 1), number(action, word + 2));
  };
  CameraPose pose;
  pose.camera.position = vector(1);
  pose.camera.back = vector(4);
  pose.camera.up = vector(7);
  pose.camera.halfHeight = number(action, 10);
  pose.focus = number(action, 11);
  const std::string& projection = action.words[12];
  pose.camera.orthographic = projection == "orthographic";
  if (!pose.camera.orthographic && projection != "perspective") {
    fail(action, "'" + projection + "' is neither perspective nor orthographic");
  }
  stage.window.setClipboard(poseToJson(pose));
  press(action, stage, "Ctrl+V");
}

void ScriptPlayer::wait(const ScriptAction& action, Stage& stage) const {
  const bool idle = action.words[1] == "idle";
  const double passes = idle ? 0 : static_cast<double>(number(action, 2));
  frames(stage, 1);
  int ended = 0;  // frames since the rendering has
  waitUntil(action, stage, [&] {
    const std::shared_ptr<const Snapshot> snapshot = stage.viewer.session().snapshot();
    const bool done =
        idle ? stage.viewer.atRest() : !snapshot->preview && static_cast<double>(snapshot->passes) >= passes;
    if (stage.viewer.settled() && done) return true;
    // More frames than a new size takes to reach the rendering.
    ended = stage.viewer.reachedLimit() ? ended + 1 : 0;
    if (!idle && ended > kMostUnsettledFrames) {
      fail(action, "the rendering has ended at its limit, with " + std::to_string(snapshot->passes) +
                       " samples per pixel; wait for no more of them, or raise the limit before");
    }
    return false;
  });
  frames(stage, 2);
}

void ScriptPlayer::expect(const ScriptAction& action, Stage& stage) const {
  const std::string shown = item(action, stage, action.words[1]).value;
  const auto a = asNumber(shown), b = asNumber(action.words[2]);
  // Sliders show six digits.
  const bool equal =
      a && b ? std::abs(*a - *b) <= 1e-5 * std::max(std::abs(*a), std::abs(*b)) : shown == action.words[2];
  if (!equal) fail(action, "'" + action.words[1] + "' is '" + shown + "' and not '" + action.words[2] + "'");
}

void ScriptPlayer::perform(const ScriptAction& action, Stage& stage) {
  const std::vector<std::string>& words = action.words;
  const auto at = [&](std::size_t word) { return position(action, word); };
  if (words[0] == "size") {
    const Vec2 size = at(1);
    if (!(size.x >= 64 && size.y >= 64 && size.x <= 16384 && size.y <= 16384)) fail(action, "64 to 16384 pixels each");
    stage.window.resize({static_cast<int>(size.x), static_cast<int>(size.y)});
    frames(stage, 6);
  } else if (words[0] == "click") {
    item(action, stage, words[1]);  // waits for one that is looked up still
    const StillPanels hold(stage.viewer);
    frames(stage, 1);
    const WidgetItem target = item(action, stage, words[1]);
    clickAt(stage, 0.5f * (target.lower + target.upper));
  } else if (words[0] == "set") {
    item(action, stage, words[1]);
    const StillPanels hold(stage.viewer);
    frames(stage, 1);
    set(action, stage);
  } else if (words[0] == "drag") {
    drag(action, stage);
  } else if (words[0] == "move") {
    stage.window.post(MouseMove{at(1)});
    frames(stage, 2);
  } else if (words[0] == "view") {
    paste(action, stage);
  } else if (words[0] == "scroll") {
    stage.window.post(MouseMove{at(1)});
    frames(stage, 1);
    stage.window.post(Scroll{{0, number(action, 3)}});
    frames(stage, 2);
  } else if (words[0] == "key") {
    press(action, stage, words[1]);
  } else if (words[0] == "pick") {
    waitUntil(action, stage, [&] { return stage.viewer.settled(); });
    const std::shared_ptr<const Snapshot> picture = stage.viewer.session().snapshot();
    const Vec2 pixel = at(1);
    if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(picture->width) &&
          pixel.y < static_cast<float>(picture->height))) {
      fail(action, "the picture has " + std::to_string(picture->width) + " x " + std::to_string(picture->height) +
                       " pixels, counted from 0");
    }
    clickAt(stage, stage.viewer.placement().toFramebuffer(pixel + 0.5f));
  } else if (words[0] == "drop") {
    stage.window.postDrop(folder_ / words[1]);
    frames(stage, 2);
  } else if (words[0] == "wait") {
    wait(action, stage);
  } else if (words[0] == "expect") {
    frames(stage, 1);
    expect(action, stage);
  } else if (words[0] == "screenshot") {
    frames(stage, 1);
    writeFileAtomically(writtenFile(folder_ / words[1]), encodePng(stage.viewer.picture()));
  }
}

}  // namespace cellcut
