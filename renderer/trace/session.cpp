#include "renderer/trace/session.h"

#include "renderer/trace/session_driver.h"

namespace cellcut {

RenderSession::RenderSession(std::function<void()> wake) : driver_(std::make_unique<SessionDriver>(std::move(wake))) {}
RenderSession::~RenderSession() = default;

std::uint64_t RenderSession::edit(SessionInput input) {
  return driver_->edit(std::move(input));
}
void RenderSession::singleStep() {
  driver_->singleStep();
}
std::shared_ptr<const Snapshot> RenderSession::snapshot() const {
  return driver_->snapshot();
}
SessionState RenderSession::state() const {
  return driver_->state();
}
bool RenderSession::atRest() const {
  return driver_->atRest();
}
void RenderSession::enqueue(std::function<void(const SessionView&)> job) {
  driver_->enqueue(std::move(job));
}
void RenderSession::waitIdle() const {
  driver_->waitIdle();
}
std::shared_ptr<const Snapshot> RenderSession::waitPasses(std::uint64_t passes) const {
  return driver_->waitPasses(passes);
}

}  // namespace cellcut
