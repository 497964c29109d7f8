/// \file session.h
/// A rendering that goes on while people change it.
///
/// Three kinds of threads. The caller's (a UI) hands in edits and takes snapshots; it waits for no work and never calls
/// TBB. The session's driver applies edits, gives passes to the workers, and publishes. The workers take tiles from a
/// counter. One mutex guards what they hand each other; it is held to move a pointer or to set a flag, never while
/// anybody works.
///
/// States of the driver and its legal transitions:
///
///     kIdle       sleeps: nothing was handed in yet, paused, a limit is reached, or rendering failed
///         → kApplying   an edit came
///         → kRendering  singleStep() of a paused session
///     kApplying   rebuilds what the edit touches; the workers stand still
///         → kPreview    the picture starts again
///         → kRendering  it starts again without preview, or goes on as it was
///         → kIdle       there is nothing to render
///     kPreview    one pass over a small film, then over a finer one
///         → kPreview, kRendering, kIdle (paused)  it is done
///         → kApplying   an edit came; the workers have stopped
///     kRendering  one pass over the film, published while the next one is rendered
///         → kRendering  the next pass
///         → kIdle       paused, a limit is reached, one step is done, or rendering failed
///         → kApplying   an edit came; the workers have stopped
///     every state → the thread's end: the destructor was called; the workers have stopped
///
/// An edit bumps the generation and raises a flag that workers look at before every pixel: the pass in flight is
/// dropped without a trace. Edits that arrive before the driver comes to them replace each other: the last one wins. A
/// snapshot never shows anything but the generation that it names. A preview alone is let finish for kPreviewGrace, so
/// that a camera that moves all the time is seen moving; one that takes longer makes the next one coarser.
#pragma once

#include "renderer/trace/session_input.h"
#include "renderer/trace/snapshot.h"

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <type_traits>

namespace cellcut {

/// Pixels of the film per pixel of the finest preview, along each side.
inline constexpr int kPreviewScale = 4;
inline constexpr std::chrono::milliseconds kPreviewGrace{100};

enum class SessionState : std::uint8_t { kIdle, kApplying, kPreview, kRendering };

class SessionDriver;

class RenderSession {
 public:
  /// \param wake  called on the driver after each new snapshot; must neither throw nor wait, and may call snapshot()
  explicit RenderSession(std::function<void()> wake = {});
  /// Stops the workers within a pixel; waits for a scene that is being built and a function that inspects.
  ~RenderSession();
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;

  /// The one way to change what is rendered. Returns the generation that will show it, counted from 1. What cannot be
  /// rendered (no such camera, out of memory) is refused in Snapshot::error, and what was rendered goes on.
  std::uint64_t edit(SessionInput input);
  /// One more pass of a paused session, unless a limit was reached.
  void singleStep();
  /// The newest one; never null.
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionState state() const;
  /// Whether nothing is left to do, edits and steps that were just asked for included.
  bool atRest() const;

  /// Runs `f(const SessionView&)` on the driver as soon as all edits before this call are answered, inside the arena
  /// that scenes are built on. Rendering goes on meanwhile to the end of the pass; an edit waits for it, so that what
  /// takes longer than a frame looks at SessionView::cancel. What `f` throws comes out of the future. The future is
  /// broken when there is no picture yet, or no session any more. Before the first edit it waits for that.
  template <class Function>
  auto inspect(Function f) -> std::future<std::invoke_result_t<Function&, const SessionView&>> {
    using Result = std::invoke_result_t<Function&, const SessionView&>;
    auto task = std::make_shared<std::packaged_task<Result(const SessionView&)>>(std::move(f));
    std::future<Result> result = task->get_future();
    enqueue([task](const SessionView& view) { (*task)(view); });
    return result;
  }

  /// For scripts and tests, not for a UI: until there is nothing left to do.
  void waitIdle() const;
  /// Until the newest edit has a snapshot of so many passes, which it returns; or nothing is left to do: null.
  std::shared_ptr<const Snapshot> waitPasses(std::uint64_t passes) const;

 private:
  void enqueue(std::function<void(const SessionView&)> job);

  std::unique_ptr<SessionDriver> driver_;
};

}  // namespace cellcut
