#include "renderer/trace/arena_niceness.h"

#include "renderer/trace/worker_pool.h"

namespace cellcut {

ArenaNiceness::ArenaNiceness(tbb::task_arena& arena, int niceness)
    : task_scheduler_observer(arena), niceness_(niceness) {
  observe(true);
}

ArenaNiceness::~ArenaNiceness() {
  observe(false);
}

void ArenaNiceness::on_scheduler_entry(bool) {
  setThreadNiceness(niceness_);
}

}  // namespace cellcut
