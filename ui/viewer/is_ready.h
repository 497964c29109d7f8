/// \file is_ready.h
/// Work on other threads that the UI looks at and never waits for.
#pragma once

#include <chrono>
#include <future>

namespace cellcut {

/// Whether get() would not wait; false where nothing is under way.
template <class T>
bool isReady(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace cellcut
