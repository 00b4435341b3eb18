#include "server/jobs/jobs.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>
#include <stdexcept>

#include "server/jobs/job_recovery.h"
#include "tests/server/jobs/waiting.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace jobs_test {

using namespace std::chrono_literals;
using catalog::JobOrder;
using testing::HasSubstr;
using testing::StartsWith;

// Until it is cancelled; then what it has.
api::Json BestSoFar(const JobControl& control) {
  while (!control.cancelled()) std::this_thread::sleep_for(1ms);
  return {{"best", 1}};
}

class JobsTest : public testing::Test {
 protected:
  static JobOrder Order(const std::string& request, const std::string& key = "") {
    JobOrder order;
    order.name = "the " + request;
    order.by = {"bench", key, key.empty() ? "" : "digest of " + request};
    order.request = request;
    order.revision = 7;
    order.hash = std::string(64, 'a');
    return order;
  }

  // What an order asks for: "ready" at once, "long" until cancelled, "refused", "fault".
  static api::Parsed<api::Json> Do(const JobOrder& order, const JobControl& control) {
    if (order.request == "fault") throw std::runtime_error("oh");
    if (order.request == "refused") return api::Errors{{"/a", "must be b"}};
    if (order.request == "long") return BestSoFar(control);
    control.report({{"step", 1}});
    return api::Json{{"answer", 42}, {"revision", order.revision}};
  }

  std::unique_ptr<Jobs> Open(JobOptions options = {}, const Work& work = Do) {
    if (!store_) store_ = std::make_unique<catalog::JobStore>(bench_.Path("jobs"), kept_);
    return std::make_unique<Jobs>(*store_, turns_, "design", work, options);
  }
  // As after the process is gone: nothing but the file stays.
  void Forget(std::unique_ptr<Jobs>& jobs) {
    jobs.reset();
    store_.reset();
  }

  static std::string Begin(Jobs& jobs) {
    std::string id = jobs.Submit(Order("long")).id;
    EXPECT_EQ(WaitForChange(jobs, id, 0, 10s)->status, JobStatus::kRunning);
    return id;
  }

  const Workbench bench_;
  catalog::JobsKept kept_;
  std::unique_ptr<catalog::JobStore> store_;
  JobTurns turns_;
};

TEST_F(JobsTest, GivesTheResult) {
  const auto jobs = Open();
  const auto job = WaitForEnd(*jobs, jobs->Submit(Order("ready")).id, 10s);
  EXPECT_EQ(job->status, JobStatus::kDone);
  EXPECT_EQ(Result(job)["answer"], 42);
  EXPECT_NE(job->ended_at, "");
  EXPECT_EQ(job->ended_at, jobs->Get(job->id)->ended_at);
}

TEST_F(JobsTest, FailuresEndTheJobOnly) {
  const auto jobs = Open({.workers = 1});
  const auto fault = WaitForEnd(*jobs, jobs->Submit(Order("fault")).id, 10s);
  EXPECT_EQ(fault->status, JobStatus::kFailed);
  EXPECT_EQ(fault->failure, "a fault of the program; its log says more");
  const auto refused = WaitForEnd(*jobs, jobs->Submit(Order("refused")).id, 10s);
  EXPECT_EQ(refused->status, JobStatus::kFailed);
  EXPECT_EQ(refused->failure, "/a: must be b");
  EXPECT_EQ(WaitForEnd(*jobs, jobs->Submit(Order("ready")).id, 10s)->status, JobStatus::kDone);
}

TEST_F(JobsTest, TheQueueIsBounded) {
  const auto jobs = Open({.workers = 1, .queued_max = 1});
  const std::string running = Begin(*jobs);
  const auto queued = jobs->Submit(Order("ready"));
  ASSERT_EQ(queued.status, Submitted::kAccepted);
  EXPECT_EQ(jobs->Submit(Order("ready")).status, Submitted::kRefused);
  jobs->Cancel(queued.id);
  EXPECT_EQ(jobs->Get(queued.id)->status, JobStatus::kCancelled);
  EXPECT_EQ(jobs->Submit(Order("ready")).status, Submitted::kAccepted);
}

TEST_F(JobsTest, ACancelledJobKeepsWhatItFound) {
  const auto jobs = Open();
  const std::string id = Begin(*jobs);
  EXPECT_TRUE(jobs->Cancel(id));
  const auto job = WaitForEnd(*jobs, id, 10s);
  EXPECT_EQ(job->status, JobStatus::kCancelled);
  EXPECT_EQ(Result(job)["best"], 1);
  EXPECT_FALSE(jobs->Cancel("none"));
  EXPECT_TRUE(jobs->Cancel(id));  // has ended, stays
  EXPECT_EQ(Result(jobs->Get(id))["best"], 1);
}

