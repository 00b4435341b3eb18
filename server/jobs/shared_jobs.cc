#include "server/jobs/shared_jobs.h"

#include <utility>

#include "server/jobs/queue_places.h"

namespace plenum::server {

SharedJobs::SharedJobs(catalog::SharedJobStore& store, std::string kind, const JobOptions& options,
                       std::function<void()> changed)
    : store_(store), kind_(std::move(kind)), options_(options), changed_(std::move(changed)) {}

std::optional<Submitted> SharedJobs::RefuseToQueue(const std::string& client, std::size_t count,
                                                   bool as_sweep) const {
  const QueueLimits limits = LimitsOf(options_, as_sweep);
  if (stopping_) return Submitted{Submitted::kRefused, ""};
  return RefuseMore(
      limits,
      {store_.Waiting(kind_, std::nullopt, as_sweep), store_.Waiting(kind_, client, as_sweep)},
      count);
}

Submitted SharedJobs::SubmitSweep(catalog::SweepRecord sweep,
                                  std::vector<catalog::JobOrder> orders) {
  sweep.kind = kind_;
  const auto known = [&] { return KnownSweep(store_, sweep); };
  if (const auto one = known()) return *one;
  if (const auto refused = RefuseToQueue(sweep.client, orders.size(), true)) return *refused;
  const auto jobs = JobsOf(sweep, std::move(orders));
  const auto added = store_.AddSweep(sweep, jobs);
  if (!added) return known().value_or(Submitted{Submitted::kRefused, ""});  // another was faster
  changed_();
  return {Submitted::kAccepted, added->id};
}

std::optional<catalog::SweepRecord> SharedJobs::FindSweep(const std::string& id) const {
  return store_.FindSweep(kind_, id);
}

std::vector<catalog::SweepRecord> SharedJobs::Sweeps() const {
  return store_.Sweeps(kind_, kSweepsListed);
}

std::vector<catalog::JobRecord> SharedJobs::OfSweep(const std::string& id) const {
  return store_.OfSweep(id);
}

Submitted SharedJobs::Submit(catalog::JobOrder order) {
  order.kind = kind_;
  const auto known = [&]() -> std::optional<Submitted> {
    if (order.by.key.empty()) return std::nullopt;
    const auto job = store_.FindKey(kind_, order.by.key);
    if (!job) return std::nullopt;
    if (job->order.by.request != order.by.request) return Submitted{Submitted::kKeyReused, ""};
    return Submitted{Submitted::kRepeated, job->id};
  };
  if (const auto job = known()) return *job;
  if (const auto refused = RefuseToQueue(order.client)) return *refused;
  const auto added = store_.Add(RandomId(), order);
  if (!added) return known().value_or(Submitted{Submitted::kRefused, ""});  // another was faster
  changed_();
  return {Submitted::kAccepted, added->id};
}

std::optional<Job> SharedJobs::Look(const std::string& id) const {
  const auto record = store_.Peek(kind_, id);
  if (!record) return std::nullopt;
  Job job = ToJob(*record);
  job.revision = record->ending;
  return job;
}

void SharedJobs::AddResult(Job& job) const {
  if (job.result || !Ended(job.status)) return;
  // A job that was done again has another result under the same id.
  job.result = results_.Get(job.id + " " + std::to_string(job.revision),
                            [&] { return store_.Result(kind_, job.id); });
}

std::vector<Job> SharedJobs::List() const {
  std::vector<Job> list;
  for (const catalog::JobRecord& record : store_.List(kind_, kSharedJobsListed))
    list.push_back(ToJob(record));
  return list;
}

std::size_t SharedJobs::Count(JobStatus status) const { return store_.Count(kind_, status); }

bool SharedJobs::Cancel(const std::string& id) {
  if (!store_.Peek(kind_, id)) return false;
  store_.Cancel(id);
  changed_();
  return true;
}

void SharedJobs::CancelSweep(const std::string& id) {
  store_.CancelSweep(id);
  changed_();
}

Asked SharedJobs::Again(const std::string& id) {
  const auto record = store_.Peek(kind_, id);
  if (!record) return Asked::kUnknown;
  if (!Ended(record->status)) return Asked::kUnderWay;
  if (record->status == JobStatus::kDone) return Asked::kDone;
  if (const auto refused = RefuseToQueue(record->order.client, 1, !record->order.sweep.empty()))
    return refused->status == Submitted::kRefused ? Asked::kRefused : Asked::kClientRefused;
  store_.Again(id);  // or another did
  changed_();
  return Asked::kQueued;
}

}  // namespace plenum::server
