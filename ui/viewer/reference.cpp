#include "ui/viewer/reference.h"

#include "renderer/scene/camera.h"
#include "ui/viewer/is_ready.h"

namespace cellcut {

bool Reference::fits(const SessionInput& rendered) const {
  const RenderSettings& r = rendered.settings;
  if (!picture || picture->width() != r.width || picture->height() != r.height) return false;
  if (!input.scene) return true;
  const RenderSettings& own = input.settings;
  return input.scene == rendered.scene && own.maxDepth == r.maxDepth && own.shownLights == r.shownLights &&
         isSameView(viewOf(*input.scene, own), viewOf(*rendered.scene, r));
}

void ReferenceMaker::start(SessionInput input, std::uint64_t passes) {
  end();
  problem_.clear();
  // The same numbers would make the same errors, and a picture that is compared with them look better than it is.
  input.settings.seed += 0x5eed;
  input.passLimit = passes;
  input.timeLimit.reset();
  input.noiseLimit.reset();
  input.paused = false;
  input.preview = false;
  input.noise = false;
  input.settings.auxiliary = false;
  wanted_ = passes;
  input_ = input;
  session_ = std::make_unique<RenderSession>(wake_);
  session_->edit(std::move(input));
}

std::optional<Reference> ReferenceMaker::take(bool now) {
  if (!session_) return std::nullopt;
  const std::shared_ptr<const Snapshot> s = session_->snapshot();
  if (!s->error.empty()) {
    problem_ = s->error;
    end();
    return std::nullopt;
  }
  if (s->passes < wanted_ && !now) return std::nullopt;
  std::optional<Reference> made;
  if (s->passes > 0) made = Reference{s->radiance, input_, s->passes};
  end();
  return made;
}

void ReferenceMaker::end() {
  std::erase_if(ending_, [](const auto& ending) { return isReady(ending); });
  if (session_) {
    ending_.push_back(std::async(std::launch::async, [session = std::move(session_)]() mutable { session.reset(); }));
  }
  input_ = {};  // its scene may be gone otherwise
}

}  // namespace cellcut
