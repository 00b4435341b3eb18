// Jobs that services and workers share on a server of PostgreSQL.
#include "server/jobs/shared_jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "api/json/version.h"
#include "server/jobs/job_worker.h"
#include "server/jobs/jobs.h"
#include "tests/server/jobs/waiting.h"
#include "tests/support/postgres/postgres_server.h"

namespace plenum::server {
namespace shared_jobs_test {

using namespace std::chrono_literals;
using catalog::JobOrder;
using testing::HasSubstr;

// What the requests of these tests ask for: "ready" at once, "long" until cancelled, "refused",
// "fault", "slow" for half a second.
api::Parsed<api::Json> Do(const JobOrder& order, const JobControl& control) {
  if (order.request == "fault") throw std::runtime_error("oh");
  if (order.request == "refused") return api::Errors{{"/a", "must be b"}};
  if (order.request == "away") throw catalog::StoreError("server away", catalog::StoreFault::kAway);
  if (order.request == "long")
    while (!control.cancelled()) std::this_thread::sleep_for(1ms);
  if (order.request == "slow") std::this_thread::sleep_for(500ms);
  control.report({{"step", 1}});
  return api::Json{{"answer", 42}, {"of", order.name}};
}

class SharedQueue : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (const std::string why = test::WhyNoPostgres(); !why.empty()) GTEST_SKIP() << why;
    address_ = test::NewDatabase();
    store_ = std::make_unique<catalog::SharedJobStore>(address_, Version());
    jobs_ = Service();
  }
  static std::string Version() { return std::string(api::Version()); }
  std::unique_ptr<SharedJobs> Service(JobOptions options = {}) const {
    return std::make_unique<SharedJobs>(*store_, "design", options, [] {});
  }
  std::unique_ptr<JobWorker> Worker(int threads = 1, const Work& work = Do) const {
    WorkerOptions options;
    options.threads = threads;
    options.lease = 1s;
    options.pause = 20ms;
    return std::make_unique<JobWorker>(address_, std::map<std::string, Work>{{"design", work}},
                                       options);
  }
  static JobOrder Order(const std::string& request, const std::string& key = "") {
    JobOrder order;
    order.name = "the " + request;
    order.by = {"bench", key, key.empty() ? "" : "digest of " + request};
    order.request = request;
    order.client = "ann";
    order.hash = std::string(64, 'a');
    return order;
  }
  std::string Begin(const std::string& request) {
    std::string id = jobs_->Submit(Order(request)).id;
    WaitUntil(*jobs_, id, 10s, [](const Job& job) { return job.status != JobStatus::kQueued; });
    EXPECT_EQ(jobs_->Get(id)->status, JobStatus::kRunning);
    return id;
  }

  std::string address_;
  std::unique_ptr<catalog::SharedJobStore> store_;
  std::unique_ptr<SharedJobs> jobs_;
};

TEST_P(SharedQueue, AnyWorkerDoesTheJobsOfAnyService) {
  const auto other = Service();
  const std::string one = jobs_->Submit(Order("ready")).id, two = other->Submit(Order("ready")).id;
  EXPECT_EQ(jobs_->Count(JobStatus::kQueued), 2u);
  const auto worker = Worker();
  for (const std::string& id : {one, two}) {
    const auto job = WaitForEnd(*jobs_, id, 10s);
    EXPECT_EQ(job->status, JobStatus::kDone);
    EXPECT_EQ(*job->result, "{\"answer\":42,\"of\":\"the ready\"}");
    EXPECT_EQ(job->progress["step"], 1);
    EXPECT_EQ(job->attempts, 1);
    EXPECT_EQ(*other->Get(id)->result, *job->result);
  }
  EXPECT_EQ(jobs_->List().size(), 2u);
  EXPECT_FALSE(jobs_->Get("unknown"));
}

TEST_P(SharedQueue, FaultsAndRefusalsEndAJobAndItCanBeAskedForAgain) {
  const auto worker = Worker();
  const std::string fault = jobs_->Submit(Order("fault")).id;
  const std::string refused = jobs_->Submit(Order("refused")).id;
  EXPECT_THAT(WaitForEnd(*jobs_, fault, 10s)->failure, HasSubstr("a fault of the program"));
  EXPECT_EQ(WaitForEnd(*jobs_, refused, 10s)->failure, "/a: must be b");
  EXPECT_EQ(jobs_->Again(refused), Asked::kQueued);
  const auto again = WaitUntil(
      *jobs_, refused, 10s, [](const Job& job) { return Ended(job.status) && job.attempts == 2; });
  EXPECT_EQ(again->status, JobStatus::kFailed);
  EXPECT_EQ(jobs_->Again("unknown"), Asked::kUnknown);
  const std::string done = jobs_->Submit(Order("ready")).id;
  WaitForEnd(*jobs_, done, 10s);
  EXPECT_EQ(jobs_->Again(done), Asked::kDone);
}

TEST_P(SharedQueue, AKeyStandsForOneRequestInAllServices) {
  const auto first = jobs_->Submit(Order("ready", "k"));
  const auto repeated = Service()->Submit(Order("ready", "k"));
  EXPECT_EQ(repeated.status, Submitted::kRepeated);
  EXPECT_EQ(repeated.id, first.id);
  EXPECT_EQ(Service()->Submit(Order("long", "k")).status, Submitted::kKeyReused);
}

