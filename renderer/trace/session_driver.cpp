#include "renderer/trace/session_driver.h"

#include "renderer/base/stopwatch.h"

#include <algorithm>

namespace cellcut {
namespace {

/// Of the driver: before the workers, so that a finished pass is seen, and after the UI.
constexpr int kDriverNiceness = 10;
/// A picture of 1280 × 720 has 40 × 23 pixels then.
constexpr int kCoarsestPreviewScale = 32;
/// Of the grace: a first preview that takes longer makes the next one coarser.
constexpr double kSlowShare = 0.4;

int threadCount(const RenderSettings& settings) {
  if (settings.threads > 0) return settings.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int scaledDown(int size, int scale) {
  return (size + scale - 1) / scale;
}

}  // namespace

// What others call ------------------------------------------------------------------------------------------------

SessionDriver::~SessionDriver() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    cancel_ = true;
    cancelJobs_ = true;
  }
  orders_.notify_all();
  thread_.join();
}

std::uint64_t SessionDriver::edit(SessionInput input) {
  std::optional<SessionInput> replaced(std::move(input));  // destroyed after the lock is released
  std::uint64_t generation = 0;
  {
    const std::lock_guard lock(mutex_);
    pending_.swap(replaced);
    steps_ = 0;
    generation = ++generation_;
    cancelJobs_ = true;
    if (!grace_) cancel_ = true;
  }
  orders_.notify_all();
  return generation;
}

void SessionDriver::singleStep() {
  {
    const std::lock_guard lock(mutex_);
    ++steps_;
  }
  orders_.notify_all();
}

void SessionDriver::enqueue(Job job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  orders_.notify_all();
}

std::shared_ptr<const Snapshot> SessionDriver::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

bool SessionDriver::atRest() const {
  const std::lock_guard lock(mutex_);
  return isResting();
}

void SessionDriver::waitIdle() const {
  std::unique_lock lock(mutex_);
  progress_.wait(lock, [&] { return isResting(); });
}

std::shared_ptr<const Snapshot> SessionDriver::waitPasses(std::uint64_t passes) const {
  std::unique_lock lock(mutex_);
  const auto reached = [&] {
    return snapshot_->generation == generation_ && !snapshot_->preview && snapshot_->passes >= passes;
  };
  progress_.wait(lock, [&] { return reached() || isResting(); });
  return reached() ? snapshot_ : nullptr;
}

// The driver: orders ----------------------------------------------------------------------------------------------

void SessionDriver::run() {
  setThreadNiceness(kDriverNiceness);
  while (followOrders()) {
    try {
      work();
    } catch (const std::exception& e) {
      failed_ = true;
      refuse(e.what());
    }
  }
}

bool SessionDriver::followOrders() {
  Orders orders = takeOrders();
  if (orders.stop) return false;
  if (orders.input) answer(std::move(*orders.input));
  if (!picture_.exists()) return true;  // nobody will run the jobs: their futures say so
  runJobs(orders.jobs);
  return true;
}

void SessionDriver::runJobs(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) picture_.execute([&] { job(picture_.view(answered_, cancelJobs_)); });
}

SessionDriver::Orders SessionDriver::takeOrders() {
  const std::lock_guard lock(mutex_);
  Orders orders;
  orders.stop = stop_;
  if (pending_) {
    orders.input.swap(pending_);
    answered_ = generation_;
    cancel_ = stop_;
    cancelJobs_ = stop_;
  }
  if (isJobDue()) orders.jobs.swap(jobs_);
  return orders;
}

void SessionDriver::work() {
  if (previewScale_ > 0 && !failed_) {
    renderPreview();
  } else if (wantsPass()) {
    renderPass();
  } else if (unpublished_) {
    publishFilm();
  } else {
    rest();
  }
}

void SessionDriver::rest() {
  state_ = SessionState::kIdle;
  const bool couldStep = picture_.exists() && picture_.input().paused && !failed_ && !limitReached();
  std::unique_lock lock(mutex_);
  if (!couldStep && !pending_) steps_ = 0;
  resting_ = true;
  progress_.notify_all();
  orders_.wait(lock, [&] { return stop_ || pending_ || steps_ > 0 || isJobDue(); });
  resting_ = false;
}

