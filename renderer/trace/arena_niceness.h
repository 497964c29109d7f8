/// \file arena_niceness.h
/// Lowers the priority of TBB's threads when they come to help.
#pragma once

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

namespace cellcut {

class ArenaNiceness : public tbb::task_scheduler_observer {
 public:
  /// \param arena     outlives it
  /// \param niceness  setThreadNiceness() of all that enter it; they keep it
  ArenaNiceness(tbb::task_arena& arena, int niceness);
  ~ArenaNiceness() override;
  ArenaNiceness(const ArenaNiceness&) = delete;
  ArenaNiceness& operator=(const ArenaNiceness&) = delete;
  void on_scheduler_entry(bool isWorker) override;

 private:
  int niceness_;
};

}  // namespace cellcut
