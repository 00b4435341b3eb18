#include "server/jobs/jobs.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "api/json/worker_stack.h"
#include "server/jobs/crash_marks.h"
#include "server/jobs/queue_places.h"

namespace plenum::server {
namespace {

// Between two looks whether a job's turn has come, while jobs run alone.
constexpr std::chrono::milliseconds kTurnPause{20};

}  // namespace

Jobs::Jobs(catalog::JobStore& store, JobTurns& turns, std::string kind, Work work,
           const JobOptions& options)
    : store_(store),
      turns_(turns),
      kind_(std::move(kind)),
      work_(std::move(work)),
      options_(options) {
  for (const catalog::JobRecord& record : store_.Unfinished(kind_)) {
    Enqueue(record);
    if (record.cancel_asked) Cancel(record.id);
  }
  for (int i = 0; i < options_.workers; ++i) workers_.emplace_back([this] { WorkLoop(); });
}

Jobs::~Jobs() { Stop(); }

// With the lock held, or before there are workers.
Jobs::EntryPtr Jobs::Enqueue(const catalog::JobRecord& record) {
  auto entry = std::make_shared<Entry>();
  entry->job = ToJob(record);
  entry->job.status = JobStatus::kQueued;
  entry->client = record.order.client;
  entry->priority = record.order.priority;
  entry->of_sweep = !record.order.sweep.empty();
  entries_[record.id] = entry;
  if (record.alone) turns_.Announce();
  const auto after = record.alone
                         ? std::find_if(queue_.begin(), queue_.end(),
                                        [](const auto& other) { return !other->job.alone; })
                         : queue_.end();
  queue_.insert(after, entry);
  work_ready_.notify_one();
  return entry;
}

Submitted Jobs::Submit(catalog::JobOrder order) {
  const std::lock_guard submitting(submitting_);
  order.kind = kind_;
  if (!order.by.key.empty()) {
    if (const auto known = store_.FindKey(kind_, order.by.key)) {
      if (known->order.by.request != order.by.request) return {Submitted::kKeyReused, ""};
      return {Submitted::kRepeated, known->id};
    }
  }
  if (const auto refused = RefuseToQueue(order.client)) return *refused;
  const catalog::JobRecord record = store_.Add(RandomId(), order);
  const std::lock_guard lock(mutex_);
  Enqueue(record);
  return {Submitted::kAccepted, record.id};
}

std::optional<Submitted> Jobs::RefuseToQueue(const std::string& client, std::size_t count,
                                             bool as_sweep) const {
  const QueueLimits limits = LimitsOf(options_, as_sweep);
  QueueLimits waiting;
  const std::lock_guard lock(mutex_);
  for (const EntryPtr& entry : queue_) {
    if (entry->of_sweep != as_sweep) continue;
    ++waiting.all;
    waiting.of_client += entry->client == client;
  }
  if (stopping_) return Submitted{Submitted::kRefused, ""};
  return RefuseMore(limits, waiting, count);
}

Submitted Jobs::SubmitSweep(catalog::SweepRecord sweep, std::vector<catalog::JobOrder> orders) {
  const std::lock_guard submitting(submitting_);
  sweep.kind = kind_;
  if (const auto known = KnownSweep(store_, sweep)) return *known;
  if (const auto refused = RefuseToQueue(sweep.client, orders.size(), true)) return *refused;
  const auto jobs = JobsOf(sweep, std::move(orders));
  store_.AddSweep(sweep, jobs);
  for (const catalog::JobRecord& record : store_.OfSweep(sweep.id)) {
    const std::lock_guard lock(mutex_);
    Enqueue(record);
  }
  return {Submitted::kAccepted, sweep.id};
}

std::optional<catalog::SweepRecord> Jobs::FindSweep(const std::string& id) const {
  return store_.FindSweep(kind_, id);
}

std::vector<catalog::SweepRecord> Jobs::Sweeps() const {
  return store_.Sweeps(kind_, kSweepsListed);
}

std::vector<catalog::JobRecord> Jobs::OfSweep(const std::string& id) const {
  return store_.OfSweep(id);
}

Asked Jobs::Again(const std::string& id) {
  const std::lock_guard submitting(submitting_);
  const auto job = Look(id);
  if (!job) return Asked::kUnknown;
  if (!Ended(job->status)) return Asked::kUnderWay;
  if (job->status == JobStatus::kDone) return Asked::kDone;
  const auto before = store_.Peek(kind_, id);
  if (!before) return Asked::kUnknown;
  if (const auto refused = RefuseToQueue(before->order.client, 1, !before->order.sweep.empty()))
    return refused->status == Submitted::kRefused ? Asked::kRefused : Asked::kClientRefused;
  store_.Again(id);
  results_.Forget(id);
  const auto record = store_.Find(kind_, id);
  if (!record) return Asked::kUnknown;  // dropped as old meanwhile
  const std::lock_guard lock(mutex_);
  Enqueue(*record);
  return Asked::kQueued;
}

Jobs::EntryPtr Jobs::Find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  return it == entries_.end() ? nullptr : it->second;
}

