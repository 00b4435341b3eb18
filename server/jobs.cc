#include "server/jobs.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <random>
#include <utility>

namespace plenum::server {
namespace {

// 64 random bits: ids of one run of the service mean nothing to the next.
std::string RandomId() {
  std::random_device random;
  char text[17];
  std::snprintf(text, sizeof text, "%08x%08x", static_cast<unsigned>(random()),
                static_cast<unsigned>(random()));
  return text;
}

}  // namespace

const char* Name(JobStatus status) {
  switch (status) {
    case JobStatus::kQueued:
      return "queued";
    case JobStatus::kRunning:
      return "running";
    case JobStatus::kDone:
      return "done";
    case JobStatus::kCancelled:
      return "cancelled";
    case JobStatus::kFailed:
      return "failed";
  }
  return "";
}

bool Ended(JobStatus status) {
  return status != JobStatus::kQueued && status != JobStatus::kRunning;
}

Jobs::Jobs(const JobOptions& options) : options_(options) {
  for (int i = 0; i < options_.workers; ++i) workers_.emplace_back([this] { WorkLoop(); });
}

Jobs::~Jobs() { Stop(); }

std::optional<std::string> Jobs::Submit(std::string name, Work work) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || queue_.size() >= options_.queued_max) return std::nullopt;
  auto entry = std::make_shared<Entry>();
  do {
    entry->job.id = RandomId();
  } while (entries_.count(entry->job.id) > 0);
  entry->job.name = std::move(name);
  entry->work = std::move(work);
  entry->number = ++submitted_;
  entries_[entry->job.id] = entry;
  queue_.push_back(entry);
  work_ready_.notify_one();
  return entry->job.id;
}

std::optional<Job> Jobs::Get(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return std::nullopt;
  return it->second->job;
}

std::vector<Job> Jobs::List() const {
  const std::lock_guard lock(mutex_);
  std::vector<const Entry*> entries;
  for (const auto& [id, entry] : entries_) entries.push_back(entry.get());
  std::sort(entries.begin(), entries.end(),
            [](const Entry* a, const Entry* b) { return a->number > b->number; });
  std::vector<Job> jobs;
  for (const Entry* entry : entries) {
    const Job& job = entry->job;
    jobs.push_back({job.id, job.name, job.status, job.progress, {}, job.failure, job.revision});
  }
  return jobs;
}

bool Jobs::Cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return false;
  CancelLocked(*it->second);
  return true;
}

void Jobs::CancelLocked(Entry& entry) {
  entry.cancelled = true;
  if (entry.job.status != JobStatus::kQueued) return;
  std::erase_if(queue_, [&](const EntryPtr& queued) { return queued.get() == &entry; });
  End(entry, JobStatus::kCancelled);
}

// With the lock held.
void Jobs::End(Entry& entry, JobStatus status) {
  entry.job.status = status;
  ++entry.job.revision;
  entry.work = nullptr;
  ended_.push_back(entry.job.id);
  changed_.notify_all();
  while (ended_.size() > options_.ended_kept) {
    entries_.erase(ended_.front());
    ended_.pop_front();
  }
}

template <typename Predicate>
std::optional<Job> Jobs::WaitUntil(const std::string& id, std::chrono::milliseconds timeout,
                                   Predicate done) const {
  std::unique_lock lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return std::nullopt;
  const EntryPtr entry = it->second;  // stays, also if the map forgets it meanwhile
  changed_.wait_for(lock, timeout, [&] { return stopping_ || done(entry->job); });
  return entry->job;
}

std::optional<Job> Jobs::WaitForChange(const std::string& id, long long revision,
                                       std::chrono::milliseconds timeout) const {
  return WaitUntil(id, timeout, [revision](const Job& job) {
    return job.revision > revision || Ended(job.status);
  });
}

std::optional<Job> Jobs::WaitForEnd(const std::string& id,
                                    std::chrono::milliseconds timeout) const {
  return WaitUntil(id, timeout, [](const Job& job) { return Ended(job.status); });
}

void Jobs::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& entry : std::deque<EntryPtr>(queue_)) CancelLocked(*entry);
    for (const auto& [id, entry] : entries_) entry->cancelled = true;
    work_ready_.notify_all();
    changed_.notify_all();
  }
  for (auto& worker : workers_) {
    if (worker.joinable()) worker.join();
  }
}

bool Jobs::Stopping() const {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

void Jobs::WorkLoop() {
  for (;;) {
    EntryPtr entry;
    {
      std::unique_lock lock(mutex_);
      work_ready_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
      if (stopping_) return;
      entry = queue_.front();
      queue_.pop_front();
      entry->job.status = JobStatus::kRunning;
      ++entry->job.revision;
      changed_.notify_all();
    }
    Run(*entry);
  }
}

void Jobs::Run(Entry& entry) {
  const JobControl control{[&entry] { return entry.cancelled.load(); },
                           [this, &entry](api::Json progress) {
                             const std::lock_guard lock(mutex_);
                             entry.job.progress = std::move(progress);
                             ++entry.job.revision;
                             changed_.notify_all();
                           }};
  api::Json result;
  std::string failure;
  try {
    result = entry.work(control);
  } catch (const std::exception& error) {
    failure = std::string("fault: ") + error.what();
    std::fprintf(stderr, "job %s: %s\n", entry.job.id.c_str(), failure.c_str());
  }
  const std::lock_guard lock(mutex_);
  entry.job.result = std::move(result);
  entry.job.failure = std::move(failure);
  End(entry, !entry.job.failure.empty() ? JobStatus::kFailed
             : entry.cancelled          ? JobStatus::kCancelled
                                        : JobStatus::kDone);
}

}  // namespace plenum::server
