#include "ui/viewer/script_performer.h"

#include "renderer/base/image_io.h"
#include "renderer/base/stopwatch.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace cellcut {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;
constexpr double kLongestWait = 600;  // seconds
/// More than panels take to come to rest; what still moves then (a row that scrolls) is taken where it is.
constexpr int kMostUnsettledFrames = 10;

std::optional<double> asNumber(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

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

void drawScriptFrames(Viewer& viewer, Window& window, int count) {
  for (int i = 0; i < count; ++i) {
    window.pollEvents();
    viewer.frame(kFrameSeconds);
  }
}

float ScriptPerformer::number(std::size_t word) const {
  const std::optional<double> value = asNumber(words_[word]);
  if (!value) fail("'" + words_[word] + "' is no number");
  return static_cast<float>(*value);
}

WidgetItem ScriptPerformer::item(const std::string& label) const {
  waitUntil([&] { return viewer_.widgets().find(label) || viewer_.settled() || viewer_.panelsHeld(); });
  const WidgetItem* found = viewer_.widgets().find(label);
  if (found && !found->visible) {
    viewer_.reveal(label);
    frames(2);
  }
  return still(label);
}

WidgetItem ScriptPerformer::still(const std::string& label) const {
  std::optional<WidgetItem> before;
  // A panel whose content has just grown takes some frames until its scroll bar, its wrapped lines and its scrolling
  // agree.
  for (int i = 0; i < kMostUnsettledFrames; ++i) {
    const WidgetItem* found = viewer_.widgets().find(label);
    if (!found) failMissing(label);
    if (before && before->lower == found->lower && before->upper == found->upper) break;
    before = *found;
    frames(1);
  }
  return *before;
}

void ScriptPerformer::failMissing(const std::string& label) const {
  std::string known;
  for (const WidgetItem& i : viewer_.widgets().items()) known += (known.empty() ? "" : ", ") + i.label;
  fail("nothing is labelled '" + label + "'; there are " + known);
}

void ScriptPerformer::waitUntil(const std::function<bool()>& done) const {
  for (const Stopwatch waited; !done(); frames(1)) {
    if (waited.seconds() > kLongestWait) fail("waited for ten minutes");
    // Until there is news: frames drawn meanwhile would take the cores from the rendering.
    window_.waitEvents(0.1);
  }
}

void ScriptPerformer::clickAt(Vec2 position, MouseButton button) const {
  window_.post(MouseMove{position});
  frames(1);
  window_.post(MouseButtonChange{button, true});
  frames(1);
  window_.post(MouseButtonChange{button, false});
  frames(2);
}

void ScriptPerformer::press(const std::string& keys) const {
  std::vector<Key> pressed;
  for (std::size_t begin = 0; begin <= keys.size();) {
    const std::size_t end = std::min(keys.find('+', begin), keys.size());
    const std::optional<Key> key = keyFromName(keys.substr(begin, end - begin));
    if (!key) fail("no key is called '" + printable(keys) + "'; F1 in the viewer shows them");
    pressed.push_back(*key);
    begin = end + 1;
  }
  for (const Key key : pressed) {
    window_.post(KeyChange{key, true});
    frames(1);
  }
  for (auto key = pressed.rbegin(); key != pressed.rend(); ++key) {
    window_.post(KeyChange{*key, false});
    frames(1);
  }
}

void ScriptPerformer::type(const std::string& text) const {
  for (const char c : text) {
    window_.post(TextInput{static_cast<char32_t>(static_cast<unsigned char>(c))});
    frames(1);
  }
}

void ScriptPerformer::size() const {
  const Vec2 size = position(1);
  if (!(size.x >= 64 && size.y >= 64 && size.x <= 16384 && size.y <= 16384)) fail("64 to 16384 pixels each");
  window_.resize({static_cast<int>(size.x), static_cast<int>(size.y)});
  frames(6);
}

void ScriptPerformer::click() const {
  item(words_[1]);  // waits for one that is looked up still
  const StillPanels hold(viewer_);
  frames(1);
  const WidgetItem target = item(words_[1]);
  clickAt(0.5f * (target.lower + target.upper));
}

void ScriptPerformer::set() const {
  item(words_[1]);
  const StillPanels hold(viewer_);
  frames(1);
  const WidgetItem target = item(words_[1]);
  const std::string& value = words_[2];
  const Vec2 middle = 0.5f * (target.lower + target.upper);
  switch (target.kind) {
    case WidgetItem::Kind::kCheckbox:
      if (value != "on" && value != "off") fail("'" + words_[1] + "' is on or off");
      if (target.value != value) clickAt({target.lower.x + 0.5f * (target.upper.y - target.lower.y), middle.y});
      return;
    case WidgetItem::Kind::kChoice: {
      clickAt(middle);
      const WidgetItem* option = viewer_.widgets().findOption(value);
      if (option && !option->visible) {
        viewer_.reveal(value);
        frames(2);
        option = viewer_.widgets().findOption(value);
      }
      if (!option) failMissing(value);
      clickAt(0.5f * (option->lower + option->upper));
      return;
    }
    case WidgetItem::Kind::kNumber:
    case WidgetItem::Kind::kWhole:
      if (target.kind == WidgetItem::Kind::kNumber) {
        number(2);  // refuses what is none
      } else if (!wholeNumber(value)) {
        fail("'" + value + "' is no whole number, of digits alone");
      }
      // Ctrl+click turns a slider into a field; a field takes it as a click.
      window_.post(KeyChange{Key::kLeftControl, true});
      frames(1);
      clickAt(middle);
      window_.post(KeyChange{Key::kA, true});
      frames(1);
      window_.post(KeyChange{Key::kA, false});
      window_.post(KeyChange{Key::kLeftControl, false});
      frames(2);
      type(value);
      press("Enter");
      frames(2);
      return;
    default:
      fail("'" + words_[1] + "' cannot be set; click it");
  }
}

void ScriptPerformer::drag() const {
  const auto name = std::find(kMouseButtonNames.begin(), kMouseButtonNames.end(), words_[1]);
  if (name == kMouseButtonNames.end()) fail("'" + words_[1] + "' is none of left, right, middle");
  const auto button = static_cast<MouseButton>(name - kMouseButtonNames.begin());
  const Vec2 from = position(2), to = position(4);
  window_.post(MouseMove{from});
  frames(1);
  window_.post(MouseButtonChange{button, true});
  frames(1);
  constexpr int kSteps = 5;
  for (int i = 1; i <= kSteps; ++i) {
    window_.post(MouseMove{from + (to - from) * (static_cast<float>(i) / kSteps)});
    frames(1);
  }
  window_.post(MouseButtonChange{button, false});
  frames(2);
}

void ScriptPerformer::move() const {
  window_.post(MouseMove{position(1)});
  frames(2);
}

void ScriptPerformer::scroll() const {
  window_.post(MouseMove{position(1)});
  frames(1);
  window_.post(Scroll{{0, number(3)}});
  frames(2);
}

void ScriptPerformer::pick() const {
  waitUntil([&] { return viewer_.settled(); });
  const std::shared_ptr<const Snapshot> picture = viewer_.session().snapshot();
  const Vec2 pixel = position(1);
  if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(picture->width) &&
        pixel.y < static_cast<float>(picture->height))) {
    fail("the picture has " + std::to_string(picture->width) + " x " + std::to_string(picture->height) +
         " pixels, counted from 0");
  }
  clickAt(viewer_.placement().toFramebuffer(pixel + 0.5f));
}

