/// \file live_picture.h
/// The parts of the picture that a session renders. An edit rebuilds those that it touches.
///
/// Scene → Accel, Lights; with the strategy and its parameters → LightSampler; size and layers → Film. Threads: by one
/// thread at a time, but that const members may run beside PassRenderer::renderTile().
#pragma once

#include "renderer/trace/arena_niceness.h"
#include "renderer/trace/pass_renderer.h"
#include "renderer/trace/session_input.h"

#include <atomic>

#include <oneapi/tbb/task_arena.h>

namespace cellcut {

class LivePicture {
 public:
  LivePicture();

  /// Brings the parts in line with an input. Returns whether the picture starts again: its film is then empty.
  /// \throws InputError, std::bad_alloc, std::runtime_error: everything is then as it was
  bool apply(SessionInput input);

  /// Whether an input was applied; all below needs one.
  bool exists() const { return passes_ != nullptr; }
  const SessionInput& input() const { return input_; }
  Film& film() { return *film_; }
  PassRenderer& passes() { return *passes_; }
  /// Passes of the same picture over a film of another size.
  std::unique_ptr<PassRenderer> passesOver(Film& film) const;
  const LightSampler& sampler() const { return *sampler_; }
  const std::shared_ptr<const PreparedScene>& prepared() const { return prepared_; }
  SessionView view(std::uint64_t generation, const std::atomic<bool>& cancel) const;

  /// Runs a function with the threads of the arena that the parts are built on.
  template <class Function>
  auto execute(const Function& function) {
    return arena_.execute(function);
  }

 private:
  tbb::task_arena arena_;
  ArenaNiceness niceness_;
  SessionInput input_;
  // Each refers to those above it.
  std::shared_ptr<const PreparedScene> prepared_;
  std::unique_ptr<LightSampler> sampler_;
  std::unique_ptr<Film> film_;
  std::unique_ptr<PassRenderer> passes_;
};

}  // namespace cellcut
