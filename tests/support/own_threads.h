/// \file own_threads.h
/// Tests that a race detector can judge.
#pragma once

#include <oneapi/tbb/global_control.h>

namespace cellcut::test {

/// While it lives under ThreadSanitizer, TBB starts no threads: the detector does not see how they hand over their work
/// and reports races where there are none. What std::thread does is then all that it judges; tsan.supp leaves out only
/// what such libraries do to memory of their own.
/// Elsewhere it does nothing.
class OnlyOwnThreads {
#ifdef __SANITIZE_THREAD__
  tbb::global_control limit_{tbb::global_control::max_allowed_parallelism, 1};
#endif
};

}  // namespace cellcut::test