void ScriptPerformer::view() const {
  const auto vector = [&](std::size_t word) { return Vec3(number(word), number(word + 1), number(word + 2)); };
  CameraPose pose;
  pose.camera.position = vector(1);
  pose.camera.back = vector(4);
  pose.camera.up = vector(7);
  pose.camera.halfHeight = number(10);
  pose.focus = number(11);
  const std::string& projection = words_[12];
  pose.camera.orthographic = projection == "orthographic";
  if (!pose.camera.orthographic && projection != "perspective") {
    fail("'" + projection + "' is neither perspective nor orthographic");
  }
  window_.setClipboard(poseToJson(pose));
  press("Ctrl+V");
}

void ScriptPerformer::drop() const {
  window_.postDrop(folder_ / words_[1]);
  frames(2);
}

void ScriptPerformer::wait() const {
  const bool idle = words_[1] == "idle";
  const double passes = idle ? 0 : static_cast<double>(number(2));
  frames(1);
  int ended = 0;  // frames since the rendering has
  waitUntil([&] {
    const std::shared_ptr<const Snapshot> snapshot = viewer_.session().snapshot();
    const bool done = idle ? viewer_.atRest() : !snapshot->preview && static_cast<double>(snapshot->passes) >= passes;
    if (viewer_.settled() && done) return true;
    // More frames than a new size takes to reach the rendering.
    ended = viewer_.reachedLimit() ? ended + 1 : 0;
    if (!idle && ended > kMostUnsettledFrames) {
      fail("the rendering has ended at its limit, with " + std::to_string(snapshot->passes) +
           " samples per pixel; wait for no more of them, or raise the limit before");
    }
    return false;
  });
  frames(2);
}

void ScriptPerformer::screenshot() const {
  frames(1);
  writeFileAtomically(writtenFile(folder_ / words_[1]), encodePng(viewer_.picture()));
}

void ScriptPerformer::expect() const {
  frames(1);
  const WidgetItem target = item(words_[1]);
  const std::string& shown = target.value;
  const auto a = asNumber(shown), b = asNumber(words_[2]);
  // Sliders show six digits.
  const bool isReal = a && b && target.kind != WidgetItem::Kind::kWhole;
  const bool equal = isReal ? std::abs(*a - *b) <= 1e-5 * std::max(std::abs(*a), std::abs(*b)) : shown == words_[2];
  if (!equal) fail("'" + words_[1] + "' is '" + shown + "' and not '" + words_[2] + "'");
}

}  // namespace cellcut
