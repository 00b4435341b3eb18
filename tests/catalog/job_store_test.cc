#include "catalog/job_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "folder.h"

namespace plenum::catalog {
namespace {

using ::testing::HasSubstr;

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
  JobStore(path_, {});
  Sql("PRAGMA user_version = 9");
  EXPECT_THAT(Refused(), HasSubstr("has schema 9, this program knows up to 1"));
  EXPECT_THAT(Refusal([&] { JobStore(folder_ / "missing" / "jobs", {}); }),
              HasSubstr("the jobs cannot be kept"));
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

}  // namespace
}  // namespace plenum::catalog