TEST_F(JobsTest, ProgressWakesWhoWaits) {
  std::promise<void> go;
  const auto gate = go.get_future().share();
  const auto jobs = Open({}, [gate](const JobOrder&, const JobControl& control) {
    gate.wait();
    control.report({{"step", 1}});
    return BestSoFar(control);
  });
  const std::string id = Begin(*jobs);
  const auto started = jobs->Get(id);
  go.set_value();
  EXPECT_EQ(WaitForChange(*jobs, id, started->revision, 10s)->progress["step"], 1);
}

TEST_F(JobsTest, OnlyTheNewestEndedAreKept) {
  kept_.jobs = 2;
  const auto jobs = Open({.workers = 2});
  const std::string running = Begin(*jobs);
  std::vector<std::string> ids;
  for (int i = 0; i < 4; ++i) {
    ids.push_back(jobs->Submit(Order("ready")).id);
    WaitForEnd(*jobs, ids.back(), 10s);
  }
  EXPECT_FALSE(jobs->Get(ids[1]));
  const auto kept = jobs->List();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].id, ids[3]);
  EXPECT_EQ(kept[1].id, ids[2]);
  EXPECT_EQ(kept[2].id, running);
  // The job that was submitted first ends last, so it is the newest to have ended.
  jobs->Cancel(running);
  WaitForEnd(*jobs, running, 10s);
  EXPECT_TRUE(jobs->Get(running));
  EXPECT_FALSE(jobs->Get(ids[2]));
}

TEST_F(JobsTest, WhatIsKeptIsBoundedInBytesToo) {
  kept_.bytes = 1000;
  const auto jobs = Open({.workers = 1});
  std::vector<std::string> ids;
  for (const int bytes : {300, 300, 300, 2000, 300}) {
    ids.push_back(jobs->Submit(Order(std::string(bytes, 'x'))).id);
    WaitForEnd(*jobs, ids.back(), 10s);
    EXPECT_TRUE(jobs->Get(ids.back()));  // the newest whatever its size
  }
  EXPECT_EQ(jobs->List().size(), 1u);
  const std::string next = jobs->Submit(Order("ready")).id;
  WaitForEnd(*jobs, next, 10s);
  EXPECT_EQ(jobs->List().size(), 2u);
}

TEST_F(JobsTest, AKeyGivesTheSameJob) {
  auto jobs = Open();
  const auto first = jobs->Submit(Order("ready", "k"));
  WaitForEnd(*jobs, first.id, 10s);
  Forget(jobs);
  jobs = Open();
  const auto again = jobs->Submit(Order("ready", "k"));
  EXPECT_EQ(again.status, Submitted::kRepeated);
  EXPECT_EQ(again.id, first.id);
  EXPECT_EQ(jobs->Submit(Order("other", "k")).status, Submitted::kKeyReused);
  EXPECT_EQ(jobs->List().size(), 1u);
}

TEST_F(JobsTest, EndedJobsStayReadableAfterARestart) {
  auto jobs = Open();
  std::vector<std::string> ids;
  for (const char* request : {"ready", "refused", "fault"}) {
    ids.push_back(jobs->Submit(Order(request)).id);
    WaitForEnd(*jobs, ids.back(), 10s);
  }
  Forget(jobs);
  jobs = Open();
  const auto done = jobs->Get(ids[0]);
  EXPECT_EQ(done->status, JobStatus::kDone);
  EXPECT_EQ(done->name, "the ready");
  EXPECT_EQ(Result(done)["answer"], 42);
  EXPECT_EQ(done->progress["step"], 1);
  EXPECT_EQ(done->catalogue.number, 7);
  EXPECT_EQ(done->submitted_at.size(), 20u);
  EXPECT_GE(done->ended_at, done->submitted_at);
  EXPECT_EQ(jobs->Get(ids[1])->failure, "/a: must be b");
  EXPECT_EQ(WaitForEnd(*jobs, ids[2], 0s)->status, JobStatus::kFailed);
  const auto list = jobs->List();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].id, ids[2]);
  EXPECT_FALSE(list[2].result);
}

