// Jobs on a server, as services and workers see them.
#include "catalog/store/jobs/shared_job_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace shared_job_store_test {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr milliseconds kLong{60'000}, kShort{1};

class SharedJobs : public InStore {
 protected:
  std::unique_ptr<SharedJobStore> Jobs(const std::string& version = "1") const {
    return std::make_unique<SharedJobStore>(path_.string(), version);
  }
  static JobOrder Order(const std::string& client = "ann", int priority = 0) {
    JobOrder order;
    order.kind = "design";
    order.name = "name";
    order.by = {"me", "", ""};
    order.request = "{}";
    order.hash = std::string(64, '0');
    order.client = client;
    order.priority = priority;
    return order;
  }
  static JobRecord Done(const JobClaim& claim, const std::string& result) {
    JobRecord outcome = claim.job;
    outcome.status = JobStatus::kDone;
    outcome.result = result;
    return outcome;
  }
  static std::string NextOf(SharedJobStore& jobs) {
    const auto claim = jobs.Claim({"design", "diagnosis"}, "w", kLong);
    return claim ? claim->job.id : "";
  }
};

TEST_P(SharedJobs, GiveBackWhatWasWritten) {
  const auto jobs = Jobs();
  JobOrder order = Order();
  order.request = "{\"a\": \"\\u0000 \xc3\xbc\"}" + std::string(5'000'000, ' ');
  order.name = std::string("a \"name\"\0.", 10);
  order.by = {"me", "k", "digest"};
  order.revision = 12;
  order.model = "bench";
  order.model_version = 3;
  order.model_hash = std::string(64, 'f');
  const JobRecord added = jobs->Add("one", order).value();
  EXPECT_EQ(added.status, JobStatus::kQueued);
  EXPECT_EQ(added.order.name, "a \"name\" .");
  const JobClaim claim = jobs->Claim({"design"}, "host", kLong).value();
  EXPECT_EQ(claim.job.order.request, order.request);
  EXPECT_EQ(claim.job.order.model, "bench");
  EXPECT_EQ(claim.job.order.model_version, 3);
  EXPECT_EQ(claim.job.order.revision, 12);
  EXPECT_EQ(claim.job.starts, 1);
  const std::string result = "[1]" + std::string(5'000'000, ' ');
  ASSERT_TRUE(jobs->End(claim, Done(claim, result)));
  const auto other = Jobs();
  EXPECT_EQ(other->Result("design", "one"), result);
  const JobRecord found = other->FindKey("design", "k").value();
  EXPECT_EQ(found.status, JobStatus::kDone);
  EXPECT_EQ(found.order.by.request, "digest");
  EXPECT_EQ(found.ended_at.size(), 20u);
  EXPECT_FALSE(other->Peek("diagnosis", "one"));
  EXPECT_THAT(other->List("", 10), SizeIs(1));
}

TEST_P(SharedJobs, AKeyHasOneJob) {
  const auto jobs = Jobs();
  JobOrder order = Order();
  order.by.key = "k";
  EXPECT_TRUE(jobs->Add("one", order));
  EXPECT_FALSE(jobs->Add("two", order));
  EXPECT_TRUE(jobs->Add("one", order));  // said again
  EXPECT_EQ(jobs->Count("design", JobStatus::kQueued), 1u);
}

