#include "server/jobs/job_worker.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "api/json/version.h"
#include "api/json/worker_stack.h"
#include "server/call/request_log.h"
#include "server/jobs/crash_marks.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kKeepEvery{1'000};
constexpr std::chrono::seconds kDropEvery{60};
constexpr std::chrono::minutes kEndPatience{10};        // for a server that is away
constexpr std::chrono::seconds kWorkerStopPatience{5};  // where this process ends

// "host 1234"
std::string NameOfProcess() {
  char host[128] = {};
  gethostname(host, sizeof host - 1);
  return std::string(host) + " " + std::to_string(getpid());
}

}  // namespace

JobWorker::JobWorker(const std::string& address, std::map<std::string, Work> works,
                     const WorkerOptions& options)
    : works_(std::move(works)),
      options_(options),
      self_{RandomId(), NameOfProcess(), std::string(api::Version()), options.threads} {
  for (const auto& [kind, work] : works_) kinds_.push_back(kind);
  for (int i = 0; i <= options_.threads; ++i)
    stores_.push_back(std::make_unique<catalog::SharedJobStore>(address, self_.version));
  for (int i = 0; i < options_.threads; ++i)
    threads_.emplace_back([this, i] { WorkLoop(*stores_[static_cast<std::size_t>(i)]); });
  keeper_ = std::thread([this] { KeepLoop(*stores_.back()); });
}

JobWorker::~JobWorker() { Stop(); }

void JobWorker::Wake() {
  const std::lock_guard lock(mutex_);
  ++wakes_;
  woken_.notify_all();
}

void JobWorker::Drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
  woken_.notify_all();
}

bool JobWorker::Idle() const {
  const std::lock_guard lock(mutex_);
  return attempts_.empty();
}

void JobWorker::Stop() {
  stopping_ = true;
  Drain();
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
  over_ = true;
  Wake();
  if (!keeper_.joinable()) return;
  keeper_.join();
  TryStore({{"doing", "leaving"}}, [&] { stores_.back()->Leave(self_.id); });
}

bool JobWorker::Pause(milliseconds time) {
  std::unique_lock lock(mutex_);
  const long long before = wakes_;
  woken_.wait_for(lock, time, [&] { return over_ || draining_ || wakes_ != before; });
  return !draining_;
}

void JobWorker::WorkLoop(catalog::SharedJobStore& store) {
  const api::SignalStack stack;
  WorkBehindRequests();
  for (bool goes_on = true; goes_on;) {
    std::optional<catalog::JobClaim> claim;
    TryStore({{"doing", "claiming a job"}},
             [&] { claim = store.Claim(kinds_, self_.name, options_.lease); });
    if (!claim) {
      goes_on = Pause(options_.pause);
      continue;
    }
    const auto attempt = std::make_shared<Attempt>();
    attempt->claim = *std::move(claim);
    {
      const std::lock_guard lock(mutex_);
      attempts_.push_back(attempt);
    }
    Run(store, attempt);
    const std::lock_guard lock(mutex_);
    std::erase(attempts_, attempt);
    goes_on = !draining_;
  }
}

void JobWorker::Run(catalog::SharedJobStore& store, const AttemptPtr& attempt) {
  const WorksFor job(attempt->claim.job.number);
  api::Parsed<api::Json> outcome;
  ReturnMemoryAfter([&] { outcome = Compute(attempt); });
  catalog::JobRecord record;
  {
    const std::lock_guard lock(mutex_);
    if (attempt->lost) return;
    if (attempt->interrupted && !attempt->asked)
      record.status = JobStatus::kQueued;
    else
      record.status = attempt->asked ? JobStatus::kCancelled : JobStatus::kDone;
    record.progress = attempt->progress.empty() ? attempt->claim.job.progress : attempt->progress;
  }
  if (record.status == JobStatus::kQueued) {
    TryStore({{"doing", "giving a job back"}}, [&] { store.GiveBack(attempt->claim); });
    return;
  }
  if (const auto* errors = std::get_if<api::Errors>(&outcome)) {
    record.status = JobStatus::kFailed;
    record.failure = WordsOf(*errors);
  } else {
    record.result = TextOf(std::get<api::Json>(outcome));
  }
  End(store, *attempt, record);
}