TEST_F(JobsTest, WhatHasNotEndedIsDoneAfterARestart) {
  auto jobs = Open({.workers = 1});
  const std::string running = Begin(*jobs), queued = jobs->Submit(Order("ready")).id,
                    cancelled = jobs->Submit(Order("ready")).id;
  jobs->Cancel(cancelled);
  Forget(jobs);
  jobs = Open({.workers = 1, .queued_max = 0}, [](const JobOrder& order, const JobControl&) {
    return api::Json{{"again", order.request}};
  });
  EXPECT_EQ(Result(WaitForEnd(*jobs, running, 10s))["again"], "long");
  EXPECT_EQ(Result(WaitForEnd(*jobs, queued, 10s))["again"], "ready");
  EXPECT_EQ(jobs->Get(cancelled)->status, JobStatus::kCancelled);
}

TEST_F(JobsTest, ACancelThatWasAskedForOutlastsAKill) {
  auto jobs = Open();
  Forget(jobs);
  {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    JobOrder order = Order("long");
    order.kind = "design";
    store.Add("one", order);
    store.Start("one");
    store.AskToCancel("one");
  }
  EXPECT_EQ(Open()->Get("one")->status, JobStatus::kCancelled);
}

// Which jobs ran at the same time.
struct Together {
  std::mutex mutex;
  std::set<std::string> running;
  std::set<std::pair<std::string, std::string>> pairs;

  api::Json Run(const std::string& name) {
    {
      const std::lock_guard lock(mutex);
      for (const std::string& other : running) pairs.insert(std::minmax(name, other));
      running.insert(name);
    }
    std::this_thread::sleep_for(50ms);
    const std::lock_guard lock(mutex);
    running.erase(name);
    return {{"name", name}};
  }
};

TEST_F(JobsTest, WhatRanWhenTheServiceDiedGoesOneAtATimeHoweverOftenItDied) {
  {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    for (const char* kind : {"design", "diagnosis"})
      for (const char* name : {"ran", "ran too", "waits", "waits too"}) {
        JobOrder order = Order(std::string(name) + ", " + kind);
        order.kind = kind;
        store.Add(order.request, order);
      }
  }
  for (int death = 0; death < 20; ++death) {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    RecoverJobs(store, bench_.Path("no marks"));
    for (const char* id :
         {"ran, design", "ran too, design", "ran, diagnosis", "ran too, diagnosis"})
      store.Start(id);
  }
  store_ = std::make_unique<catalog::JobStore>(bench_.Path("jobs"), kept_);
  RecoverJobs(*store_, bench_.Path("no marks"));
  Together together;
  const Work work = [&](const JobOrder& order, const JobControl&) {
    return together.Run(order.request);
  };
  Jobs designs(*store_, turns_, "design", work, {}),
      diagnoses(*store_, turns_, "diagnosis", work, {});
  for (Jobs* jobs : {&designs, &diagnoses})
    for (const Job& job : jobs->List())
      EXPECT_EQ(WaitForEnd(*jobs, job.id, 10s)->status, JobStatus::kDone);
  EXPECT_EQ(designs.Get("ran, design")->attempts, 21);
  EXPECT_EQ(designs.Get("waits, design")->attempts, 1);
  EXPECT_TRUE(together.pairs.contains({"waits too, design", "waits, design"}));
  for (const auto& [one, other] : together.pairs) {
    EXPECT_THAT(one, StartsWith("waits"));
    EXPECT_THAT(other, StartsWith("waits"));
  }
}

TEST_F(JobsTest, AJobThatWaitsToRunAloneCanBeCancelled) {
  {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    JobOrder order = Order("long");
    order.kind = "design";
    for (const char* id : {"one", "two"}) {
      store.Add(id, order);
      store.Start(id);
    }
    RecoverJobs(store, bench_.Path("no marks"));
  }
  const auto jobs = Open();
  EXPECT_EQ(WaitForChange(*jobs, "one", 0, 10s)->status, JobStatus::kRunning);
  jobs->Cancel("two");
  const std::string normal = jobs->Submit(Order("ready")).id;
  EXPECT_EQ(WaitForEnd(*jobs, normal, 100ms)->status, JobStatus::kQueued);
  jobs->Cancel("one");
  EXPECT_EQ(WaitForEnd(*jobs, normal, 10s)->status, JobStatus::kDone);
}

TEST_F(JobsTest, OrderlyStopsAreNoAttempts) {
  auto jobs = Open({.workers = 1});
  const std::string patient = Begin(*jobs);
  for (int i = 0; i < 7; ++i) {
    Forget(jobs);
    jobs = Open({.workers = 1});
    const auto job = WaitForChange(*jobs, patient, 0, 10s);
    EXPECT_EQ(job->status, JobStatus::kRunning);
    EXPECT_EQ(job->attempts, 1);
    EXPECT_FALSE(job->alone);
  }
}