std::optional<Job> Jobs::Look(const std::string& id) const {
  if (const EntryPtr entry = Find(id)) {
    const std::lock_guard lock(mutex_);
    return entry->job;
  }
  const auto record = store_.Peek(kind_, id);
  return record ? std::optional(ToJob(*record)) : std::nullopt;
}

void Jobs::AddResult(Job& job) const {
  if (job.result || !Ended(job.status)) return;
  bool is_stored = false;
  job.result = results_.Get(job.id, [&] {
    std::string text = store_.Result(kind_, job.id);
    is_stored = is_stored || !text.empty();
    return text;
  });
  if (job.result || !is_stored) return;
  job.status = JobStatus::kFailed;
  job.failure = "its stored result is damaged and cannot be read";
}

void Jobs::OnChange(std::function<void()> changed) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(changed);
}

// With the lock held.
void Jobs::Changed() const {
  if (on_change_) on_change_();
}

std::vector<Job> Jobs::List() const {
  std::map<std::int64_t, Job, std::greater<>> jobs;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, entry] : entries_) jobs[entry->job.number] = entry->job;
  }
  // A job is on disk as ended before it leaves the memory, so none is missed.
  for (const catalog::JobRecord& record : store_.Ended(kind_))
    jobs.emplace(record.number, ToJob(record));
  std::vector<Job> list;
  for (auto& [number, job] : jobs) {
    job.result = nullptr;
    list.push_back(std::move(job));
  }
  return list;
}

std::size_t Jobs::Count(JobStatus status) const {
  const auto list = List();
  return static_cast<std::size_t>(std::count_if(
      list.begin(), list.end(), [&](const Job& job) { return job.status == status; }));
}

// Those that wait end at once and together; those at work are asked to stop.
void Jobs::CancelAll(const std::vector<std::string>& ids) {
  std::vector<EntryPtr> waiting;
  std::vector<std::string> at_work;
  {
    const std::lock_guard lock(mutex_);
    for (const std::string& id : ids) {
      const auto found = entries_.find(id);
      if (found == entries_.end()) continue;
      found->second->cancelled = true;
      if (std::erase(queue_, found->second) == 0)
        at_work.push_back(id);
      else
        waiting.push_back(found->second);
    }
  }
  for (const EntryPtr& entry : waiting)
    if (entry->job.alone) turns_.Withdraw();
  End(waiting, JobStatus::kCancelled, nullptr, "");
  for (const std::string& id : at_work)
    TryStore({{"job", id}}, [&, this] { store_.AskToCancel(id); });
}

bool Jobs::Cancel(const std::string& id) {
  if (!Find(id)) return store_.Find(kind_, id).has_value();
  CancelAll({id});
  return true;
}

void Jobs::CancelSweep(const std::string& id) {
  std::vector<std::string> jobs;
  for (const catalog::JobRecord& job : store_.OfSweep(id)) jobs.push_back(job.id);
  CancelAll(jobs);
}

