// The jobs of a service in a file of SQLite.
//
// They have a file of their own beside the catalogue, which stays what it is: parts to be copied
// and handed on. One process holds the file from opening to closing; then a write-ahead log costs
// one sync a commit, and no second service does the same jobs again. Everything that returned is on
// disk. One store may be used from several threads; its calls take turns.
#ifndef PLENUM_CATALOG_STORE_JOBS_JOB_STORE_H_
#define PLENUM_CATALOG_STORE_JOBS_JOB_STORE_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "catalog/store/jobs/job_record.h"

namespace plenum::catalog {

// A crash of the program in a thread that worked for a job.
struct JobCrash {
  std::int64_t number = 0;  // of the job
  std::string what;         // for people
};

// SQLite's own integrity check of a file of jobs, which is only read; empty: all is well. Throws
// StoreError, kBusy where a service holds the file.
std::vector<std::string> CheckJobs(const std::filesystem::path& path);

class JobStore {
 public:
  // Opens or creates `path`, readable by its owner only. Throws StoreError where it is held by
  // another process (kBusy, after two seconds), is not a file of jobs or is a newer one.
  JobStore(const std::filesystem::path& path, const JobsKept& kept);
  ~JobStore();
  JobStore(const JobStore&) = delete;
  JobStore& operator=(const JobStore&) = delete;

  // All throw StoreError where the disk is full or fails; then nothing was changed.
  JobRecord Add(const std::string& id, const JobOrder& order);
  void Start(const std::string& id);
  // Puts a job that was stopped in an orderly way back as it was before its start.
  void Requeue(const std::string& id);
  void AskToCancel(const std::string& id);
  // For who opened the file, so that no job can be under way: those that were when the last service
  // ended are queued again, to run alone, and those that crashed it have a crash more.
  void RequeueInterrupted(const std::vector<JobCrash>& crashes);
  // Queues a job that ended as if it was new, without its outcome. One that crashed gets one more
  // try, alone.
  void Again(const std::string& id);
  // Writes `status`, `progress`, `result` and `failure` of the record, and drops what ended long
  // ago. Returns `ended_at`.
  std::string End(const JobRecord& record);
  // All of them, which are of one kind, or none: one sync for a sweep that is cancelled.
  std::string End(std::span<const JobRecord> records);

  std::optional<JobRecord> Find(const std::string& kind, const std::string& id) const;
  std::optional<JobRecord> FindKey(const std::string& kind, const std::string& key) const;
  // Without request and result; and the result alone, empty where there is none.
  std::optional<JobRecord> Peek(const std::string& kind, const std::string& id) const;
  std::string Result(const std::string& kind, const std::string& id) const;
  // Without request and result: in the order in which they were added, and newest first. A record
  // that makes no sense is given as failed, with the reason.
  std::vector<JobRecord> Unfinished(const std::string& kind) const;
  std::vector<JobRecord> Ended(const std::string& kind) const;
  std::vector<JobRecord> List() const;  // of all kinds, newest first

  // A sweep and its jobs, all or nothing. Gives nothing where the sweep's key has one already.
  std::optional<SweepRecord> AddSweep(const SweepRecord& sweep, const std::vector<NewJob>& jobs);
  std::optional<SweepRecord> FindSweep(const std::string& kind, const std::string& id) const;
  std::optional<SweepRecord> FindSweepKey(const std::string& kind, const std::string& key) const;
  // Newest first, without their plans.
  std::vector<SweepRecord> Sweeps(const std::string& kind, int limit) const;
  // Without requests and results, in their order.
  std::vector<JobRecord> OfSweep(const std::string& id) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_JOB_STORE_H_
