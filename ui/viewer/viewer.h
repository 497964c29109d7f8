/// \file viewer.h
/// The interactive viewer: a render session, the panels that change it, and the picture with what is drawn over it.
///
/// One object whatever the window: tests and scripts drive the code that a person drives. Threads: the window's.
#pragma once

#include "renderer/trace/session.h"
#include "ui/gl_framebuffer.h"
#include "ui/gui.h"
#include "ui/image_view.h"
#include "ui/viewer/convergence.h"
#include "ui/viewer/duel.h"
#include "ui/viewer/overlay_source.h"
#include "ui/viewer/panels.h"
#include "ui/viewer/recent_files.h"
#include "ui/viewer/reference.h"
#include "ui/viewer/script_recorder.h"
#include "ui/viewer/trade.h"
#include "ui/viewer/viewer_state.h"
#include "ui/viewer/widgets.h"
#include "ui/window.h"

#include <filesystem>
#include <functional>
#include <future>
#include <memory>

namespace cellcut {

/// Where scenes come from; runs on a thread of its own.
/// \throws InputError if the file cannot be used
using SceneLoader = std::function<std::shared_ptr<const Scene>(const std::filesystem::path&)>;

struct ViewerOptions {
  ViewerState state;
  float uiScale = 1;                                  ///< [0.5, 4]
  std::filesystem::path file;                         ///< of the scene, for F5
  std::filesystem::path saveFolder = ".";             ///< of F12
  std::shared_ptr<const ImageRgb> reference;          ///< for errors; may be null
  std::optional<std::filesystem::path> recentFiles;   ///< where the list of recent files is kept
  std::optional<std::filesystem::path> record;        ///< what the person does is written there as a script
  std::optional<std::uint64_t> sizeSettleFrames = 3;  ///< frames of one size before the rendering follows the window
};

class Viewer {
 public:
  /// \pre the window's context is current, in every member. The window outlives the viewer.
  Viewer(Window& window, std::shared_ptr<const Scene> scene, SceneLoader loader, ViewerOptions options);
  ~Viewer();

  /// Input, panels, edits, drawing; shows it in the window.
  /// \param seconds  since the last frame
  /// \throws GlError when OpenGL has failed for many frames in a row; one that works again goes on
  void frame(double seconds);
  /// How long the window may sleep when nothing comes in; 0 while there is something to animate.
  double sleepSeconds() const;

  /// Nothing more is recorded. \throws std::runtime_error if not all that was done could be
  void endRecording();

  /// What the last frame drew.
  ImageRgba8 picture() const { return framebuffer_->read(); }
  /// Opens a scene file as if it had been dropped onto the window.
  void open(const std::filesystem::path& file);

  const Widgets& widgets() const { return shown_; }
  /// News (snapshots, what is looked up, loaded scenes) wait until they are let in: panels do not move meanwhile.
  void holdPanels(bool hold) { panelsHeld_ = hold; }
  bool panelsHeld() const { return panelsHeld_; }
  /// Scrolls a panel to the widget of that label, in the next frame.
  void reveal(std::string label) { reveal_ = std::move(label); }
  ViewerState& state() { return state_; }
  RenderSession& session() { return session_; }
  const OverlayPicture* overlay() const { return overlay_ ? &*overlay_ : nullptr; }
  const std::string& problem() const { return problem_; }
  const std::string& notice() const { return notice_; }
  PixelRect imageArea() const { return area_; }
  ImagePlacement placement() const { return placement_; }
  /// Whether the snapshot that is shown is of the newest edit and nothing is being loaded or looked up.
  bool settled() const;
  /// Whether the next frame may show what somebody waits for: an edit has no picture yet, or what was loaded, saved or
  /// looked up is there.
  bool hasNewsOfEdits() const;
  /// Whether nothing is left to do: no pass, no turn of a duel, no reference, no measurement.
  bool atRest() const;
  /// Whether it is at rest for a limit's sake: without an edit no sample comes any more.
  bool reachedLimit() const;
  const Reference& reference() const { return reference_; }
  /// Whether what is rendered converges to it.
  bool referenceFits() const { return reference_.fits(applied_); }
  const Convergence& convergence() const { return convergence_; }
  const std::vector<ConvergenceRun>& keptRuns() const { return keptRuns_; }
  const std::optional<Trade>& trade() const { return trade_; }
  const RecentFiles& recentFiles() const { return recent_; }
  /// Asks for the overlay and waits for it: for screenshots.
  void refreshOverlay();
  /// Keeps the picture that is shown to compare with.
  void storePicture();

