#include "server/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <stdexcept>

#include "workbench.h"

namespace plenum::server {
namespace {

using namespace std::chrono_literals;
using catalog::JobOrder;

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
    return std::make_unique<Jobs>(*store_, "design", work, options);
  }
  // As after the process is gone: nothing but the file stays.
  void Forget(std::unique_ptr<Jobs>& jobs) {
    jobs.reset();
    store_.reset();
  }

  static std::string Begin(Jobs& jobs) {
    const std::string id = jobs.Submit(Order("long")).id;
    EXPECT_EQ(jobs.WaitForChange(id, 0, 10s)->status, JobStatus::kRunning);
    return id;
  }

  const Workbench bench_;
  catalog::JobsKept kept_;
  std::unique_ptr<catalog::JobStore> store_;
};

TEST_F(JobsTest, GivesTheResult) {
  const auto jobs = Open();
  const auto job = jobs->WaitForEnd(jobs->Submit(Order("ready")).id, 10s);
  EXPECT_EQ(job->status, JobStatus::kDone);
  EXPECT_EQ(job->result["answer"], 42);
  EXPECT_NE(job->ended_at, "");
  EXPECT_EQ(job->ended_at, jobs->Get(job->id)->ended_at);
}

TEST_F(JobsTest, FailuresEndTheJobOnly) {
  const auto jobs = Open({.workers = 1});
  const auto fault = jobs->WaitForEnd(jobs->Submit(Order("fault")).id, 10s);
  EXPECT_EQ(fault->status, JobStatus::kFailed);
  EXPECT_EQ(fault->failure, "a fault of the program; its log says more");
  const auto refused = jobs->WaitForEnd(jobs->Submit(Order("refused")).id, 10s);
  EXPECT_EQ(refused->status, JobStatus::kFailed);
  EXPECT_EQ(refused->failure, "/a: must be b");
  EXPECT_EQ(jobs->WaitForEnd(jobs->Submit(Order("ready")).id, 10s)->status, JobStatus::kDone);
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
  const auto job = jobs->WaitForEnd(id, 10s);
  EXPECT_EQ(job->status, JobStatus::kCancelled);
  EXPECT_EQ(job->result["best"], 1);
  EXPECT_FALSE(jobs->Cancel("none"));
  EXPECT_TRUE(jobs->Cancel(id));  // has ended, stays
  EXPECT_EQ(jobs->Get(id)->result["best"], 1);
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
  EXPECT_EQ(jobs->WaitForChange(id, started->revision, 10s)->progress["step"], 1);
}

TEST_F(JobsTest, OnlyTheNewestEndedAreKept) {
  kept_.jobs = 2;
  const auto jobs = Open({.workers = 2});
  const std::string running = Begin(*jobs);
  std::vector<std::string> ids;
  for (int i = 0; i < 4; ++i) {
    ids.push_back(jobs->Submit(Order("ready")).id);
    jobs->WaitForEnd(ids.back(), 10s);
  }
  EXPECT_FALSE(jobs->Get(ids[1]));
  const auto kept = jobs->List();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].id, ids[3]);
  EXPECT_EQ(kept[1].id, ids[2]);
  EXPECT_EQ(kept[2].id, running);
  // The job that was submitted first ends last, so it is the newest to have ended.
  jobs->Cancel(running);
  jobs->WaitForEnd(running, 10s);
  EXPECT_TRUE(jobs->Get(running));
  EXPECT_FALSE(jobs->Get(ids[2]));
}

TEST_F(JobsTest, WhatIsKeptIsBoundedInBytesToo) {
  kept_.bytes = 1000;
  const auto jobs = Open({.workers = 1});
  std::vector<std::string> ids;
  for (const int bytes : {300, 300, 300, 2000, 300}) {
    ids.push_back(jobs->Submit(Order(std::string(bytes, 'x'))).id);
    jobs->WaitForEnd(ids.back(), 10s);
    EXPECT_TRUE(jobs->Get(ids.back()));  // the newest whatever its size
  }
  EXPECT_EQ(jobs->List().size(), 1u);
  const std::string next = jobs->Submit(Order("ready")).id;
  jobs->WaitForEnd(next, 10s);
  EXPECT_EQ(jobs->List().size(), 2u);
}