TEST_P(SharedJobs, ASweepAndItsJobsAreOne) {
  const auto jobs = Jobs();
  SweepRecord sweep;
  sweep.id = "s";
  sweep.kind = "design";
  sweep.name = std::string("a\0b", 3);
  sweep.by = {"me", "k", "digest"};
  sweep.client = "ann";
  sweep.hash = std::string(64, '0');
  sweep.plan = "{}";
  std::vector<NewJob> swept;
  for (const char* id : {"a", "b", "c", "a"}) {
    swept.push_back({id, Order()});
    swept.back().order.sweep = "s";
    swept.back().order.place = static_cast<int>(swept.size());
  }
  EXPECT_THROW(jobs->AddSweep(sweep, swept), StoreError);  // two jobs have one id
  EXPECT_FALSE(jobs->FindSweep("design", "s"));
  EXPECT_EQ(jobs->Count("design", JobStatus::kQueued), 0u);
  swept.pop_back();
  EXPECT_EQ(jobs->AddSweep(sweep, swept)->name, "a b");
  SweepRecord second = sweep;
  second.id = "t";
  EXPECT_FALSE(jobs->AddSweep(second, {}));  // the key has a sweep
  EXPECT_EQ(jobs->Waiting("design", "ann"), 0u);
  EXPECT_EQ(jobs->Waiting("design", "ann", true), 3u);
  EXPECT_EQ(jobs->Waiting("design", std::nullopt, true), 3u);
  for (int i = 0; i < 3; ++i) {
    const JobClaim claim = jobs->Claim({"design"}, "w", kLong).value();
    EXPECT_EQ(claim.job.order.sweep, "s");
    EXPECT_EQ(claim.job.order.place, i + 1);
    EXPECT_EQ(jobs->FindSweep("design", "s")->jobs[JobStatus::kRunning], 1);
    EXPECT_EQ(jobs->FindSweep("design", "s")->ended_at, "");
    jobs->End(claim, Done(claim, "1"));
  }
  EXPECT_EQ(jobs->FindSweepKey("design", "k")->ended_at.size(), 20u);
  jobs->DropOld("design", {2, 1 << 20});
  EXPECT_THAT(jobs->OfSweep("s"), SizeIs(3));  // none goes before the sweep is old
  for (const char* id : {"d", "e"}) {
    EXPECT_THAT(jobs->Sweeps("design", 10), SizeIs(1));
    jobs->Add(id, Order());
    const JobClaim claim = jobs->Claim({"design"}, "w", kLong).value();
    jobs->End(claim, Done(claim, "1"));
    jobs->DropOld("design", {2, 1 << 20});
  }
  EXPECT_THAT(jobs->Sweeps("design", 10), IsEmpty());
  EXPECT_THAT(jobs->List("design", 10), SizeIs(2));
}

TEST_P(SharedJobs, ClientsTakeTurnsAndPriorityGoesFirst) {
  const auto jobs = Jobs();
  for (const char* id : {"a1", "a2", "a3"}) jobs->Add(id, Order("ann"));
  for (const char* id : {"b1", "b2"}) jobs->Add(id, Order("bob"));
  jobs->Add("c1", Order("cyd"));
  jobs->Add("low", Order("dan", -1));
  jobs->Add("high", Order("ann", 5));
  EXPECT_EQ(jobs->Waiting("design", "ann"), 4u);
  std::vector<std::string> order;
  for (std::string id = NextOf(*jobs); !id.empty(); id = NextOf(*jobs)) order.push_back(id);
  EXPECT_THAT(order, ElementsAre("high", "b1", "c1", "a1", "b2", "a2", "a3", "low"));
}

TEST_P(SharedJobs, OfThoseWithAsManyAtWorkTheLongestWithoutATurnGoesFirst) {
  const auto jobs = Jobs();
  for (const char* id : {"a1", "a2"}) jobs->Add(id, Order("ann"));
  for (const char* id : {"b1", "b2"}) jobs->Add(id, Order("bob"));
  std::vector<std::string> order;
  for (int i = 0; i < 4; ++i) {
    const JobClaim claim = jobs->Claim({"design"}, "w", kLong).value();
    order.push_back(claim.job.id);
    jobs->End(claim, Done(claim, "1"));
  }
  EXPECT_THAT(order, ElementsAre("a1", "b1", "a2", "b2"));
}

TEST_P(SharedJobs, OfAnotherVersionOrKindAreLeftAlone) {
  Jobs("1")->Add("one", Order());
  EXPECT_FALSE(Jobs("2")->Claim({"design"}, "w", kLong));
  EXPECT_FALSE(Jobs("1")->Claim({"diagnosis"}, "w", kLong));
  EXPECT_TRUE(Jobs("1")->Claim({"design"}, "w", kLong));
}

