// Clients take turns at the workers, and none fills the queue for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>

#include "server/jobs/job_recovery.h"
#include "server/jobs/jobs.h"
#include "tests/server/jobs/waiting.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace fairness_test {

using namespace std::chrono_literals;
using catalog::JobOrder;

JobOrder OrderOf(const std::string& client, const std::string& request) {
  JobOrder order;
  order.name = request;
  order.by = {"bench", "", ""};
  order.request = request;
  order.revision = 7;
  order.hash = std::string(64, 'a');
  order.client = client;
  return order;
}

class Fairness : public testing::Test {
 protected:
  // Jobs that wait for the gate to open, and then tell whose they are.
  Work InOrder() {
    return [this](const JobOrder& order, const JobControl&) -> api::Parsed<api::Json> {
      while (!open_) std::this_thread::sleep_for(1ms);
      const std::lock_guard lock(mutex_);
      begun_.push_back(order.client);
      return api::Json{{"of", order.client}};
    };
  }
  std::string Submit(Jobs& jobs, const std::string& client) {
    return jobs.Submit(OrderOf(client, "job")).id;
  }
  void WaitForAll(const Jobs& jobs) {
    open_ = true;
    for (const Job& job : jobs.List()) WaitForEnd(jobs, job.id, 20s);
  }

  const Workbench bench_;
  catalog::JobStore store_{bench_.Path("jobs"), {}};
  JobTurns turns_;
  std::mutex mutex_;
  std::vector<std::string> begun_;
  std::atomic<bool> open_ = false;
};

// Many greedy clients, each within its limit, leave places for who has few jobs.
TEST_F(Fairness, ANewClientFindsAPlaceHoweverManyFillTheirs) {
  Jobs jobs(store_, turns_, "design", InOrder(),
            {.workers = 0, .queued_max = 64, .queued_per_client_max = 8});
  int queued = 0;
  for (int client = 0; client < 20; ++client)
    for (int i = 0; i < 9; ++i)
      queued += jobs.Submit(OrderOf("greedy " + std::to_string(client), "job")).status ==
                Submitted::kAccepted;
  EXPECT_EQ(queued, 64);  // the last places went to the last clients, two each
  const auto all = jobs.List();
  for (int i = 0; i < 8; ++i) jobs.Cancel(all[i].id);
  EXPECT_EQ(jobs.Submit(OrderOf("greedy 0", "job")).status, Submitted::kRefused);
  for (int client = 0; client < 4; ++client)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(jobs.Submit(OrderOf("honest " + std::to_string(client), "job")).status,
                i < 2 ? Submitted::kAccepted : Submitted::kRefused);
}

TEST_F(Fairness, ClientsTakeTurnsHoweverManyJobsOneHas) {
  Jobs jobs(store_, turns_, "design", InOrder(), {.workers = 1});
  for (int i = 0; i < 20; ++i) Submit(jobs, "greedy");
  for (int round = 0; round < 2; ++round)
    for (int client = 0; client < 9; ++client) Submit(jobs, "honest " + std::to_string(client));
  WaitForAll(jobs);
  // The first of the greedy one had begun; then each has one turn in every ten.
  ASSERT_EQ(begun_.size(), 38u);
  for (int round = 0; round < 2; ++round) {
    std::map<std::string, int> turns;
    for (int i = 0; i < 10; ++i) ++turns[begun_[1 + 10 * round + i]];
    EXPECT_EQ(turns.size(), 10u) << round;
  }
}

// One client keeps its queue full; nine ask for a job at a time, each as soon as the last one has
// ended. All ten want all of the workers, so that a tenth of the jobs is the share of each.
TEST_F(Fairness, OneGreedyClientTakesNoneOfTheSharesOfNine) {
  constexpr int kEach = 30;
  // Long enough that the nine have asked for the next one before their turn comes again.
  const Work work = [&](const JobOrder& order,
                        const JobControl& control) -> api::Parsed<api::Json> {
    std::this_thread::sleep_for(10ms);
    return InOrder()(order, control);
  };
  Jobs jobs(store_, turns_, "design", work,
            {.workers = 2, .queued_max = 512, .queued_per_client_max = 32});
  open_ = true;
  std::atomic<bool> over = false;
  std::atomic<int> refused = 0;
  std::thread greedy([&] {
    while (!over) {
      const auto submitted = jobs.Submit(OrderOf("greedy", "job"));
      if (submitted.status == Submitted::kAccepted) continue;
      EXPECT_EQ(submitted.status, Submitted::kClientRefused);
      ++refused;
      std::this_thread::sleep_for(1ms);
    }
  });
  while (refused == 0) std::this_thread::sleep_for(1ms);
  const std::size_t before = [&] {
    const std::lock_guard lock(mutex_);
    return begun_.size();
  }();
  std::vector<std::thread> honest;
  honest.reserve(9);
  for (int client = 0; client < 9; ++client)
    honest.emplace_back([&, client] {
      std::vector<std::string> ids;
      for (int i = 0; i < kEach; ++i) {  // two at a time, so that one waits while one is done
        const auto submitted = jobs.Submit(OrderOf("honest " + std::to_string(client), "job"));
        EXPECT_EQ(submitted.status, Submitted::kAccepted);
        ids.push_back(submitted.id);
        if (ids.size() >= 2) WaitForEnd(jobs, ids[ids.size() - 2], 20s);
      }
      WaitForEnd(jobs, ids.back(), 20s);
    });
  for (std::thread& one : honest) one.join();
  over = true;
  greedy.join();
  std::map<std::string, int> turns;
  int all = 0;
  for (std::size_t i = before; i < begun_.size(); ++i) {
    if (turns["greedy"] + all >= 10 * kEach) break;
    ++turns[begun_[i]];
    all += begun_[i] != "greedy";
  }
  const double share = double(all + turns["greedy"]) / 10.0;
  for (int client = 0; client < 9; ++client)
    EXPECT_GE(turns["honest " + std::to_string(client)], 0.8 * share) << client;
  EXPECT_GT(refused, 0);
}