TEST_P(SharedQueue, LimitsCountTheJobsOfAllServices) {
  const auto strict = Service({.workers = 1, .queued_max = 3, .queued_per_client_max = 2});
  jobs_->Submit(Order("ready"));
  EXPECT_EQ(strict->Submit(Order("ready")).status, Submitted::kAccepted);
  EXPECT_EQ(strict->Submit(Order("ready")).status, Submitted::kClientRefused);
  JobOrder others = Order("ready");
  others.client = "bob";
  EXPECT_EQ(strict->Submit(others).status, Submitted::kAccepted);
  EXPECT_EQ(strict->Submit(others).status, Submitted::kRefused);
}

TEST_P(SharedQueue, CancelReachesTheWorkerAndItsBestIsKept) {
  const auto worker = Worker();
  const std::string id = Begin("long");
  EXPECT_TRUE(Service()->Cancel(id));
  const auto job = WaitForEnd(*jobs_, id, 10s);
  EXPECT_EQ(job->status, JobStatus::kCancelled);
  EXPECT_TRUE(job->result);
  EXPECT_FALSE(jobs_->Cancel("unknown"));
}

TEST_P(SharedQueue, AStoppedWorkerGivesItsJobBack) {
  auto worker = Worker();
  const std::string id = Begin("long");
  worker->Stop();
  const auto job = jobs_->Get(id);
  EXPECT_EQ(job->status, JobStatus::kQueued);
  EXPECT_EQ(job->attempts, 0);
  EXPECT_EQ(store_->Queue(1h).workers, 0);
}

TEST_P(SharedQueue, ADrainedWorkerEndsItsJobAndTakesNoOther) {
  auto worker = Worker();
  const std::string id = Begin("slow");
  const std::string next = jobs_->Submit(Order("ready")).id;
  worker->Drain();
  EXPECT_EQ(WaitForEnd(*jobs_, id, 10s)->status, JobStatus::kDone);
  worker->Stop();
  EXPECT_EQ(jobs_->Get(next)->status, JobStatus::kQueued);
}

TEST_P(SharedQueue, AJobWhoseServerIsAwayIsBegunAnewAndDoesNotFail) {
  std::atomic<int> begun = 0;
  const auto worker = Worker(1, [&](const JobOrder& order, const JobControl& control) {
    JobOrder away = order;
    if (++begun < 3) away.request = "away";
    return Do(away, control);
  });
  const auto job = WaitForEnd(*jobs_, jobs_->Submit(Order("ready")).id, 10s);
  EXPECT_EQ(job->status, JobStatus::kDone);
  EXPECT_EQ(begun, 3);
}

TEST_P(SharedQueue, WhatIsComputedOutlastsCutsAndACrashOfTheServer) {
  const auto worker = Worker(2);
  const std::string one = Begin("slow"), two = Begin("slow");
  test::CutSessions();
  EXPECT_EQ(WaitForEnd(*jobs_, one, 10s)->status, JobStatus::kDone);
  EXPECT_EQ(WaitForEnd(*jobs_, two, 10s)->status, JobStatus::kDone);
  const std::string three = Begin("slow");
  test::CrashPostgres();
  EXPECT_EQ(WaitForEnd(*jobs_, three, 20s)->status, JobStatus::kDone);
  EXPECT_EQ(WaitForEnd(*jobs_, jobs_->Submit(Order("ready")).id, 20s)->status, JobStatus::kDone);
}

// Two computed it; the result of the second counts.
TEST_P(SharedQueue, AWorkerThatLostItsLeaseOverwritesNothing) {
  const std::string id = jobs_->Submit(Order("ready")).id;
  const auto first = store_->Claim({"design"}, "first", 1ms).value();
  std::this_thread::sleep_for(20ms);
  const auto worker = Worker();
  const auto job = WaitForEnd(*jobs_, id, 10s);
  catalog::JobRecord late = first.job;
  late.status = JobStatus::kDone;
  late.result = "\"late\"";
  EXPECT_FALSE(store_->End(first, late));
  EXPECT_EQ(*jobs_->Get(id)->result, *job->result);
  EXPECT_EQ(job->attempts, 2);
  EXPECT_EQ(job->crashes, 1);
}

TEST_P(SharedQueue, ManyWorkersDoManyJobsOnceEach) {
  constexpr int kJobs = 200;
  std::mutex mutex;
  std::multiset<std::string> done;
  const Work work = [&](const JobOrder& order, const JobControl& control) {
    {
      const std::lock_guard lock(mutex);
      done.insert(order.name);
    }
    return Do(order, control);
  };
  JobOptions options;
  options.queued_per_client_max = kJobs;
  options.queued_max = 2 * kJobs;
  const auto service = Service(options);
  std::vector<std::string> ids;
  for (int i = 0; i < kJobs; ++i) {
    JobOrder order = Order("ready");
    order.name = std::to_string(i);
    ids.push_back(service->Submit(order).id);
  }
  const auto one = Worker(3, work), two = Worker(3, work);
  for (const std::string& id : ids)
    EXPECT_EQ(WaitForEnd(*service, id, 30s)->status, JobStatus::kDone);
  EXPECT_EQ(done.size(), std::size_t{kJobs});
  EXPECT_EQ(std::set<std::string>(done.begin(), done.end()).size(), std::size_t{kJobs});
}

// The names end in "/Postgresql", which tests/CMakeLists.txt runs together, on one server.
INSTANTIATE_TEST_SUITE_P(Each, SharedQueue, testing::Values("Postgresql"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace shared_jobs_test
}  // namespace plenum::server