TEST_P(SharedJobs, WhoseLeaseEndedAreTakenByAnotherAndTheFirstWritesNothing) {
  const auto jobs = Jobs();
  jobs->Add("one", Order());
  const JobClaim lost = jobs->Claim({"design"}, "first", kShort).value();
  std::this_thread::sleep_for(milliseconds(20));
  jobs->TakeFromLost();
  const JobClaim second = jobs->Claim({"design"}, "second", kLong).value();
  EXPECT_EQ(second.job.id, "one");
  EXPECT_EQ(second.job.starts, 2);
  EXPECT_EQ(second.job.crashes, 1);
  EXPECT_THAT(second.job.crash, HasSubstr("first"));
  EXPECT_FALSE(jobs->See(lost).held);
  EXPECT_FALSE(jobs->Extend(lost, "{}", kLong).held);
  EXPECT_FALSE(jobs->End(lost, Done(lost, "\"first\"")));
  jobs->GiveBack(lost);
  EXPECT_EQ(jobs->Peek("design", "one")->status, JobStatus::kRunning);
  EXPECT_TRUE(jobs->End(second, Done(second, "\"second\"")));
  EXPECT_TRUE(jobs->End(second, Done(second, "\"second\"")));  // said again
  EXPECT_EQ(jobs->Result("design", "one"), "\"second\"");
}

TEST_P(SharedJobs, AnExtendedLeaseIsKept) {
  const auto jobs = Jobs();
  jobs->Add("one", Order());
  const JobClaim claim = jobs->Claim({"design"}, "w", kShort).value();
  EXPECT_TRUE(jobs->Extend(claim, "{\"share\":1}", kLong).held);
  std::this_thread::sleep_for(milliseconds(20));
  jobs->TakeFromLost();
  EXPECT_FALSE(jobs->Claim({"design"}, "other", kLong));
  EXPECT_EQ(jobs->Peek("design", "one")->progress, "{\"share\":1}");
}

TEST_P(SharedJobs, ThatLoseTenWorkersEndAndCanBeAskedForAgain) {
  const auto jobs = Jobs();
  jobs->Add("one", Order());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(jobs->Claim({"design"}, "w", kShort)) << i;
    std::this_thread::sleep_for(milliseconds(5));
    jobs->TakeFromLost();
  }
  EXPECT_EQ(NextOf(*jobs), "");
  EXPECT_EQ(jobs->Peek("design", "one")->status, JobStatus::kFailed);
  EXPECT_THAT(jobs->Peek("design", "one")->failure, HasSubstr("10 workers were lost"));
  EXPECT_TRUE(jobs->Again("one"));
  EXPECT_FALSE(jobs->Again("one"));
  EXPECT_EQ(NextOf(*jobs), "one");
}

TEST_P(SharedJobs, CancelEndsWhatWaitsAndAsksWhatRuns) {
  const auto jobs = Jobs();
  jobs->Add("one", Order());
  jobs->Add("two", Order());
  const JobClaim claim = jobs->Claim({"design"}, "w", kShort).value();
  const std::int64_t before = jobs->LastChange();
  jobs->Cancel("one");
  jobs->Cancel("two");
  EXPECT_NE(jobs->LastChange(), before);
  EXPECT_EQ(jobs->Peek("design", "two")->status, JobStatus::kCancelled);
  EXPECT_TRUE(jobs->See(claim).cancel_asked);
  EXPECT_TRUE(jobs->Extend(claim, "", kShort).cancel_asked);
  std::this_thread::sleep_for(milliseconds(20));
  jobs->TakeFromLost();  // nobody begins it again
  EXPECT_EQ(jobs->Peek("design", "one")->status, JobStatus::kCancelled);
}

