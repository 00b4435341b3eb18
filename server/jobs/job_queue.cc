#include "server/jobs/job_queue.h"

#include <sys/resource.h>

#include <cstdio>
#include <exception>
#include <new>
#include <random>
#include <utility>

#include "server/call/reply.h"
#include "server/call/request_log.h"
#include "server/jobs/job_memory.h"

namespace plenum::server {
namespace {

constexpr int kNiceness = 10;
constexpr std::size_t kMuchMemoryBytes = 64 << 20;
constexpr char kTooMuchMemory[] =
    "it needed more memory than the service can get; ask for less at once, as fewer groups or "
    "samples, or give the service more memory";

}  // namespace

std::string RandomId() {
  std::random_device random;
  char text[17];
  std::snprintf(text, sizeof text, "%08x%08x", static_cast<unsigned>(random()),
                static_cast<unsigned>(random()));
  return text;
}

bool TryStore(const api::Json& about, const std::function<void()>& act) {
  try {
    act();
    return true;
  } catch (const catalog::StoreError& error) {
    api::Json line = {{"level", "error"}};
    line.update(about);
    line["fault"] = error.what();
    Log(line);
    return false;
  }
}

std::string TextOf(const api::Json& json) { return json.is_null() ? "" : Dump(json); }

Job ToJob(const catalog::JobRecord& record) {
  Job job;
  job.number = record.number;
  job.id = record.id;
  job.name = record.order.name;
  job.status = record.status;
  job.progress = api::Json::parse(record.progress, nullptr, false);
  if (job.progress.is_discarded()) job.progress = nullptr;
  job.failure = record.failure;
  job.attempts = record.starts;
  job.crashes = record.crashes;
  job.crash = record.crash;
  job.alone = record.alone;
  job.submitted_at = record.submitted_at;
  job.ended_at = record.ended_at;
  if (Ended(job.status)) job.revision = record.ending;
  job.catalogue.number = record.order.revision;
  job.catalogue.hash = record.order.hash;
  job.sweep = record.order.sweep;
  return job;
}

std::vector<catalog::NewJob> JobsOf(catalog::SweepRecord& sweep,
                                    std::vector<catalog::JobOrder> orders) {
  sweep.id = RandomId();
  std::vector<catalog::NewJob> jobs;
  jobs.reserve(orders.size());
  for (catalog::JobOrder& order : orders) {
    order.kind = sweep.kind;
    order.sweep = sweep.id;
    order.place = static_cast<int>(jobs.size());
    jobs.push_back({RandomId(), std::move(order)});
  }
  return jobs;
}

std::string WordsOf(const api::Errors& errors) {
  std::string list;
  for (const api::Error& error : errors)
    list += (list.empty() ? "" : "; ") + (error.pointer.empty() ? "" : error.pointer + ": ") +
            error.detail;
  return list;
}

api::Parsed<api::Json> OutcomeOf(const Work& work, const catalog::JobOrder& order,
                                 const std::string& id, const JobControl& control) {
  try {
    return work(order, control);
  } catch (const std::bad_alloc&) {
    return api::Errors{{"", kTooMuchMemory}};
  } catch (const std::exception& error) {
    Log({{"level", "error"}, {"job", id}, {"fault", error.what()}});
    return api::Errors{{"", "a fault of the program; its log says more"}};
  }
}

// On Linux the niceness is the thread's.
void WorkBehindRequests() {
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kNiceness);
}

// It takes a while, and who sees that a job has ended may count on its worker.
void ReturnMemoryAfter(const std::function<void()>& work) {
  const std::size_t before = ResidentBytes();
  work();
  if (ResidentBytes() > before + kMuchMemoryBytes) ReturnFreeMemory();
}

}  // namespace plenum::server
