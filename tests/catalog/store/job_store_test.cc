#include "catalog/store/jobs/job_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/catalog/folder.h"

namespace plenum::catalog {
namespace job_store_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JobFile : public InFolder {
 protected:
  JobOrder Order(const std::string& request) const {
    JobOrder order;
    order.kind = "design";
    order.name = "a \"name\"";
    order.by = {"me", "", ""};
    order.request = request;
    order.hash = std::string(64, '0');
    return order;
  }
  std::string Refused() const {
    return Refusal([&] { JobStore(path_, {}); });
  }
};

TEST_F(JobFile, GivesBackWhatWasWritten) {
  JobOrder order = Order("{\"a\": \"\\u0000 ü\"}" + std::string(5'000'000, ' '));
  order.by = {"me", "k", "digest"};
  order.revision = 12;
  order.model = "bench";
  order.model_version = 3;
  order.model_hash = std::string(64, 'f');
  JobRecord ended;
  std::string ended_at;
  {
    JobStore store(path_, {});
    const JobRecord added = store.Add("one", order);
    EXPECT_EQ(added.status, JobStatus::kQueued);
    ended = added;
    ended.status = JobStatus::kFailed;
    ended.progress = "{}";
    ended.result = "[1]";
    ended.failure = "why";
    store.Start("one");
    EXPECT_EQ(store.Unfinished("design").size(), 1u);
    ended_at = store.End(ended);
    EXPECT_TRUE(store.Unfinished("design").empty());
  }
  const JobStore store(path_, {});
  const JobRecord found = store.Find("design", "one").value();
  EXPECT_EQ(found.ended_at, ended_at);
  EXPECT_EQ(found.order.name, order.name);
  EXPECT_EQ(found.order.by.who, "me");
  EXPECT_TRUE(found.order.request == order.request);
  EXPECT_EQ(found.order.revision, 12);
  EXPECT_EQ(found.order.hash, order.hash);
  EXPECT_EQ(found.order.model, "bench");
  EXPECT_EQ(found.order.model_version, 3);
  EXPECT_EQ(found.order.model_hash, order.model_hash);
  EXPECT_EQ(found.status, JobStatus::kFailed);
  EXPECT_EQ(found.starts, 1);
  EXPECT_EQ(found.progress, "{}");
  EXPECT_EQ(found.result, "[1]");
  EXPECT_EQ(found.failure, "why");
  EXPECT_GE(found.ended_at, found.submitted_at);
  EXPECT_EQ(store.FindKey("design", "k")->id, "one");
  EXPECT_FALSE(store.FindKey("diagnosis", "k"));
  EXPECT_FALSE(store.Find("diagnosis", "one"));
  EXPECT_TRUE(store.Ended("design").front().order.request.empty());
}

TEST_F(JobFile, HasOneHolder) {
  {
    const JobStore store(path_, {});
    EXPECT_THAT(Refused(), HasSubstr("is held by another service"));
  }
  EXPECT_EQ(Refused(), "");
}

TEST_F(JobFile, RefusesWhatIsNoneOfIts) {
  Write();  // a catalogue
  const std::string before = Bytes(path_);
  EXPECT_THAT(Refused(), HasSubstr("is not a file of jobs"));
  EXPECT_EQ(Bytes(path_), before);
  std::filesystem::remove(path_);
  std::ofstream(path_) << "not a database, but long enough to be taken for something";
  EXPECT_THAT(Refused(), HasSubstr("not a database"));
  std::filesystem::remove(path_);
  { const JobStore made(path_, {}); }
  Sql("PRAGMA user_version = 9");
  EXPECT_THAT(Refused(), HasSubstr("has schema 9, this program knows up to 6"));
  EXPECT_THAT(Refusal([&] { JobStore(folder_ / "missing" / "jobs", {}); }),
              HasSubstr("the jobs cannot be kept"));
}

// What the program before schema 2 made, with a job that ran five times and one that ended.
constexpr char kSchema1[] = R"sql(
CREATE TABLE job (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9007199254740991),
  id TEXT NOT NULL UNIQUE CHECK (length(id) BETWEEN 1 AND 100),
  kind TEXT NOT NULL CHECK (length(kind) BETWEEN 1 AND 100),
  name TEXT NOT NULL CHECK (length(name) <= 1000000),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  key TEXT CHECK (length(key) BETWEEN 1 AND 255),
  digest TEXT CHECK (length(digest) BETWEEN 1 AND 100),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 9007199254740991),
  hash TEXT NOT NULL CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  model TEXT NOT NULL CHECK (length(model) <= 100),
  model_version INTEGER NOT NULL CHECK (model_version BETWEEN 0 AND 9007199254740991),
  model_hash TEXT NOT NULL CHECK (length(model_hash) IN (0, 64)),
  status TEXT NOT NULL
    CHECK (status IN ('queued', 'running', 'done', 'cancelled', 'failed')),
  starts INTEGER NOT NULL DEFAULT 0 CHECK (starts BETWEEN 0 AND 1000000),
  cancel_asked INTEGER NOT NULL DEFAULT 0 CHECK (cancel_asked IN (0, 1)),
  submitted_at TEXT NOT NULL CHECK (length(submitted_at) = 20),
  ended_at TEXT CHECK (length(ended_at) = 20),
  ended INTEGER UNIQUE CHECK (ended BETWEEN 1 AND 9007199254740991),
  bytes INTEGER NOT NULL CHECK (bytes BETWEEN 0 AND 2147483647),
  progress TEXT NOT NULL DEFAULT '',
  failure TEXT NOT NULL DEFAULT '',
  request TEXT NOT NULL,
  result TEXT NOT NULL DEFAULT '',
  UNIQUE (kind, key),
  CHECK ((ended IS NULL) = (status IN ('queued', 'running')) AND (ended IS NULL) = (ended_at IS NULL))
) STRICT;
INSERT INTO job (number, id, kind, name, who, revision, hash, model, model_version, model_hash,
  status, starts, submitted_at, ended_at, ended, bytes, request, result) VALUES
  (1, 'ran', 'design', 'a', 'me', 3, printf('%064d', 0), '', 0, '', 'running', 5,
   '2026-01-31T12:00:00Z', NULL, NULL, 2, '{}', ''),
  (2, 'done', 'diagnosis', 'b', 'me', 3, printf('%064d', 0), '', 0, '', 'done', 1,
   '2026-01-31T12:00:01Z', '2026-01-31T12:00:02Z', 1, 5, '{}', '[1]');