TEST_F(Fairness, JobsOfALowerPriorityGoAfterTheOthers) {
  Jobs jobs(store_, turns_, "design", InOrder(), {.workers = 1});
  WaitForChange(jobs, Submit(jobs, "first"), 0, 10s);
  JobOrder low = OrderOf("low", "job");
  low.priority = -1;
  jobs.Submit(low);
  for (const char* client : {"a", "a", "b"}) Submit(jobs, client);
  WaitForAll(jobs);
  ASSERT_EQ(begun_.size(), 5u);
  EXPECT_EQ(begun_.back(), "low");
}

TEST_F(Fairness, ALongJobLeavesTheOtherWorkerToOthers) {
  Jobs jobs(store_, turns_, "design", InOrder(), {.workers = 2});
  const std::string first = Submit(jobs, "a");
  WaitForChange(jobs, first, 0, 10s);
  const std::string other = Submit(jobs, "b");
  WaitForChange(jobs, other, 0, 10s);
  for (int i = 0; i < 3; ++i) Submit(jobs, "a");
  Submit(jobs, "b");
  EXPECT_EQ(jobs.Get(first)->status, JobStatus::kRunning);
  EXPECT_EQ(jobs.Get(other)->status, JobStatus::kRunning);
  WaitForAll(jobs);
  EXPECT_EQ(begun_.size(), 6u);
}

TEST_F(Fairness, TheQueueOfOneClientIsFullForThatClientOnly) {
  Jobs jobs(store_, turns_, "design", InOrder(),
            {.workers = 1, .queued_max = 5, .queued_per_client_max = 2});
  WaitForChange(jobs, Submit(jobs, "a"), 0, 10s);
  Submit(jobs, "a");
  Submit(jobs, "a");
  EXPECT_EQ(jobs.Submit(OrderOf("a", "job")).status, Submitted::kClientRefused);
  EXPECT_EQ(jobs.Submit(OrderOf("b", "job")).status, Submitted::kAccepted);
  EXPECT_EQ(jobs.Submit(OrderOf("c", "job")).status, Submitted::kAccepted);
  EXPECT_EQ(jobs.Submit(OrderOf("d", "job")).status, Submitted::kAccepted);
  EXPECT_EQ(jobs.Submit(OrderOf("e", "job")).status, Submitted::kRefused);
  WaitForAll(jobs);
}

TEST_F(Fairness, TurnsGoOnWhenTheServiceIsStartedAgain) {
  {
    Jobs jobs(store_, turns_, "design", InOrder(), {.workers = 0});
    for (int i = 0; i < 3; ++i) Submit(jobs, "a");
    Submit(jobs, "b");
  }
  Jobs jobs(store_, turns_, "design", InOrder(), {.workers = 1});
  WaitForAll(jobs);
  ASSERT_EQ(begun_.size(), 4u);
  EXPECT_EQ(begun_[1], "b");
}

TEST_F(Fairness, AJobWithoutMemoryEndsWithAWordOfItsOwn) {
  const Work hungry = [](const JobOrder&, const JobControl&) -> api::Parsed<api::Json> {
    throw std::bad_alloc();
  };
  Jobs jobs(store_, turns_, "design", hungry, {.workers = 1});
  const auto job = WaitForEnd(jobs, Submit(jobs, "a"), 10s);
  EXPECT_EQ(job->status, JobStatus::kFailed);
  EXPECT_NE(job->failure.find("memory"), std::string::npos) << job->failure;
}

TEST(Jobs, AreReadableByTheirOwnerOnly) {
  const Workbench bench;
  const catalog::JobStore store(bench.Path("jobs"), {});
  using std::filesystem::perms;
  for (const char* name : {"jobs", "jobs-wal"})
    EXPECT_EQ(std::filesystem::status(bench.Path(name)).permissions(),
              perms::owner_read | perms::owner_write)
        << name;
}

}  // namespace fairness_test
}  // namespace plenum::server
