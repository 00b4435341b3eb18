// A job as a value: what was asked, of which data, and what came out.
#ifndef PLENUM_CATALOG_STORE_JOBS_JOB_RECORD_H_
#define PLENUM_CATALOG_STORE_JOBS_JOB_RECORD_H_

#include <cstdint>
#include <map>
#include <string>

#include "catalog/store/revision.h"

namespace plenum::catalog {

enum class JobStatus { kQueued, kRunning, kDone, kCancelled, kFailed };
const char* Name(JobStatus status);
bool Ended(JobStatus status);

inline constexpr int kPriorityMax = 100;

// What a job is made of. Nothing else may decide its result, so that it can be done again after the
// service was killed, and its result be checked.
struct JobOrder {
  std::string kind;     // "design" or "diagnosis"
  std::string name;     // for people
  Signature by;         // who asked, and the key under which asking again gives the same job
  std::string request;  // the document as it was sent
  // The parts, as a revision of the catalogue; and the saved model, none for the nominal one.
  std::int64_t revision = 0;
  std::string hash;
  std::string model;
  std::int64_t model_version = 0;
  std::string model_hash;
  std::string client;  // who takes turns with others: the id of a token or an address
  int priority = 0;    // -kPriorityMax to kPriorityMax; of those that wait the highest goes first
  std::string sweep;   // the id of the sweep that it belongs to, empty for none
  int place = 0;       // in it, from 0
};

// Jobs that were asked for together, and what is told of them together.
struct SweepRecord {
  std::int64_t number = 0;  // in the order of adding
  std::string id;
  std::string kind;  // of its jobs
  std::string name;  // for people
  Signature by;
  std::string client;
  std::string submitted_at;
  std::int64_t revision = 0;  // of the catalogue
  std::string hash;
  std::string plan;  // JSON: what its table says beside the answers
  // Of its jobs, as they are now: how many there are of each status, and when the last one ended.
  std::map<JobStatus, int> jobs;
  std::string ended_at;  // empty until all have ended
};

struct NewJob {
  std::string id;
  JobOrder order;
};

struct JobRecord {
  std::int64_t number = 0;  // in the order of adding
  std::string id;
  JobOrder order;
  JobStatus status = JobStatus::kQueued;
  std::string submitted_at;  // UTC, ISO 8601
  std::string ended_at;      // empty until then
  std::int64_t ending = 0;   // of endings after as many starts, each has its own number
  int starts = 0;            // how often it was begun and not stopped in an orderly way
  int crashes = 0;           // how often its own computation ended the program
  int crashes_max = 2;       // after so many it has failed
  std::string crash;         // what is known of the last one; empty: none
  bool alone = false;        // it ran when the program ended: no other may run beside it
  bool cancel_asked = false;
  std::string progress, result;  // JSON, empty where there is none
  std::string failure;           // of a failed job: what a client is told
};

// How much of the jobs that ended is kept, of each kind: the newest.
struct JobsKept {
  int jobs = 256;
  std::int64_t bytes = 256 << 20;  // of requests and results; the newest is kept whatever its size
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_JOB_RECORD_H_