PRAGMA application_id = 1886154346;
PRAGMA user_version = 1;
)sql";

TEST_F(JobFile, OfTheFormerSchemaOpens) {
  Sql(kSchema1);
  {
    JobStore store(path_, {});
    store.RequeueInterrupted({});
  }
  const JobStore store(path_, {});  // as its own schema now
  const JobRecord ran = store.Find("design", "ran").value();
  EXPECT_EQ(ran.status, JobStatus::kQueued);
  EXPECT_EQ(ran.order.request, "{}");
  EXPECT_EQ(ran.starts, 5);
  EXPECT_EQ(ran.crashes, 0);
  EXPECT_EQ(ran.crashes_max, 2);
  EXPECT_TRUE(ran.alone);
  EXPECT_EQ(store.Find("diagnosis", "done")->result, "[1]");
  EXPECT_FALSE(store.Find("diagnosis", "done")->alone);
}

TEST_F(JobFile, TextsGoWithTheirJobs) {
  {
    JobStore store(path_, {2, 1 << 20});
    for (const char* id : {"a", "b", "c"}) {
      store.Add(id, Order("{\"a\": 1}"));
      JobRecord job = store.Find("design", id).value();
      job.status = JobStatus::kFailed;
      job.result = "[1]";
      store.End(job);
    }
    EXPECT_FALSE(store.Find("design", "a"));
    EXPECT_EQ(store.Result("design", "a"), "");
    EXPECT_EQ(store.Result("design", "c"), "[1]");
    store.Again("c");
    EXPECT_EQ(store.Result("design", "c"), "");
    EXPECT_EQ(store.Find("design", "c")->order.request, "{\"a\": 1}");
  }
  // A text without a job would be refused here.
  Sql("INSERT INTO job_text SELECT number, NULL, '' FROM job_text WHERE number NOT IN (SELECT "
      "number FROM job)");
  EXPECT_THAT(CheckJobs(path_), IsEmpty());
}