// The driver: edits -----------------------------------------------------------------------------------------------

void SessionDriver::answer(SessionInput input) {
  state_ = SessionState::kApplying;
  try {
    const int threads = threadCount(input.settings);
    std::unique_ptr<WorkerPool> pool;
    if (!pool_ || pool_->threads() != threads) {
      const auto done = [this] {
        {
          const std::lock_guard lock(mutex_);
          workersDone_ = true;
        }
        orders_.notify_all();
      };
      pool = std::make_unique<WorkerPool>(threads, done);
    }
    const bool again = picture_.apply(std::move(input));
    if (pool) pool_ = std::move(pool);
    error_.clear();
    failed_ = false;
    // A picture that goes on is shown under its new number at once; one without a pass begins with its preview again,
    // for no later pass may come to carry the number.
    if (again || picture_.film().passes() == 0) {
      startAgain();
    } else {
      publishFilm();
    }
  } catch (const std::exception& e) {
    refuse(e.what());
  }
}

void SessionDriver::startAgain() {
  previewScale_ = picture_.input().preview ? firstScale_ : 0;
  seconds_ = 0;
  unpublished_ = false;
  noise_ = {};
}

void SessionDriver::refuse(const char* why) {
  try {
    error_ = why;
    auto again = std::make_shared<Snapshot>(*snapshot());
    again->generation = answered_;
    again->error = error_;
    publish(std::move(again));
  } catch (const std::bad_alloc&) {
    // No memory even for the message: the picture stands still and waits for an edit.
    failed_ = true;
  }
}

// The driver: passes ----------------------------------------------------------------------------------------------

bool SessionDriver::wantsPass() {
  if (!picture_.exists() || failed_ || limitReached()) return false;
  if (!picture_.input().paused) return true;
  const std::lock_guard lock(mutex_);
  return steps_ > 0;
}

bool SessionDriver::limitReached() {
  const SessionInput& input = picture_.input();
  const std::uint64_t passes = picture_.film().passes();
  if (input.passLimit && passes >= *input.passLimit) return true;
  if (input.timeLimit && passes > 0 && seconds_ >= *input.timeLimit) return true;
  return input.noiseLimit && !(lookAtNoise().bound >= *input.noiseLimit);
}

void SessionDriver::renderPreview() {
  state_ = SessionState::kPreview;
  const Stopwatch preview;
  const Clock::time_point graceEnd = Clock::now() + kPreviewGrace;
  const RenderSettings& settings = picture_.input().settings;
  Film film(scaledDown(settings.width, previewScale_), scaledDown(settings.height, previewScale_), false);
  const std::unique_ptr<PassRenderer> passes = picture_.passesOver(film);
  if (!renderPass(*passes, film, graceEnd, {})) {
    if (Clock::now() >= graceEnd) firstScale_ = std::min(2 * firstScale_, kCoarsestPreviewScale);
    return;
  }
  const double seconds = preview.seconds();
  auto snapshot = describe(*passes, film, seconds);
  snapshot->preview = true;
  snapshot->sampler = picture_.sampler().statistics();
  publish(std::move(snapshot));
  // Twice as fine takes four times as long; asking for a fifth keeps it from flapping. What is nearly as long as the
  // grace is too slow for a hand.
  const double share = seconds / std::chrono::duration<double>(kPreviewGrace).count();
  if (previewScale_ == firstScale_) {
    if (5 * share < kSlowShare) firstScale_ = std::max(firstScale_ / 2, kPreviewScale);
    if (share > kSlowShare) firstScale_ = std::min(2 * firstScale_, kCoarsestPreviewScale);
  }
  previewScale_ = previewScale_ > kPreviewScale ? previewScale_ / 2 : 0;
}

