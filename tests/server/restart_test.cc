// Jobs of the real service over the end of its process: stopped and killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace restart_test {

using api::Json;
using testing::HasSubstr;

constexpr char kJson[] = "application/json";
constexpr char kPath[] = "/v1/designs";

// What must not depend on when and how often a job was done: all but the seconds.
Json WithoutSeconds(Json answer) {
  answer.erase("seconds");
  return answer;
}

void Rest() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

class Restart : public testing::TestWithParam<int> {
 protected:
  void Start() {
    serve_.emplace(bench_.catalog());
    client_.emplace("127.0.0.1", serve_->port());
    client_->set_read_timeout(120);
  }
  void EndBySignal() {
    client_.reset();
    EXPECT_EQ(serve_->End(GetParam()), GetParam() == SIGKILL ? -SIGKILL : 0);
    serve_.reset();
  }

  static Json Body(const httplib::Result& result) {
    auto parsed = api::ParseJson(result ? result->body : "");
    return std::holds_alternative<Json>(parsed) ? std::get<Json>(parsed) : Json();
  }
  // The path of a new job.
  std::string Post(const Json& request, const std::string& key) {
    const auto accepted =
        client_->Post(kPath, {{"Idempotency-Key", key}, {"From", "me"}}, request.dump(), kJson);
    EXPECT_EQ(accepted->status, 202) << accepted->body;
    return accepted->get_header_value("Location");
  }
  Json WhenEnded(const std::string& job) {
    for (;;) {
      Json body = Body(client_->Get(job));
      if (body["status"] != "queued" && body["status"] != "running") return body;
      Rest();
    }
  }
  // What is on disk while no service runs.
  std::optional<catalog::JobRecord> OnDisk(const std::string& job) const {
    const catalog::JobStore store(bench_.catalog() + "-jobs", {});
    return store.Find("design", job.substr(job.rfind('/') + 1));
  }
  // Makes another battery the best, and another model the newest of its name.
  void ChangeTheCatalogue(const Json& answer) const {
    catalog::Store store(bench_.catalog(), catalog::Access::kWrite);
    for (const Json& part : answer["designs"][0]["parts"]) {
      if (part["family"] != "battery") continue;
      auto lighter = store.Get(part["id"].get<std::string>()).value();
      lighter.id = "bench-lighter";
      lighter.numbers.at("mass_kg").value *= 0.5;
      ASSERT_EQ(store.Add(lighter).status, catalog::WriteStatus::kDone);
    }
    store.SaveModel("bench", Model(0.3), "me");
  }
  static std::string Model(double fraction) {
    return Json({{"schema", "model/1"},
                 {"effects",
                  {{{"id", "creep"},
                    {"parameters", {{"fraction", fraction}, {"time_constant_s", 2.0}}}}}}})
        .dump();
  }

  const Workbench bench_;
  std::optional<ServeProcess> serve_;
  std::optional<httplib::Client> client_;
};

// Two jobs run and two wait when the service ends; the catalogue changes; the next service gives
// the answers that an uninterrupted one gave before.
TEST_P(Restart, UnfinishedJobsEndWithTheSameAnswer) {
  catalog::Store(bench_.catalog(), catalog::Access::kWrite).SaveModel("bench", Model(0.1), "me");
  Json drawn = Exosuit(600.0), revised = Exosuit(0.3);
  drawn["ranking"]["count"] = 20;
  drawn["ranking"]["list"] = "combinations";
  drawn["robust"] = {{"draws", 10}, {"time_limit_s", 600.0}};  // long enough to be killed in
  revised["model"] = "bench";
  Start();
  const Json expected = WhenEnded(Post(drawn, "c"))["result"],
             expected_revised = WhenEnded(Post(revised, "r"))["result"];
  ASSERT_EQ(expected["status"], "optimal");
  ASSERT_EQ(expected_revised["model"]["version"], 1);

  const std::vector<std::string> jobs{Post(drawn, "c0"), Post(drawn, "c1"), Post(drawn, "c2"),
                                      Post(revised, "r0")};
  while (Body(client_->Get(jobs[1]))["status"] == "queued") Rest();
  EndBySignal();
  const bool killed = GetParam() == SIGKILL;
  for (int i = 0; i < 4; ++i) {
    const auto record = OnDisk(jobs[i]);
    ASSERT_TRUE(record);
    const bool ran = killed && i < 2;
    EXPECT_EQ(record->status, ran ? catalog::JobStatus::kRunning : catalog::JobStatus::kQueued);
    EXPECT_EQ(record->starts, ran);
    EXPECT_EQ(record->order.by.who, "me");
  }

  ChangeTheCatalogue(expected);
  Start();
  EXPECT_EQ(Post(drawn, "c1"), jobs[1]);  // asked again, not begun again
  for (int i = 0; i < 4; ++i) {
    const Json ended = WhenEnded(jobs[i]);
    EXPECT_EQ(ended["status"], "done");
    const Json& before = i < 3 ? expected : expected_revised;
    EXPECT_EQ(ended["catalogue_revision"], before["catalogue_revision"]);
    // The revised ranking takes its time limit, so only what it was made of is the same.
    if (i < 3)
      EXPECT_TRUE(WithoutSeconds(ended["result"]) == WithoutSeconds(before));
    else
      EXPECT_EQ(ended["result"]["model"], before["model"]);
  }
  // The revision that the answers name can still be read, and is what they were made of.
  const auto number = std::to_string(expected["catalogue_revision"]["number"].get<int>());
  EXPECT_EQ(client_->Get("/v1/parts/bench-lighter?revision=" + number)->status, 404);
  EXPECT_EQ(client_->Get("/v1/parts/bench-lighter")->status, 200);
  const Json now = WhenEnded(Post(drawn, "now"))["result"];
  EXPECT_FALSE(WithoutSeconds(now) == WithoutSeconds(expected));
}

