/// \file reference.h
/// What a picture should converge to: loaded, or rendered beside the picture that is shown.
#pragma once

#include "renderer/trace/session.h"

#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cellcut {

struct Reference {
  std::shared_ptr<const ImageRgb> picture;  ///< null: there is none
  SessionInput input;                       ///< what it shows; without a scene it came from a file
  std::uint64_t passes = 0;                 ///< 0: from a file

  /// Whether a rendering of that input converges to it; of a file only the size is known.
  bool fits(const SessionInput& rendered) const;
};

/// Renders a reference with threads, structures and random numbers of its own, while a session goes on with its picture
/// at about half its speed. Threads: one (the UI's).
class ReferenceMaker {
 public:
  /// \param wake  as RenderSession's
  explicit ReferenceMaker(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// \param input  what the session renders; its limits and its strategy do not matter to the result
  void start(SessionInput input, std::uint64_t passes);
  bool busy() const { return session_ != nullptr; }
  std::uint64_t wanted() const { return wanted_; }
  /// So far.
  std::uint64_t passes() const { return session_ ? session_->snapshot()->passes : 0; }
  /// The reference when it is done. \param now  as far as it is
  std::optional<Reference> take(bool now = false);
  /// What went wrong, for a person; told once.
  std::string takeProblem() { return std::exchange(problem_, {}); }

 private:
  void end();

  std::function<void()> wake_;
  SessionInput input_;
  std::uint64_t wanted_ = 0;
  std::string problem_;
  std::vector<std::future<void>> ending_;  ///< sessions that may be building a scene still
  std::unique_ptr<RenderSession> session_;
};

}  // namespace cellcut