void SessionDriver::renderPass() {
  state_ = SessionState::kRendering;
  const Stopwatch pass;
  const auto publishLast = [&] {
    if (unpublished_) publishFilm();
  };
  if (!renderPass(picture_.passes(), picture_.film(), Clock::now(), publishLast)) return;
  statistics_ = picture_.sampler().statistics();
  seconds_ += pass.seconds();
  unpublished_ = true;
  const std::lock_guard lock(mutex_);
  if (!pending_ && steps_ > 0) --steps_;
}

bool SessionDriver::renderPass(PassRenderer& passes, Film& film, Clock::time_point graceEnd,
                               const std::function<void()>& meanwhile) {
  passes.startPass();
  startWorkers(passes.tileCount(), [&](int tile) { passes.renderTile(tile, cancel_); });
  std::exception_ptr failure;
  try {
    if (meanwhile) meanwhile();
  } catch (...) {
    failure = std::current_exception();  // but the workers use what is on our stack
  }
  awaitWorkers(graceEnd, Inspection::kServed);
  pool_->rethrow();
  if (failure) std::rethrow_exception(failure);
  if (cancel_) return false;
  startWorkers(film.height(), [&](int row) { film.commitRow(row); });
  awaitWorkers(graceEnd, Inspection::kWaits);
  film.finishCommit();
  passes.keepCounts();
  return true;
}

void SessionDriver::startWorkers(int count, std::function<void(int)> piece) {
  workersDone_ = false;  // nobody works
  pool_->start(count, std::move(piece));
}

void SessionDriver::awaitWorkers(Clock::time_point graceEnd, Inspection inspection) {
  std::unique_lock lock(mutex_);
  // An edit waits for our turn, so that what was asked to be inspected after it sees it.
  const auto jobIsDue = [&] { return inspection == Inspection::kServed && !jobs_.empty() && !pending_ && !stop_; };
  grace_ = Clock::now() < graceEnd && !cancel_;
  while (!workersDone_) {
    if (jobIsDue()) {
      std::vector<Job> jobs;
      jobs.swap(jobs_);
      lock.unlock();
      runJobs(jobs);
      jobs.clear();
      lock.lock();
      continue;
    }
    if (!grace_) {
      orders_.wait(lock, [&] { return workersDone_ || jobIsDue(); });
    } else if (!orders_.wait_until(lock, graceEnd, [&] { return workersDone_ || jobIsDue(); })) {
      grace_ = false;
      if (pending_) cancel_ = true;
    }
  }
  grace_ = false;
}

// The driver: snapshots -------------------------------------------------------------------------------------------

const NoiseEstimate& SessionDriver::lookAtNoise() {
  const SessionInput& input = picture_.input();
  if ((input.noise || input.noiseLimit) && noise_.look(picture_.film())) noiseSeconds_ = seconds_;
  return noise_.noise();
}

std::shared_ptr<Snapshot> SessionDriver::describe(const PassRenderer& passes, const Film& film, double seconds) const {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->generation = answered_;
  snapshot->error = error_;
  snapshot->width = picture_.input().settings.width;
  snapshot->height = picture_.input().settings.height;
  snapshot->radiance = std::make_shared<const ImageRgb>(film.mean());
  snapshot->passes = film.passes();
  snapshot->seconds = seconds;
  snapshot->rays = passes.rays();
  snapshot->droppedSamples = passes.droppedSamples();
  snapshot->bad = film.badSamples();
  snapshot->prepared = picture_.prepared();
  return snapshot;
}

void SessionDriver::publishFilm() {
  if (cancel_) return;  // an edit came: what starts again needs no picture of before, what goes on gets one then
  unpublished_ = false;
  const Film& film = picture_.film();
  auto snapshot = describe(picture_.passes(), film, seconds_);
  snapshot->noise = lookAtNoise();
  snapshot->noiseSeconds = noiseSeconds_;
  snapshot->sampler = statistics_;
  if (picture_.input().layers) snapshot->layers = std::make_shared<const LayeredImage>(film.layers());
  publish(std::move(snapshot));
}

void SessionDriver::publish(std::shared_ptr<const Snapshot> snapshot) {
  {
    const std::lock_guard lock(mutex_);
    snapshot_.swap(snapshot);
  }
  progress_.notify_all();
  if (wake_) wake_();
}

}  // namespace cellcut