TEST_P(Restart, EndedJobsStayReadable) {
  Start();
  const std::string done = Post(Exosuit(60.0), "a"), stopped = Post(SlowToProve(120.0), "b");
  const Json before = WhenEnded(done);
  while (Body(client_->Get(stopped))["progress"].is_null()) Rest();
  client_->Delete(stopped);
  const Json cancelled = WhenEnded(stopped);
  EXPECT_EQ(cancelled["status"], "cancelled");
  const std::string list = client_->Get(kPath)->body;
  EndBySignal();
  Start();
  EXPECT_TRUE(Body(client_->Get(done)) == before);
  EXPECT_TRUE(Body(client_->Get(stopped)) == cancelled);
  EXPECT_EQ(client_->Get(kPath)->body, list);
  EXPECT_THAT(client_->Get(done + "/events")->body, HasSubstr("event: end\n"));
  const auto again = client_->Post(kPath, {{"Idempotency-Key", "a"}, {"Prefer", "wait=10"}},
                                   Exosuit(60.0).dump(), kJson);
  EXPECT_EQ(again->status, 200);
  EXPECT_TRUE(Body(again) == before["result"]);
}

// A catalogue that was replaced by another has other parts under the same number.
TEST_P(Restart, AJobWhosePartsAreGoneSaysSo) {
  Start();
  const std::string copy = bench_.Path("copy.db");
  ASSERT_EQ(bench_.Run("catalog backup '" + copy + "' --catalog '" + bench_.catalog() + "'").status,
            0);
  ASSERT_EQ(client_->Post("/v1/parts", NewFitting("mine").dump(), kJson)->status, 201);
  const std::string job = Post(SlowToProve(120.0), "a");
  while (Body(client_->Get(job))["progress"].is_null()) Rest();
  EndBySignal();
  ASSERT_EQ(
      bench_.Run("catalog restore '" + copy + "' --catalog '" + bench_.catalog() + "'").status, 0);
  ASSERT_EQ(catalog::Store(bench_.catalog(), catalog::Access::kWrite)
                .Add(std::get<catalog::Part>(api::ParsePart(NewFitting("other"))))
                .status,
            catalog::WriteStatus::kDone);
  Start();
  const Json ended = WhenEnded(job);
  EXPECT_EQ(ended["status"], "failed");
  EXPECT_THAT(ended["detail"].get<std::string>(), HasSubstr("any more; post the request again"));
}

INSTANTIATE_TEST_SUITE_P(, Restart, testing::Values(SIGTERM, SIGKILL), [](const auto& signal) {
  return signal.param == SIGTERM ? "Stopped" : "Killed";
});

class Deaths : public Restart {};

// How a service ends by a signal; AddressSanitizer takes a SIGSEGV for its own and exits with 1.
int EndBy(int signal) {
#ifdef PLENUM_SANITIZED
  if (signal == SIGSEGV) return 1;
#endif
  return -signal;
}

// A signal from outside comes to a thread of no job: no job is to blame, none fails.
TEST_P(Deaths, TheServiceStartsEachTimeAndTheJobsEnd) {
  Start();
  const std::vector<std::string> jobs = {Post(SlowToProve(3.0), "a"), Post(SlowToProve(3.0), "b"),
                                         Post(Exosuit(60.0), "c")};
  const int deaths = GetParam() == SIGSEGV ? 5 : 20;
  for (int death = 0; death < deaths; ++death) {
    const auto running = [&](const std::string& job) {
      return Body(client_->Get(job))["status"] == "running";
    };
    while (!running(jobs[0]) && !running(jobs[1])) Rest();
    client_.reset();
    EXPECT_EQ(serve_->End(GetParam()), EndBy(GetParam()));
    serve_.reset();
    Start();
  }
  for (const std::string& job : jobs) {
    const Json ended = WhenEnded(job);
    EXPECT_EQ(ended["status"], "done");
    EXPECT_EQ(ended["crashes"], 0);
  }
  EXPECT_GT(Body(client_->Get(jobs[0]))["attempts"], 1);
}

INSTANTIATE_TEST_SUITE_P(, Deaths, testing::Values(SIGSEGV, SIGKILL), [](const auto& signal) {
  return signal.param == SIGSEGV ? "Crashed" : "Killed";
});

TEST(Serve, RefusesASecondServiceOfTheSameCatalogue) {
  const Workbench bench;
  ServeProcess serve(bench.catalog());
  const auto second = bench.Run("serve --port 0");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("catalog.db is held by another service"));
}

}  // namespace restart_test
}  // namespace plenum::server
