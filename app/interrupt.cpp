#include "app/interrupt.h"

#include "app/command_line.h"

#include <cerrno>
#include <string_view>
#include <unistd.h>

namespace cellcut {
namespace {

/// The house has no mutable statics but this one: a signal handler is given nothing else that it could reach.
std::atomic<bool> interruptRequested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void onInterrupt(int) {
  if (interruptRequested.exchange(true)) _exit(kFailed);
  const int savedErrno = errno;
  constexpr std::string_view note = "\ncellcut: stopping; once more to quit without writing\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, note.data(), note.size());
  errno = savedErrno;
}

}  // namespace

InterruptRequest::InterruptRequest() {
  interruptRequested = false;
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  action.sa_flags = SA_RESTART;  // a file that is being written must not see EINTR
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &previousInt_);
  sigaction(SIGTERM, &action, &previousTerm_);
}

InterruptRequest::~InterruptRequest() {
  sigaction(SIGINT, &previousInt_, nullptr);
  sigaction(SIGTERM, &previousTerm_, nullptr);
}

const std::atomic<bool>& InterruptRequest::requested() const {
  return interruptRequested;
}

}  // namespace cellcut
