/// \file worker_pool.h
/// Threads of our own that deal numbered pieces of work among themselves, at the lowest priority.
///
/// Not TBB's: whoever waits for TBB may be given a task that takes longer than a frame, and a race detector sees these.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace cellcut {

/// Sets the priority of the calling thread: 0 is what a program has, 19 the least there is. No effect where the system
/// knows no priority of threads.
void setThreadNiceness(int niceness);

class WorkerPool {
 public:
  /// \param threads  ≥ 1
  /// \param done     called on one of the threads after the last piece of each work
  /// \throws std::system_error when the system has no more threads
  WorkerPool(int threads, std::function<void()> done);
  /// \pre no work is in flight
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const { return static_cast<int>(threads_.size()); }

  /// Has `piece(i)` called once for each i in [0, count), count ≥ 1. Returns at once. After a piece that throws no
  /// further one is begun. \pre done() was called for the work before
  void start(int count, std::function<void(int)> piece);
  /// Throws what a piece of the last work threw, if one did. \pre done() was called for it
  void rethrow() const;

 private:
  struct Work {
    Work(int n, std::function<void(int)> f) : count(n), piece(std::move(f)), left(n) {}
    int count;
    std::function<void(int)> piece;
    std::atomic<int> next{0};
    std::atomic<int> left;  ///< pieces that are not finished
    std::atomic<bool> failed{false};
    std::exception_ptr error;  ///< of the piece that set `failed`
  };
  void stop();
  void serve();
  void takePieces(Work& work);

  std::function<void()> done_;
  std::mutex mutex_;  ///< of work_, stop_; held for no longer than it takes to look
  std::condition_variable wake_;
  std::shared_ptr<Work> work_;  ///< shared: a thread that wakes up late finds nothing left and touches nothing newer
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace cellcut