TEST_F(JobsTest, AKeyGivesTheSameJob) {
  auto jobs = Open();
  const auto first = jobs->Submit(Order("ready", "k"));
  jobs->WaitForEnd(first.id, 10s);
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
    jobs->WaitForEnd(ids.back(), 10s);
  }
  Forget(jobs);
  jobs = Open();
  const auto done = jobs->Get(ids[0]);
  EXPECT_EQ(done->status, JobStatus::kDone);
  EXPECT_EQ(done->name, "the ready");
  EXPECT_EQ(done->result["answer"], 42);
  EXPECT_EQ(done->progress["step"], 1);
  EXPECT_EQ(done->catalogue_revision, 7);
  EXPECT_EQ(done->submitted_at.size(), 20u);
  EXPECT_GE(done->ended_at, done->submitted_at);
  EXPECT_EQ(jobs->Get(ids[1])->failure, "/a: must be b");
  EXPECT_EQ(jobs->WaitForEnd(ids[2], 0s)->status, JobStatus::kFailed);
  const auto list = jobs->List();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].id, ids[2]);
  EXPECT_TRUE(list[2].result.is_null());
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
  EXPECT_EQ(jobs->WaitForEnd(running, 10s)->result["again"], "long");
  EXPECT_EQ(jobs->WaitForEnd(queued, 10s)->result["again"], "ready");
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

TEST_F(JobsTest, AJobThatTheServiceDiedOfIsNotBegunForEver) {
  const auto begin = [&](int starts) {
    catalog::JobStore store(bench_.Path("jobs"), kept_);
    JobOrder order = Order("ready");
    order.kind = "design";
    const std::string id = "after-" + std::to_string(starts);
    store.Add(id, order);
    for (int i = 0; i < starts; ++i) store.Start(id);
    return id;
  };
  const std::string unlucky = begin(4), deadly = begin(5);
  auto jobs = Open({.workers = 1});
  EXPECT_EQ(jobs->WaitForEnd(unlucky, 10s)->status, JobStatus::kDone);
  EXPECT_EQ(jobs->Get(deadly)->status, JobStatus::kFailed);
  EXPECT_EQ(jobs->Get(deadly)->failure, "the service was killed 5 times while the job ran");
  // Stops in an orderly way do not count.
  const std::string patient = Begin(*jobs);
  for (int i = 0; i < 7; ++i) {
    Forget(jobs);
    jobs = Open({.workers = 1});
    EXPECT_EQ(jobs->WaitForChange(patient, 0, 10s)->status, JobStatus::kRunning);
  }
}

TEST_F(JobsTest, StopInterruptsAndReleases) {
  const auto jobs = Open({.workers = 1});
  const std::string running = Begin(*jobs), queued = jobs->Submit(Order("ready")).id;
  auto waiting = std::async(std::launch::async, [&] { return jobs->WaitForEnd(running, 60s); });
  jobs->Stop();
  EXPECT_FALSE(Ended(waiting.get()->status));
  EXPECT_FALSE(Ended(jobs->Get(queued)->status));
  EXPECT_EQ(jobs->Submit(Order("late")).status, Submitted::kRefused);
}

TEST_F(JobsTest, KindsDoNotMix) {
  const auto designs = Open();
  Jobs diagnoses(*store_, "diagnosis", Do, {});
  const std::string id = designs->Submit(Order("ready", "k")).id;
  designs->WaitForEnd(id, 10s);
  EXPECT_FALSE(diagnoses.Get(id));
  EXPECT_TRUE(diagnoses.List().empty());
  EXPECT_EQ(diagnoses.Submit(Order("ready", "k")).status, Submitted::kAccepted);
}

}  // namespace
}  // namespace plenum::server