TEST_F(JobFile, CountsCrashesOfJobsThatRan) {
  JobStore store(path_, {});
  for (const char* id : {"crashed", "ran", "waits"}) store.Add(id, Order("{}"));
  store.Start("crashed");
  store.Start("ran");
  const std::int64_t crashed = store.Find("design", "crashed")->number;
  store.RequeueInterrupted({{crashed, "a signal"}, {crashed + 2, "of a job that waits"}});
  store.RequeueInterrupted({{crashed, "the same mark, read twice"}});
  const auto jobs = store.List();  // newest first
  ASSERT_EQ(jobs.size(), 3u);
  EXPECT_EQ(jobs[2].crashes, 1);
  EXPECT_EQ(jobs[2].crash, "a signal");
  EXPECT_EQ(jobs[1].crashes, 0);
  EXPECT_TRUE(jobs[1].alone);
  EXPECT_EQ(jobs[0].crashes, 0);
  EXPECT_FALSE(jobs[0].alone);
  for (const JobRecord& job : jobs) EXPECT_EQ(job.status, JobStatus::kQueued);
}

TEST_F(JobFile, QueuesAJobAgainWithoutItsOutcome) {
  JobStore store(path_, {});
  JobRecord job = store.Add("one", Order("{\"ü\":1}"));
  store.Start("one");
  store.AskToCancel("one");
  job.status = JobStatus::kCancelled;
  job.result = "[1]";
  job.progress = "{}";
  store.End(job);
  store.Again("one");
  const JobRecord again = store.Find("design", "one").value();
  EXPECT_EQ(again.status, JobStatus::kQueued);
  EXPECT_EQ(again.result + again.progress + again.failure + again.ended_at, "");
  EXPECT_FALSE(again.cancel_asked);
  EXPECT_FALSE(again.alone);
  EXPECT_EQ(again.starts, 1);
  EXPECT_EQ(again.order.request, "{\"ü\":1}");
  EXPECT_EQ(store.Unfinished("design").size(), 1u);
}

TEST_F(JobFile, RefusesARecordThatMakesNoSense) {
  JobStore store(path_, {});
  JobOrder order = Order("{}");
  order.hash = "short";
  EXPECT_THAT(Refusal([&] { store.Add("one", order); }), HasSubstr("CHECK"));
  order = Order("{}");
  store.Add("one", order);
  EXPECT_THAT(Refusal([&] { store.Add("one", order); }), HasSubstr("UNIQUE"));
}

// A sweep is there with all its jobs, or not at all; old jobs go with it, and it with them.
TEST_F(JobFile, ASweepAndItsJobsAreOne) {
  JobStore store(path_, {2, 1 << 20});
  SweepRecord sweep;
  sweep.id = "s";
  sweep.kind = "design";
  sweep.name = "how often";
  sweep.by = {"me", "k", "digest"};
  sweep.client = "ann";
  sweep.hash = std::string(64, '0');
  sweep.plan = "{}";
  std::vector<NewJob> jobs;
  for (const char* id : {"a", "b", "c", "a"}) {
    jobs.push_back({id, Order("{}")});
    jobs.back().order.sweep = "s";
    jobs.back().order.place = static_cast<int>(jobs.size());
  }
  EXPECT_THROW(store.AddSweep(sweep, jobs), StoreError);  // two jobs have one id
  EXPECT_FALSE(store.FindSweep("design", "s"));
  EXPECT_TRUE(store.Unfinished("design").empty());
  jobs.pop_back();
  EXPECT_EQ(store.AddSweep(sweep, jobs)->jobs[JobStatus::kQueued], 3);
  SweepRecord second = sweep;
  second.id = "t";
  EXPECT_FALSE(store.AddSweep(second, {}));  // the key has a sweep
  const auto end = [&](const std::string& id) {
    JobRecord job = store.Find("design", id).value();
    job.status = JobStatus::kDone;
    store.End(job);
  };
  for (const char* id : {"a", "b", "c"}) {
    EXPECT_EQ(store.FindSweep("design", "s")->ended_at, "");
    end(id);
  }
  // Three are more than the two that are kept, but none goes before the sweep is old.
  EXPECT_EQ(store.OfSweep("s").size(), 3u);
  EXPECT_EQ(store.OfSweep("s")[1].id, "b");
  EXPECT_EQ(store.FindSweepKey("design", "k")->jobs[JobStatus::kDone], 3);
  EXPECT_EQ(store.FindSweep("design", "s")->ended_at.size(), 20u);
  for (const char* id : {"d", "e"}) {
    EXPECT_EQ(store.Sweeps("design", 10).size(), 1u);
    store.Add(id, Order("{}"));
    end(id);
  }
  EXPECT_TRUE(store.Sweeps("design", 10).empty());
  EXPECT_EQ(store.Ended("design").size(), 2u);
}

}  // namespace job_store_test
}  // namespace plenum::catalog