TEST_P(SharedJobs, GivenBackAreAsTheyWere) {
  const auto jobs = Jobs();
  jobs->Add("one", Order());
  jobs->GiveBack(jobs->Claim({"design"}, "w", kLong).value());
  const JobRecord job = jobs->Peek("design", "one").value();
  EXPECT_EQ(job.status, JobStatus::kQueued);
  EXPECT_EQ(job.starts, 0);
  EXPECT_EQ(NextOf(*jobs), "one");
}

TEST_P(SharedJobs, OfThoseThatEndedTheNewestAreKept) {
  const auto jobs = Jobs();
  for (int i = 0; i < 6; ++i) {
    jobs->Add(std::to_string(i), Order());
    const JobClaim claim = jobs->Claim({"design"}, "w", kLong).value();
    jobs->End(claim, Done(claim, "1"));
  }
  jobs->Add("waits", Order());
  jobs->DropOld("design", {.jobs = 2, .bytes = 100});
  std::vector<std::string> ids;
  for (const JobRecord& job : jobs->List("design", 10)) ids.push_back(job.id);
  EXPECT_THAT(ids, ElementsAre("waits", "5", "4"));
  EXPECT_EQ(Count("job_result"), 2);
}

TEST_P(SharedJobs, TheQueueCountsWhoIsSeen) {
  const auto jobs = Jobs();
  EXPECT_EQ(jobs->Queue(kLong).oldest, "");
  jobs->Add("one", Order());
  jobs->Add("two", Order());
  jobs->Claim({"design"}, "w", kLong);
  jobs->Seen({"w1", "host", "1", 3});
  jobs->Seen({"w2", "host", "1", 1});
  jobs->Seen({"w2", "host", "1", 2});
  const QueueState state = jobs->Queue(kLong);
  EXPECT_EQ(state.waiting, 1);
  EXPECT_EQ(state.running, 1);
  EXPECT_EQ(state.workers, 2);
  EXPECT_EQ(state.threads, 5);
  EXPECT_EQ(state.oldest.size(), 20u);
  jobs->Leave("w1");
  EXPECT_EQ(jobs->Queue(kLong).workers, 1);
}

// Sessions are cut all the while; some workers forget what they claimed.
TEST_P(SharedJobs, ManyWorkersDoEachJobOnceThroughCutsAndLosses) {
  constexpr int kJobs = 120, kWorkers = 6;
  const auto asks = Jobs();
  for (int i = 0; i < kJobs; ++i)
    ASSERT_TRUE(asks->Add(std::to_string(i), Order("client" + std::to_string(i % 3))));
  std::atomic<int> ended = 0;
  std::atomic<bool> over = false;
  const auto work = [&](int number) {
    const auto jobs = Jobs();
    for (int turn = number; !over; ++turn) try {
        jobs->TakeFromLost();
        const auto claim = jobs->Claim({"design"}, "w" + std::to_string(number), milliseconds(500));
        if (!claim)
          std::this_thread::sleep_for(milliseconds(5));
        else if (turn % 7 != 0)  // else it is lost
          ended += jobs->End(*claim, Done(*claim, "\"" + claim->attempt + "\""));
      } catch (const StoreError&) {  // cut twice
      }
  };
  std::vector<std::thread> workers;
  workers.reserve(kWorkers);
  for (int i = 0; i < kWorkers; ++i) workers.emplace_back(work, i);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  int done = 0;
  while (done < kJobs && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(milliseconds(100));
    test::CutSessions();
    done = 0;
    for (const JobRecord& job : asks->List("design", kJobs)) done += job.status == JobStatus::kDone;
  }
  over = true;
  for (std::thread& worker : workers) worker.join();
  EXPECT_EQ(done, kJobs);
  EXPECT_LE(ended, kJobs);  // none twice; an answer may have been lost
  EXPECT_EQ(Count("job_result"), kJobs);
}

INSTANTIATE_TEST_SUITE_P(Each, SharedJobs, ::testing::Values(Engine::kPostgresql), NameOf);

}  // namespace shared_job_store_test
}  // namespace plenum::catalog
