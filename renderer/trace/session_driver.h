/// \file session_driver.h
/// The threads behind a RenderSession. What the members do and which thread calls them: session.h.
#pragma once

#include "renderer/trace/live_picture.h"
#include "renderer/trace/noise_watch.h"
#include "renderer/trace/session.h"
#include "renderer/trace/worker_pool.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cellcut {

class SessionDriver {
 public:
  using Job = std::function<void(const SessionView&)>;

  explicit SessionDriver(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}
  ~SessionDriver();
  SessionDriver(const SessionDriver&) = delete;
  SessionDriver& operator=(const SessionDriver&) = delete;

  std::uint64_t edit(SessionInput input);
  void singleStep();
  void enqueue(Job job);
  std::shared_ptr<const Snapshot> snapshot() const;
  SessionState state() const { return state_.load(); }
  bool atRest() const;
  void waitIdle() const;
  std::shared_ptr<const Snapshot> waitPasses(std::uint64_t passes) const;

 private:
  using Clock = std::chrono::steady_clock;

  /// What takeOrders() found.
  struct Orders {
    bool stop = false;
    std::optional<SessionInput> input;
    std::vector<Job> jobs;
  };

  void run();
  void runJobs(const std::vector<Job>& jobs);
  Orders takeOrders();
  bool followOrders();  ///< false: to stop
  void work();
  void rest();

  void answer(SessionInput input);
  void startAgain();
  void refuse(const char* why);

  bool wantsPass();
  bool limitReached();
  void renderPreview();
  void renderPass();
  /// Whether the pass was rendered to its end, and committed. `meanwhile` runs beside it.
  bool renderPass(PassRenderer& passes, Film& film, Clock::time_point graceEnd, const std::function<void()>& meanwhile);
  void startWorkers(int count, std::function<void(int)> piece);
  /// Whether jobs may run while the workers do: not while they write into the film.
  enum class Inspection { kServed, kWaits };
  void awaitWorkers(Clock::time_point graceEnd, Inspection inspection);

  const NoiseEstimate& lookAtNoise();
  std::shared_ptr<Snapshot> describe(const PassRenderer& passes, const Film& film, double seconds) const;
  void publishFilm();
  void publish(std::shared_ptr<const Snapshot> snapshot);

  // With mutex_ held.
  bool isJobDue() const { return !jobs_.empty() && generation_ > 0; }
  bool isResting() const { return resting_ && !pending_ && steps_ == 0 && !isJobDue(); }

  const std::function<void()> wake_;
  /// Raised by edits; lowered by the driver when it takes them.
  std::atomic<bool> cancel_{false};
  /// The same for jobs, which have no grace.
  std::atomic<bool> cancelJobs_{false};
  std::atomic<SessionState> state_{SessionState::kIdle};

  mutable std::mutex mutex_;
  std::condition_variable orders_;            ///< for the driver
  mutable std::condition_variable progress_;  ///< for waitIdle(), waitPasses()
  // Guarded by mutex_.
  std::optional<SessionInput> pending_;
  std::uint64_t generation_ = 0;  ///< of the newest edit
  std::uint64_t steps_ = 0;       ///< single steps asked for
  std::vector<Job> jobs_;
  bool stop_ = false;
  bool workersDone_ = false;
  bool grace_ = false;  ///< a preview is in flight that edits let finish: kPreviewGrace
  bool resting_ = false;
  std::shared_ptr<const Snapshot> snapshot_ = std::make_shared<const Snapshot>();

  // The driver's own.
  LivePicture picture_;
  std::unique_ptr<WorkerPool> pool_;
  std::uint64_t answered_ = 0;      ///< generation of the newest edit that was applied or refused
  std::string error_;               ///< why it was refused, or rendering failed
  bool failed_ = false;             ///< rendering did; only an edit makes it go on
  int previewScale_ = 0;            ///< of the next preview; 0: none is due
  int firstScale_ = kPreviewScale;  ///< of the first preview of a picture
  double seconds_ = 0;              ///< of the passes in the film
  bool unpublished_ = false;        ///< the film holds a pass that no snapshot shows
  SamplerStatistics statistics_;    ///< after the passes in the film
  NoiseWatch noise_;                ///< of the film
  double noiseSeconds_ = 0;         ///< at its last look

  std::thread thread_;  ///< last: it uses everything above
};

}  // namespace cellcut
