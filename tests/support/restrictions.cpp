#include "tests/support/restrictions.h"

#include "tests/support/depth.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <unistd.h>

namespace cellcut::test {
namespace {

constexpr uid_t kNobody = 65534;

rlim_t addressSpace() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Whoever changes may no longer look into the own process, as leak checks and HostileBudget do, until it is allowed
/// again.
bool becomes(uid_t user) {
  return seteuid(user) == 0 && prctl(PR_SET_DUMPABLE, 1) == 0;
}

}  // namespace

FileSizeLimit::FileSizeLimit(rlim_t bytes) : previousHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
  getrlimit(RLIMIT_FSIZE, &previous_);
  const rlimit limit{bytes, previous_.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
}

FileSizeLimit::~FileSizeLimit() {
  setrlimit(RLIMIT_FSIZE, &previous_);
  std::signal(SIGXFSZ, previousHandler_);
}

AddressSpaceLimit::AddressSpaceLimit(std::size_t bytesMore) {
  getrlimit(RLIMIT_AS, &previous_);
  if (isSanitized()) return;
  const rlimit limit{std::min<rlim_t>(addressSpace() + bytesMore, previous_.rlim_max), previous_.rlim_max};
  setrlimit(RLIMIT_AS, &limit);
}

AddressSpaceLimit::~AddressSpaceLimit() {
  setrlimit(RLIMIT_AS, &previous_);
}

OrdinaryUser::OrdinaryUser() : previous_(geteuid()) {
  if (previous_ == 0 && !becomes(kNobody)) throw std::runtime_error("cannot become another user");
}

OrdinaryUser::~OrdinaryUser() {
  if (!becomes(previous_)) std::abort();  // as somebody else no later test means anything
}

}  // namespace cellcut::test
