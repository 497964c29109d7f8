#include "renderer/trace/worker_pool.h"

#include <cassert>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace cellcut {
namespace {

/// The UI then wakes at once although every core is busy.
constexpr int kWorkerNiceness = 19;

}  // namespace

void setThreadNiceness([[maybe_unused]] int niceness) {
#ifdef __linux__
  // Elsewhere this would be the process. It may only ever grow; where it cannot be set there is nothing to be done.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
#endif
}

WorkerPool::WorkerPool(int threads, std::function<void()> done) : done_(std::move(done)) {
  assert(threads >= 1);
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  } catch (...) {  // the system has no more threads for us
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() {
  stop();
}

void WorkerPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::start(int count, std::function<void(int)> piece) {
  assert(count >= 1);
  auto work = std::make_shared<Work>(count, std::move(piece));
  {
    const std::lock_guard lock(mutex_);
    work_.swap(work);
  }
  wake_.notify_all();
}

void WorkerPool::rethrow() const {
  if (work_ && work_->error) std::rethrow_exception(work_->error);
}

void WorkerPool::serve() {
  setThreadNiceness(kWorkerNiceness);
  std::shared_ptr<Work> work;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || work_ != work; });
      if (stop_) return;
      work = work_;
    }
    takePieces(*work);
  }
}

void WorkerPool::takePieces(Work& work) {
  for (int i = work.next.fetch_add(1); i < work.count; i = work.next.fetch_add(1)) {
    if (!work.failed) {
      try {
        work.piece(i);
      } catch (...) {
        if (!work.failed.exchange(true)) work.error = std::current_exception();
      }
    }
    if (work.left.fetch_sub(1) == 1) done_();
  }
}

}  // namespace cellcut
