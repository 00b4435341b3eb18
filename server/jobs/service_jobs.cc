#include "server/jobs/service_jobs.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "api/json/version.h"
#include "server/jobs/crash_marks.h"
#include "server/jobs/job_recovery.h"
#include "server/jobs/job_worker.h"
#include "server/jobs/jobs.h"
#include "server/jobs/shared_jobs.h"

namespace plenum::server {
namespace {

constexpr std::chrono::milliseconds kLookForJobsEvery{250};

class OwnJobs : public ServiceJobs {
 public:
  OwnJobs(const std::filesystem::path& catalogue, const ServiceWorks& works,
          const JobOptions& options, const catalog::JobsKept& kept)
      : store_(catalogue.string() + "-jobs", kept),
        marks_(Recovered(CrashFile(catalogue))),
        designs_(store_, turns_, "design", works.design, options),
        diagnoses_(store_, turns_, "diagnosis", works.diagnosis, options) {}

  JobQueue& designs() override { return designs_; }
  JobQueue& diagnoses() override { return diagnoses_; }
  catalog::QueueState Queue() const override {
    catalog::QueueState state;
    state.workers = 1;
    for (const Jobs* jobs : {&designs_, &diagnoses_}) {
      state.threads += jobs->options().workers;
      for (const Job& job : jobs->List()) {
        state.running += job.status == JobStatus::kRunning;
        if (job.status != JobStatus::kQueued) continue;
        ++state.waiting;
        if (state.oldest.empty() || job.submitted_at < state.oldest)
          state.oldest = job.submitted_at;
      }
    }
    return state;
  }
  void OnChange(std::function<void()> changed) override {
    for (Jobs* kind : {&designs_, &diagnoses_}) kind->OnChange(changed);
  }
  void Stop() override {
    designs_.Stop();
    diagnoses_.Stop();
  }

 private:
  // The file of crash marks, once the jobs know what it says.
  std::filesystem::path Recovered(const std::filesystem::path& marks) {
    RecoverJobs(store_, marks);
    return marks;
  }

  catalog::JobStore store_;
  CrashMarks marks_;
  JobTurns turns_;
  Jobs designs_, diagnoses_;
};

class JobsOfServer : public ServiceJobs {
 public:
  JobsOfServer(const std::string& address, const ServiceWorks& works, const JobOptions& options)
      : store_(address, std::string(api::Version())),
        watched_(address, std::string(api::Version())),
        designs_(store_, "design", options, [this] { Wake(); }),
        diagnoses_(store_, "diagnosis", options, [this] { Wake(); }),
        worker_(address, {{"design", works.design}, {"diagnosis", works.diagnosis}},
                {.threads = options.workers, .kept = kSharedJobsKept}),
        watch_([this] { Watch(); }) {}
  ~JobsOfServer() override { Stop(); }

  JobQueue& designs() override { return designs_; }
  JobQueue& diagnoses() override { return diagnoses_; }
  catalog::QueueState Queue() const override { return store_.Queue(WorkerOptions().lease); }
  void OnChange(std::function<void()> changed) override {
    const std::lock_guard lock(mutex_);
    on_change_ = std::move(changed);
  }
  void Stop() override {
    designs_.Stop();
    diagnoses_.Stop();
    worker_.Stop();
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
      look_.notify_all();
      if (on_change_) on_change_();
    }
    if (watch_.joinable()) watch_.join();
  }

 private:
  void Wake() {
    worker_.Wake();
    const std::lock_guard lock(mutex_);
    look_.notify_all();
  }
  void Watch() {
    std::int64_t known = -1;
    std::unique_lock lock(mutex_);
    while (!over_) {
      lock.unlock();
      std::int64_t now = known;
      try {
        now = watched_.LastChange();
      } catch (const catalog::StoreError&) {  // who asks for a job is told
      }
      lock.lock();
      if (std::exchange(known, now) != now && on_change_) on_change_();
      if (!over_) look_.wait_for(lock, kLookForJobsEvery);
    }
  }

  catalog::SharedJobStore store_, watched_;
  SharedJobs designs_, diagnoses_;
  JobWorker worker_;
  std::mutex mutex_;
  std::condition_variable look_;
  std::function<void()> on_change_;
  bool over_ = false;
  std::thread watch_;
};

}  // namespace

std::unique_ptr<ServiceJobs> OpenServiceJobs(const std::filesystem::path& catalogue,
                                             const ServiceWorks& works, const JobOptions& options,
                                             const catalog::JobsKept& kept) {
  if (catalog::IsServer(catalogue))
    return std::make_unique<JobsOfServer>(catalogue.string(), works, options);
  return std::make_unique<OwnJobs>(catalogue, works, options, kept);
}

}  // namespace plenum::server
