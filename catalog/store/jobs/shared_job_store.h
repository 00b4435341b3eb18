// The jobs of services and workers that share a catalogue on a server.
//
// A job is claimed in a short transaction (FOR UPDATE SKIP LOCKED) and then computed without one.
// Who claimed it has a lease, which a heartbeat extends, and an attempt token, without which
// nothing is written: a worker that was thought lost can overwrite nothing. All times are the
// server's. One store is one connection, whose calls take turns; all of them throw StoreError.
#ifndef PLENUM_CATALOG_STORE_JOBS_SHARED_JOB_STORE_H_
#define PLENUM_CATALOG_STORE_JOBS_SHARED_JOB_STORE_H_

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalog/store/jobs/job_record.h"

namespace plenum::catalog {

// Who does jobs: a process. The id is its own, the name for people.
struct WorkerRecord {
  std::string id, name, version;
  int threads = 0;
};

// The right to end a job.
struct JobClaim {
  JobRecord job;  // with its request
  std::string attempt;
};

struct Heartbeat {
  bool held = false;  // the attempt is still the job's
  bool cancel_asked = false;
};

struct QueueState {
  std::int64_t waiting = 0, running = 0;
  std::int64_t workers = 0, threads = 0;  // seen within a lease
  std::string oldest;                     // submitted_at of the one that waits longest; empty: none
};

class SharedJobStore {
 public:
  // `version` of this program: jobs of another one are neither claimed nor given back.
  SharedJobStore(const std::string& address, std::string version);
  ~SharedJobStore();
  SharedJobStore(const SharedJobStore&) = delete;
  SharedJobStore& operator=(const SharedJobStore&) = delete;

  // Those who ask. Add gives nothing where the key has a job already.
  std::optional<JobRecord> Add(const std::string& id, const JobOrder& order);
  std::size_t Count(const std::string& kind, JobStatus status) const;
  // Jobs that wait, of one client or all, those of sweeps or the others.
  std::size_t Waiting(const std::string& kind, const std::optional<std::string>& client,
                      bool of_sweeps = false) const;
  std::optional<JobRecord> Peek(const std::string& kind, const std::string& id) const;
  std::optional<JobRecord> FindKey(const std::string& kind, const std::string& key) const;
  std::string Result(const std::string& kind, const std::string& id) const;
  // Newest first, without requests and results; all kinds where it is empty.
  std::vector<JobRecord> List(const std::string& kind, int limit) const;
  // A sweep and its jobs, all or nothing. Gives nothing where the sweep's key has one already.
  std::optional<SweepRecord> AddSweep(const SweepRecord& sweep, const std::vector<NewJob>& jobs);
  std::optional<SweepRecord> FindSweep(const std::string& kind, const std::string& id) const;
  std::optional<SweepRecord> FindSweepKey(const std::string& kind, const std::string& key) const;
  // Newest first, without their plans.
  std::vector<SweepRecord> Sweeps(const std::string& kind, int limit) const;
  // Without requests and results, in their order.
  std::vector<JobRecord> OfSweep(const std::string& id) const;
  // Ends a job that waits, asks one that runs to end.
  void Cancel(const std::string& id);
  void CancelSweep(const std::string& id);  // all jobs of it
  // Queues a job that failed or was cancelled as if it was new. False where there is none.
  bool Again(const std::string& id);
  // Another number after any change of any job.
  std::int64_t LastChange() const;
  QueueState Queue(std::chrono::milliseconds lease) const;

  // Those who work. The next job of the kinds: of the highest priority, then of the client with the
  // fewest at work, then of the one who has waited longest for a turn, then the first.
  std::optional<JobClaim> Claim(const std::vector<std::string>& kinds, const std::string& worker,
                                std::chrono::milliseconds lease);
  // Whether the attempt is still the job's.
  Heartbeat See(const JobClaim& claim) const;
  // Extends the lease; writes the progress unless it is empty.
  Heartbeat Extend(const JobClaim& claim, const std::string& progress,
                   std::chrono::milliseconds lease);
  // False where the attempt is no longer the job's: then nothing is written. Said again after the
  // answer was lost it is true again.
  bool End(const JobClaim& claim, const JobRecord& outcome);
  // Stopped in an orderly way: another begins it anew.
  void GiveBack(const JobClaim& claim);
  // Of workers that were lost: queued again, or ended where somebody asked for that or too many
  // were lost.
  void TakeFromLost();
  void Seen(const WorkerRecord& worker);
  void Leave(const std::string& worker_id);
  void DropOld(const std::string& kind, const JobsKept& kept);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_SHARED_JOB_STORE_H_