// On disk, in one write, before anybody sees it. Where that fails the jobs stay in memory as they
// ended, and the next service does them again.
void Jobs::End(const std::vector<EntryPtr>& entries, JobStatus status, const api::Json& result,
               const std::string& failure) {
  if (entries.empty()) return;
  std::vector<catalog::JobRecord> records(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    records[i].order.kind = kind_;
    records[i].status = status;
    records[i].result = TextOf(result);
    records[i].failure = failure;
    const std::lock_guard lock(mutex_);
    records[i].id = entries[i]->job.id;
    records[i].progress = TextOf(entries[i]->job.progress);
  }
  const std::string& text = records.front().result;
  const Bytes bytes = text.empty() ? nullptr : std::make_shared<const std::string>(text);
  std::string ended_at;
  const bool kept =
      TryStore({{"job", records.front().id}}, [&] { ended_at = store_.End(records); });
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept && bytes) results_.Put(records[i].id, text);
    const std::lock_guard lock(mutex_);
    Job& job = entries[i]->job;
    job.status = status;
    job.ended_at = ended_at;  // for those who found the entry before it goes
    job.result = bytes;
    job.failure = failure;
    ++job.revision;
    if (kept) entries_.erase(job.id);
  }
  const std::lock_guard lock(mutex_);
  Changed();
}

void Jobs::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    work_ready_.notify_all();
    Changed();
  }
  for (auto& worker : workers_) {
    if (worker.joinable()) worker.join();
  }
}

bool Jobs::Stopping() const { return stopping_; }

// The job that begins now; none when the service stops.
Jobs::EntryPtr Jobs::Next() {
  std::unique_lock lock(mutex_);
  while (!stopping_ && (queue_.empty() || !turns_.Enter(queue_.front()->job.alone))) {
    if (queue_.empty())
      work_ready_.wait(lock);
    else
      work_ready_.wait_for(lock, kTurnPause);
  }
  if (stopping_) return nullptr;
  return TakeFromQueue();
}

// With the lock held.
Jobs::EntryPtr Jobs::TakeFromQueue() {
  std::map<std::string, int> at_work;
  for (const auto& [id, entry] : entries_) at_work[entry->client] += entry->at_work;
  const auto rank = [&](const EntryPtr& entry) {
    return std::tuple_cat(std::tuple(-entry->priority),
                          clients_.RankOf(entry->client, at_work[entry->client]));
  };
  const auto next = queue_.front()->job.alone
                        ? queue_.begin()
                        : std::min_element(queue_.begin(), queue_.end(),
                                           [&](const EntryPtr& one, const EntryPtr& other) {
                                             return rank(one) < rank(other);
                                           });
  EntryPtr entry = *next;
  queue_.erase(next);
  clients_.Forget([&](const std::string& client) { return at_work.contains(client); });
  clients_.Take(entry->client);
  entry->at_work = true;
  return entry;
}

void Jobs::WorkLoop() {
  const api::SignalStack stack;  // a crash by overflow of the thread's own stack is marked, too
  WorkBehindRequests();
  while (const EntryPtr entry = Next()) {
    Run(entry);
    turns_.Leave(entry->job.alone);
  }
}

void Jobs::Run(const EntryPtr& entry) {
  const std::string id = entry->job.id;
  const WorksFor job(entry->job.number);
  TryStore({{"job", id}}, [&] { store_.Start(id); });
  {
    const std::lock_guard lock(mutex_);
    entry->job.status = JobStatus::kRunning;
    ++entry->job.attempts;
    ++entry->job.revision;
    Changed();
  }
  api::Parsed<api::Json> outcome;
  ReturnMemoryAfter([&] { outcome = Outcome(*entry); });
  if (entry->interrupted && !entry->cancelled) {
    TryStore({{"job", id}}, [&] { store_.Requeue(id); });
  } else if (const auto* errors = std::get_if<api::Errors>(&outcome)) {
    End({entry}, JobStatus::kFailed, nullptr, WordsOf(*errors));
  } else {
    End({entry}, entry->cancelled ? JobStatus::kCancelled : JobStatus::kDone,
        std::get<api::Json>(outcome), "");
  }
}

api::Parsed<api::Json> Jobs::Outcome(Entry& entry) {
  const JobControl control{[this, &entry] {
                             const bool stopping = stopping_;
                             if (stopping) entry.interrupted = true;
                             return stopping || entry.cancelled;
                           },
                           [this, &entry](api::Json progress) {
                             const std::lock_guard lock(mutex_);
                             entry.job.progress = std::move(progress);
                             ++entry.job.revision;
                             Changed();
                           }};
  const auto work = [this, &entry](const catalog::JobOrder&, const JobControl& seen) {
    return work_(store_.Find(kind_, entry.job.id).value().order, seen);
  };
  return OutcomeOf(work, {}, entry.job.id, control);
}

}  // namespace plenum::server
