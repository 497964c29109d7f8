/// References, errors against them, and duels; bookmarks.
#include "ui/viewer/is_ready.h"
#include "ui/viewer/viewer.h"

namespace cellcut {

void Viewer::takeReference() {
  std::optional<Reference> taken = maker_.take();
  if (std::string problem = maker_.takeProblem(); !problem.empty()) problem_ = std::move(problem);
  if (isReady(loadingReference_)) guarded([&] { taken = loadingReference_.get(); });
  if (!taken) return;
  useReference(std::move(*taken));
}

void Viewer::useReference(Reference reference) {
  reference_ = std::move(reference);
  convergence_.restart(convergence_.run().name);
  secondConvergence_.restart(secondConvergence_.run().name);
  overlayPasses_ = 0;  // the overlay of errors shows others now
  if (reference_.passes == 0 && !referenceFits()) {
    problem_ = "the reference has " + std::to_string(reference_.picture->width()) + " x " +
               std::to_string(reference_.picture->height()) + " pixels, the rendering " +
               std::to_string(applied_.settings.width) + " x " + std::to_string(applied_.settings.height);
  }
}

void Viewer::toggleReference() {
  if (!maker_.busy()) return maker_.start(applied_, static_cast<std::uint64_t>(state_.referencePasses));
  if (std::optional<Reference> made = maker_.take(true)) useReference(std::move(*made));
}

void Viewer::toggleTrials() {
  if (trials_.busy())
    trials_.stop();
  else if (hasCuts(applied_.settings.strategy))
    trials_.start(applied_);
}

void Viewer::takeTrade() {
  std::optional<Trade> taken = trials_.take();
  if (std::string problem = trials_.takeProblem(); !problem.empty()) problem_ = std::move(problem);
  if (!taken || !taken->fits(applied_)) return;
  trade_ = std::move(taken);
  // What a person has set meanwhile stays.
  SamplerSettings& now = state_.settings.sampler;
  if (haveSameCuts(now, trade_->input.settings.sampler)) useCuts(now, trade_->trials[trade_->best].quality.settings);
}

void Viewer::measure() {
  guarded([this] {
    convergence_.update();
    secondConvergence_.update();
  });
  second_ = duel_ ? duel_->second() : nullptr;
  if (second_ && second_ != secondShown_ && !second_->radiance->empty()) {
    view_.setImage(ImageSlot::kB, *second_->radiance);
    if (!stored_) state_.display.split = 0.5f;
    stored_ = true;
    secondShown_ = second_;
  }
  const std::shared_ptr<const Snapshot> first = session_.snapshot();
  // A snapshot with an error shows the picture before the edit that was refused.
  if (!referenceFits() || first->generation < generation_ || !first->error.empty()) return;
  const bool resting = duel_ && !state_.paused ? duel_->finished() : session_.atRest();
  convergence_.offer(first, reference_.picture, resting);
  if (second_ && second_->generation >= duel_->generation() && second_->error.empty()) {
    secondConvergence_.offer(second_, reference_.picture, duel_->finished());
  }
}

void Viewer::endDuel() {
  if (!duel_) return;
  // Its session may be building a scene: a person does not wait for that.
  std::erase_if(ending_, [](const auto& ending) { return isReady(ending); });
  ending_.push_back(std::async(std::launch::async, [duel = std::move(duel_)]() mutable { duel.reset(); }));
  second_.reset();
  secondShown_.reset();
  view_.clearImage(ImageSlot::kB);
  stored_ = false;
}

void Viewer::keepView() {
  state_.bookmarks[state_.chosen] = pose();
}

void Viewer::recallView() {
  if (state_.bookmarks[state_.chosen]) setPose(*state_.bookmarks[state_.chosen]);
}

}  // namespace cellcut
