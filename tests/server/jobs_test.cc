#include "server/jobs.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

namespace plenum::server {
namespace {

using namespace std::chrono_literals;

Work Ready() {
  return [](const JobControl&) { return api::Json{{"answer", 42}}; };
}

// Runs until it is cancelled, then gives what it has.
Work UntilCancelled() {
  return [](const JobControl& control) {
    while (!control.cancelled()) std::this_thread::sleep_for(1ms);
    return api::Json{{"best", 1}};
  };
}

TEST(Jobs, GivesTheResult) {
  Jobs jobs({});
  const auto id = jobs.Submit("a", Ready());
  const auto job = jobs.WaitForEnd(*id, 10s);
  EXPECT_EQ(job->status, JobStatus::kDone);
  EXPECT_EQ(job->result["answer"], 42);
}

TEST(Jobs, AnExceptionFailsTheJobOnly) {
  Jobs jobs({.workers = 1});
  const auto bad =
      jobs.Submit("bad", [](const JobControl&) -> api::Json { throw std::runtime_error("oh"); });
  EXPECT_EQ(jobs.WaitForEnd(*bad, 10s)->status, JobStatus::kFailed);
  const auto good = jobs.Submit("good", Ready());
  EXPECT_EQ(jobs.WaitForEnd(*good, 10s)->status, JobStatus::kDone);
}

TEST(Jobs, TheQueueIsBounded) {
  Jobs jobs({.workers = 1, .queued_max = 1});
  const auto running = jobs.Submit("running", UntilCancelled());
  jobs.WaitForChange(*running, 0, 10s);
  const auto queued = jobs.Submit("queued", Ready());
  ASSERT_TRUE(queued);
  EXPECT_FALSE(jobs.Submit("too many", Ready()));
  jobs.Cancel(*queued);
  EXPECT_EQ(jobs.Get(*queued)->status, JobStatus::kCancelled);
  EXPECT_TRUE(jobs.Submit("place again", Ready()));
  jobs.Cancel(*running);
}

TEST(Jobs, ACancelledJobKeepsWhatItFound) {
  Jobs jobs({});
  const auto id = jobs.Submit("long", UntilCancelled());
  jobs.WaitForChange(*id, 0, 10s);
  EXPECT_TRUE(jobs.Cancel(*id));
  const auto job = jobs.WaitForEnd(*id, 10s);
  EXPECT_EQ(job->status, JobStatus::kCancelled);
  EXPECT_EQ(job->result["best"], 1);
  EXPECT_FALSE(jobs.Cancel("none"));
}

TEST(Jobs, ProgressWakesWhoWaits) {
  Jobs jobs({});
  std::promise<void> go;
  auto gate = go.get_future().share();
  const auto id = jobs.Submit("steps", [gate](const JobControl& control) {
    gate.wait();
    control.report({{"step", 1}});
    while (!control.cancelled()) std::this_thread::sleep_for(1ms);
    return api::Json();
  });
  const auto started = jobs.WaitForChange(*id, 0, 10s);
  EXPECT_EQ(started->status, JobStatus::kRunning);
  go.set_value();
  EXPECT_EQ(jobs.WaitForChange(*id, started->revision, 10s)->progress["step"], 1);
  jobs.Cancel(*id);
}

TEST(Jobs, OnlyTheNewestEndedAreKept) {
  Jobs jobs({.workers = 1, .ended_kept = 2});
  std::vector<std::string> ids;
  for (int i = 0; i < 4; ++i) {
    ids.push_back(*jobs.Submit("a", Ready()));
    jobs.WaitForEnd(ids.back(), 10s);
  }
  EXPECT_FALSE(jobs.Get(ids[1]));
  const auto kept = jobs.List();
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].id, ids[3]);
  EXPECT_EQ(kept[1].id, ids[2]);
}

TEST(Jobs, StopCancelsEverything) {
  Jobs jobs({.workers = 1});
  const auto running = jobs.Submit("running", UntilCancelled());
  jobs.WaitForChange(*running, 0, 10s);
  const auto queued = jobs.Submit("queued", Ready());
  jobs.Stop();
  EXPECT_EQ(jobs.Get(*running)->status, JobStatus::kCancelled);
  EXPECT_EQ(jobs.Get(*queued)->status, JobStatus::kCancelled);
  EXPECT_FALSE(jobs.Submit("late", Ready()));
}

}  // namespace
}  // namespace plenum::server
