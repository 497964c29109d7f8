/// \file interrupt.h
/// Ctrl-C (SIGINT) and SIGTERM as a request that the rendering looks at.
#pragma once

#include <atomic>
#include <signal.h>

namespace cellcut {

/// While one lives, the first signal sets requested() and says so on the standard error stream; the second ends the
/// process at once with status 1. The destructor puts back what was there before. At most one lives at a time.
class InterruptRequest {
 public:
  InterruptRequest();
  ~InterruptRequest();
  InterruptRequest(const InterruptRequest&) = delete;
  InterruptRequest& operator=(const InterruptRequest&) = delete;

  const std::atomic<bool>& requested() const;

 private:
  struct sigaction previousInt_;
  struct sigaction previousTerm_;
};

}  // namespace cellcut
