#include "renderer/trace/live_picture.h"

#include "renderer/base/error.h"
#include "renderer/scene/camera.h"
#include "renderer/trace/worker_pool.h"

#include <tuple>

namespace cellcut {
namespace {

/// Of threads that build: after the UI, before the workers.
constexpr int kBuildNiceness = 10;

void check(const SessionInput& input) {
  if (!input.scene) throw InputError("scene", "there is none; open one");
  const std::size_t cameras = input.scene->cameras.size();
  if (input.settings.camera >= cameras) {
    throw InputError("camera " + std::to_string(input.settings.camera),
                     "the scene has " + std::to_string(cameras) + "; choose one of these");
  }
}

bool haveSameFilm(const RenderSettings& a, const RenderSettings& b) {
  return std::tie(a.width, a.height, a.auxiliary) == std::tie(b.width, b.height, b.auxiliary);
}

/// With the same scene, sampler and film.
bool haveSamePaths(const Scene& scene, const RenderSettings& a, const RenderSettings& b) {
  return std::tie(a.maxDepth, a.sampling, a.seed, a.shownLights) ==
             std::tie(b.maxDepth, b.sampling, b.seed, b.shownLights) &&
         isSameView(viewOf(scene, a), viewOf(scene, b));
}

}  // namespace

LivePicture::LivePicture() : niceness_(arena_, kBuildNiceness) {}

bool LivePicture::apply(SessionInput input) {
  check(input);
  const bool newScene = !exists() || input.scene != input_.scene;
  const bool newSampler = newScene || !haveSameSampler(input.settings, input_.settings);
  const bool newFilm = !exists() || !haveSameFilm(input.settings, input_.settings);
  if (!newSampler && !newFilm && haveSamePaths(*input.scene, input.settings, input_.settings)) {
    input_ = std::move(input);
    return false;
  }

  std::shared_ptr<const PreparedScene> prepared;
  std::unique_ptr<LightSampler> sampler;
  std::unique_ptr<Film> film;
  if (newFilm) film = std::make_unique<Film>(input.settings.width, input.settings.height, input.settings.auxiliary);
  if (newScene) prepared = execute([&] { return std::make_shared<const PreparedScene>(*input.scene); });
  const PreparedScene& scene = prepared ? *prepared : *prepared_;
  if (newSampler) sampler = execute([&] { return makeLightSampler(scene, input.settings); });
  auto passes =
      std::make_unique<PassRenderer>(scene, sampler ? *sampler : *sampler_, input.settings, film ? *film : *film_);

  // From here on nothing throws. Users go before what they use.
  passes_ = std::move(passes);
  if (film) film_ = std::move(film);
  if (sampler) sampler_ = std::move(sampler);
  if (prepared) prepared_ = std::move(prepared);
  input_ = std::move(input);
  film_->clear();
  return true;
}

std::unique_ptr<PassRenderer> LivePicture::passesOver(Film& film) const {
  return std::make_unique<PassRenderer>(*prepared_, *sampler_, input_.settings, film);
}

SessionView LivePicture::view(std::uint64_t generation, const std::atomic<bool>& cancel) const {
  return {generation, input_.scene, input_.settings, prepared_->accel, prepared_->lights, *sampler_, *film_, cancel};
}

}  // namespace cellcut