api::Parsed<api::Json> JobWorker::Compute(const AttemptPtr& attempt) {
  const auto interrupt = [&] {
    const std::lock_guard lock(mutex_);
    attempt->interrupted = true;
  };
  const JobControl control{[&] {
                             const std::lock_guard lock(mutex_);
                             if (stopping_) attempt->interrupted = true;
                             return stopping_ || attempt->asked || attempt->lost;
                           },
                           [&](const api::Json& progress) {
                             const std::lock_guard lock(mutex_);
                             attempt->progress = TextOf(progress);
                             attempt->claim.job.progress = attempt->progress;
                           }};
  // A server that went away is no fault of the job.
  const auto work = [&](const catalog::JobOrder& order,
                        const JobControl& seen) -> api::Parsed<api::Json> {
    try {
      return works_.at(order.kind)(order, seen);
    } catch (const catalog::StoreError& error) {
      if (error.fault() == catalog::StoreFault::kOther) throw;
      Log({{"level", "error"}, {"job", attempt->claim.job.id}, {"fault", error.what()}});
      interrupt();
      return api::Errors();
    }
  };
  return OutcomeOf(work, attempt->claim.job.order, attempt->claim.job.id, control);
}

// Until it is written, or another has the job.
void JobWorker::End(catalog::SharedJobStore& store, Attempt& attempt, catalog::JobRecord outcome) {
  for (const auto until = Clock::now() + kEndPatience; Clock::now() < until;) {
    try {
      store.End(attempt.claim, outcome);
      return;
    } catch (const catalog::StoreError& error) {
      Log({{"level", "error"}, {"job", attempt.claim.job.id}, {"fault", error.what()}});
      if (error.fault() == catalog::StoreFault::kOther) {  // what cannot be kept is no result
        if (outcome.status == JobStatus::kFailed) return;
        outcome.status = JobStatus::kFailed;
        outcome.result.clear();
        outcome.failure = "its result cannot be stored; the log of its worker says more";
      }
    }
    if (stopping_ && Clock::now() > until - kEndPatience + kWorkerStopPatience) return;
    std::this_thread::sleep_for(std::min(kKeepEvery, options_.pause));
    const std::lock_guard lock(mutex_);
    if (attempt.lost) return;
  }
}

void JobWorker::KeepLoop(catalog::SharedJobStore& store) {
  LastTimes last;
  while (!over_) {
    TryStore({{"doing", "keeping leases"}}, [&] { Keep(store, last); });
    std::unique_lock lock(mutex_);
    woken_.wait_for(lock, std::min(kKeepEvery, options_.lease / 6), [&] { return bool(over_); });
  }
}

void JobWorker::Keep(catalog::SharedJobStore& store, LastTimes& last) {
  std::vector<AttemptPtr> attempts;
  {
    const std::lock_guard lock(mutex_);
    attempts = attempts_;
  }
  for (const AttemptPtr& attempt : attempts) {
    std::string progress;
    {
      const std::lock_guard lock(mutex_);
      progress = std::exchange(attempt->progress, {});
    }
    const bool is_due = Clock::now() - attempt->extended > options_.lease / 3;
    const auto beat = progress.empty() && !is_due
                          ? store.See(attempt->claim)
                          : store.Extend(attempt->claim, progress, options_.lease);
    if (!progress.empty() || is_due) attempt->extended = Clock::now();
    const std::lock_guard lock(mutex_);
    attempt->asked = attempt->asked || beat.cancel_asked;
    attempt->lost = !beat.held;
  }
  store.TakeFromLost();
  const auto now = Clock::now();
  if (now - last.seen > options_.lease / 3) {
    store.Seen(self_);
    last.seen = now;
  }
  if (now - last.dropped < kDropEvery) return;
  for (const std::string& kind : kinds_) store.DropOld(kind, options_.kept);
  last.dropped = now;
}

}  // namespace plenum::server