TEST_F(JobsTest, WhatFailedOrWasCancelledCanBeAskedForAgain) {
  std::atomic<bool> mended = false;
  const auto jobs =
      Open({.workers = 1, .queued_max = 2}, [&](const JobOrder& order, const JobControl& control) {
        return mended ? api::Parsed<api::Json>(api::Json{{"now", "fine"}}) : Do(order, control);
      });
  const std::string fault = jobs->Submit(Order("fault")).id, done = jobs->Submit(Order("ready")).id;
  WaitForEnd(*jobs, fault, 10s);
  WaitForEnd(*jobs, done, 10s);
  const std::string running = Begin(*jobs), waiting = jobs->Submit(Order("ready")).id;
  EXPECT_EQ(jobs->Again("none"), Asked::kUnknown);
  EXPECT_EQ(jobs->Again(done), Asked::kDone);
  EXPECT_EQ(jobs->Again(running), Asked::kUnderWay);
  EXPECT_EQ(jobs->Again(waiting), Asked::kUnderWay);
  EXPECT_EQ(jobs->Again(fault), Asked::kQueued);
  EXPECT_EQ(jobs->Again(fault), Asked::kUnderWay);
  EXPECT_EQ(jobs->Get(fault)->failure, "");
  jobs->Cancel(waiting);
  jobs->Submit(Order("ready"));
  EXPECT_EQ(jobs->Again(waiting), Asked::kRefused);  // the queue is full
  mended = true;
  jobs->Cancel(running);
  const auto ended = WaitForEnd(*jobs, fault, 10s);
  EXPECT_EQ(ended->status, JobStatus::kDone);
  EXPECT_EQ(Result(ended)["now"], "fine");
  EXPECT_EQ(ended->attempts, 2);
  EXPECT_EQ(jobs->Again(running), Asked::kQueued);
  EXPECT_EQ(Result(WaitForEnd(*jobs, running, 10s))["now"], "fine");
}

TEST_F(JobsTest, DamagedRecordsFailAndKeepNothingElseFromStarting) {
  {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    JobOrder order = Order("ready");
    order.kind = "design";
    for (const char* id : {"progress", "result", "status", "sound"}) store.Add(id, order);
    auto ended = store.Find("design", "result").value();
    ended.status = JobStatus::kDone;
    ended.result = "{";
    store.End(ended);
  }
  {
    SQLite::Database db(bench_.Path("jobs").string(), SQLite::OPEN_READWRITE);
    db.exec("PRAGMA ignore_check_constraints = ON");
    db.exec("UPDATE job SET progress = '[1,' WHERE id = 'progress'");
    db.exec("UPDATE job SET status = 'odd' WHERE id = 'status'");
  }
  store_ = std::make_unique<catalog::JobStore>(bench_.Path("jobs"), kept_);
  RecoverJobs(*store_, bench_.Path("no marks"));
  const auto jobs = Open();
  EXPECT_EQ(WaitForEnd(*jobs, "progress", 10s)->status, JobStatus::kDone);
  EXPECT_EQ(WaitForEnd(*jobs, "sound", 10s)->status, JobStatus::kDone);
  EXPECT_EQ(jobs->Get("status")->status, JobStatus::kFailed);
  EXPECT_THAT(jobs->Get("status")->failure, HasSubstr("unknown status \"odd\""));
  EXPECT_EQ(jobs->Get("result")->status, JobStatus::kFailed);
  EXPECT_THAT(jobs->Get("result")->failure, HasSubstr("damaged"));
  EXPECT_EQ(jobs->List().size(), 4u);
}

TEST_F(JobsTest, StopInterrupts) {
  const auto jobs = Open({.workers = 1});
  const std::string running = Begin(*jobs), queued = jobs->Submit(Order("ready")).id;
  jobs->Stop();
  for (const std::string& id : {running, queued}) EXPECT_FALSE(Ended(jobs->Get(id)->status));
  EXPECT_EQ(jobs->Submit(Order("late")).status, Submitted::kRefused);
}

TEST_F(JobsTest, KindsDoNotMix) {
  const auto designs = Open();
  Jobs diagnoses(*store_, turns_, "diagnosis", Do, {});
  const std::string id = designs->Submit(Order("ready", "k")).id;
  WaitForEnd(*designs, id, 10s);
  EXPECT_FALSE(diagnoses.Get(id));
  EXPECT_TRUE(diagnoses.List().empty());
  EXPECT_EQ(diagnoses.Submit(Order("ready", "k")).status, Submitted::kAccepted);
}

}  // namespace jobs_test
}  // namespace plenum::server