 private:
  struct Drag {
    bool active = false;
    bool moved = false;  ///< farther than a click
    Vec2 start{0};
    Vec2 last{0};  ///< up to where the camera has followed
  };
  void drawFrame(double seconds);
  void takeNews();
  void takeScene();
  void showWarnings();
  void takeReference();
  void measure();
  void endDuel();
  /// Whether what the inspector shows is of the scene that is rendered, and not of one before.
  bool overlayIsOfScene() const {
    return overlay_ && scene_ == applied_.scene && overlay_->generation >= sceneGeneration_;
  }
  void useReference(Reference reference);
  void toggleReference();
  void takeTrade();
  void toggleTrials();
  void saveCsv();
  void keepView();
  void recallView();
  void openRecent();
  void drawPanels();
  ViewerCommand readKeys(double seconds);
  ViewerCommand readControlKeys();
  void readMouse();
  void record(std::vector<std::string> words);
  void recordKeys();
  void recordFrame();
  void run(ViewerCommand command);
  void fly(double seconds);
  void setPose(const CameraPose& pose);
  CameraPose pose() const;
  void focusAt(const Vec2& position);
  void applyEdits();
  void followSize();
  /// As ImageViewSettings::split, with B held down.
  float displaySplit() const;
  bool overlayWanted() const;
  bool overlayIsCurrent() const;
  void requestOverlay();
  void showOverlay();
  void drawOverPicture();
  std::optional<Vec2> whereSeen(const Vec3& p) const;
  void drawCluster(std::size_t row, unsigned color) const;
  void pointAtCluster();
  void showLights(bool solo);
  void save();
  void guarded(const std::function<void()>& action);

  Window& window_;
  std::shared_ptr<const Scene> scene_;
  SceneLoader loader_;
  ViewerOptions options_;
  ViewerState state_;
  SessionInput applied_;
  std::uint64_t generation_ = 0;
  std::uint64_t sceneGeneration_ = 0;  ///< of the edit that brought the scene
  bool edited_ = true;
  CameraPose pose_;
  Drag drags_[kMouseButtonCount];
  bool flying_ = false, wasFlying_ = false, flip_ = false;
  std::unique_ptr<ScriptRecorder> recorder_;  ///< null unless a script is being recorded
  PixelSize recordedSize_;

  Gui gui_;
  ImageView view_;
  std::unique_ptr<GlFramebuffer> framebuffer_;
  Widgets shown_;
  std::string reveal_;
  bool panelsHeld_ = false;
  std::vector<InputEvent> heldEvents_;  ///< while there is no area to draw on
  bool minimised_ = false;
  int glFailures_ = 0;  ///< in a row
  PixelRect area_;
  ImagePlacement placement_;
  PixelSize wantedSize_;
  std::uint64_t sizeAge_ = 0;

  std::shared_ptr<const Snapshot> snapshot_;
  bool stored_ = false;
  std::optional<OverlayPicture> overlay_;
  ViewerState overlayState_;         ///< what the newest request asked for
  std::uint64_t overlayPasses_ = 0;  ///< of the snapshot at that request
  bool overlayDrawn_ = false;
  std::optional<std::size_t> pointedBefore_;
  bool pointing_ = false;         ///< at another cluster than a frame ago: its row is drawn in the next one
  std::string problem_, notice_;  ///< as ViewerFacts'
  std::future<std::shared_ptr<const Scene>> loading_;
  std::filesystem::path loadingFile_;
  RecentFiles recent_;
  Reference reference_;
  std::future<Reference> loadingReference_;
  Convergence convergence_, secondConvergence_;
  std::vector<ConvergenceRun> keptRuns_;
  std::shared_ptr<const Snapshot> second_;       ///< of the opponent; null without a duel
  std::shared_ptr<const Snapshot> secondShown_;  ///< the one that lies in the picture
  ReferenceMaker maker_;
  TradeTrials trials_;
  std::optional<Trade> trade_;
  std::unique_ptr<Duel> duel_;
  Strategy opponent_ = Strategy::kPower;   ///< as applied
  std::vector<std::future<void>> ending_;  ///< duels whose session may be building a scene still
  std::future<std::string> saving_;        ///< what to say then
  OverlaySource overlays_;
  RenderSession session_;  ///< last: its threads stop before anything that they call goes
};

}  // namespace cellcut
