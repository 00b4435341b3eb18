// Services and workers of one catalogue on a server, as processes: killed, stopped, in any number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "api/json/json.h"
#include "tests/server/service.h"
#include "tests/server/workbench.h"
#include "tests/support/postgres/postgres_server.h"

namespace plenum::server {
namespace worker_test {

using api::Json;
using testing::HasSubstr;

constexpr char kJson[] = "application/json";

class OnServer : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (const std::string why = test::WhyNoPostgres(); !why.empty()) GTEST_SKIP() << why;
    address_ = test::NewDatabase();
    const auto copied = bench_.Run("catalog copy catalog.db '" + address_ + "'");
    ASSERT_EQ(copied.status, 0) << copied.err;
    one_ = Serve();
  }
  // A service that leaves all jobs to workers.
  std::unique_ptr<Service> Serve() const {
    HttpOptions options;
    options.catalog = address_;
    options.jobs.workers = 0;
    return std::make_unique<Service>(options);
  }
  static httplib::Client To(const Service& service) {
    httplib::Client client("127.0.0.1", service.port());
    client.set_read_timeout(120);
    return client;
  }
  static std::string Post(const Service& service, const Json& request) {
    const auto accepted = To(service).Post("/v1/designs", request.dump(), kJson);
    EXPECT_EQ(accepted->status, 202) << accepted->body;
    return accepted->get_header_value("Location");
  }
  static Json Get(const Service& service, const std::string& path) {
    const auto answer = To(service).Get(path);
    return answer ? JsonOf(answer->body) : Json();
  }
  // The job when its status is none of `others`.
  static Json When(const Service& service, const std::string& job, const std::string& others) {
    for (int i = 0; i < 6000; ++i) {
      Json body = Get(service, job);
      if (others.find(body["status"].get<std::string>()) == std::string::npos) return body;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
  }
  static Json WhenEnded(const Service& service, const std::string& job) {
    return When(service, job, "queued running");
  }
  std::unique_ptr<WorkerProcess> Work() const {
    return std::make_unique<WorkerProcess>(address_, 2);
  }
  // All but the seconds, which stand at the top alone.
  static Json WithoutSeconds(Json answer) {
    answer.erase("seconds");
    return answer;
  }
  Json AnswerOfAFile(const Json& request) const {
    bench_.Write("request.json", request.dump());
    return WithoutSeconds(JsonOf(bench_.Run("design request.json --json").out));
  }

  const Workbench bench_;
  std::string address_;
  std::unique_ptr<Service> one_;
};

TEST_P(OnServer, AKilledWorkersJobIsDoneByAnotherWithTheAnswerOfAFile) {
  const Json request = Exosuit(100);
  auto first = Work();
  const std::string job = Post(*one_, request);
  EXPECT_EQ(When(*one_, job, "queued")["status"], "running");
  EXPECT_EQ(first->End(SIGKILL), -SIGKILL);
  const auto second = Work();
  const Json ended = WhenEnded(*one_, job);
  EXPECT_EQ(ended["status"], "done");
  EXPECT_EQ(ended["attempts"], 2);
  EXPECT_EQ(ended["crashes"], 1);
  EXPECT_THAT(ended["last_crash"].get<std::string>(), HasSubstr("the loss of worker"));
  Json answer = WithoutSeconds(ended["result"]);
  EXPECT_EQ(answer["catalogue_revision"]["hash"],
            Get(*one_, "/v1/revisions")["revisions"][0]["hash"]);
  answer.erase("catalogue_revision");  // only a service says which
  Json expected = AnswerOfAFile(request);
  expected.erase("catalogue_revision");
  EXPECT_EQ(answer, expected);
}

// The table is that of the command on a file, whoever was killed meanwhile.
TEST_P(OnServer, ASweepOutlastsAKilledWorkerAndTheTableIsThatOfAFile) {
  Json patches = Json::array();
  for (const double hz : {0.05, 0.08, 0.12})
    patches.push_back(
        {{"name", std::to_string(hz)}, {"merge", {{"duty", {{"frequency_hz", hz}}}}}});
  const Json sweep = {{"schema", "sweep/1"}, {"requirements", Exosuit(100)}, {"patches", patches}};
  const auto accepted = To(*one_).Post("/v1/sweeps", sweep.dump(), kJson);
  ASSERT_EQ(accepted->status, 202) << accepted->body;
  const std::string path = accepted->get_header_value("Location");
  auto first = Work();
  EXPECT_EQ(When(*one_, path, "queued")["status"], "running");
  EXPECT_EQ(first->End(SIGKILL), -SIGKILL);
  const auto second = Work(), third = Work();
  EXPECT_EQ(WhenEnded(*one_, path)["jobs"]["done"], 3);
  bench_.Write("sweep.json", sweep.dump());
  const Json expected = JsonOf(bench_.Run("sweep sweep.json --json").out);
  const Json table = Get(*Serve(), path + "/table");
  for (std::size_t i = 0; i < 3; ++i) {
    Json row = table["rows"][i], wanted = expected["rows"][i];
    for (const char* differs : {"seconds", "link"}) row[differs] = wanted[differs] = nullptr;
    EXPECT_EQ(row, wanted);
  }
}

// Not ready is no full disk: the client may ask again.
TEST_P(OnServer, AServerThatIsAwayIsAnsweredWith503) {
  auto client = To(*one_);
  ASSERT_EQ(client.Get("/v1/parts?limit=1")->status, 200);
  test::WhilePostgresIsAway([&] {
    for (const auto& answer : {client.Get("/v1/parts"), client.Get("/v1/parts/smc-t0403"),
                               client.Post("/v1/designs", Exosuit(1).dump(), kJson),
                               client.Post("/v1/parts", NewFitting("a").dump(), kJson)}) {
      EXPECT_EQ(answer->status, 503) << answer->body;
      EXPECT_EQ(answer->get_header_value("Retry-After"), "5");
      EXPECT_THAT(answer->body, HasSubstr("cannot be reached; nothing was changed"));
    }
    EXPECT_EQ(client.Get("/readyz")->status, 503);
    EXPECT_EQ(client.Get("/healthz")->status, 200);
  });
  EXPECT_EQ(client.Get("/v1/parts?limit=1")->status, 200);
  EXPECT_EQ(client.Post("/v1/parts", NewFitting("a").dump(), kJson)->status, 201);
}

TEST_P(OnServer, AStoppedWorkerEndsItsJobFirst) {
  auto worker = Work();
  const std::string job = Post(*one_, Exosuit(100));
  EXPECT_EQ(When(*one_, job, "queued")["status"], "running");
  EXPECT_EQ(worker->End(SIGTERM), 0);
  const Json ended = Get(*one_, job);
  EXPECT_EQ(ended["status"], "done");
  EXPECT_EQ(ended["attempts"], 1);
}

TEST_P(OnServer, ServicesShareCatalogueQueueAndTokens) {
  const auto two = Serve();
  const auto added = To(*two).Post("/v1/parts", NewFitting("bench-f1").dump(), kJson);
  EXPECT_EQ(added->status, 201) << added->body;
  EXPECT_EQ(Get(*one_, "/v1/parts/bench-f1")["part_number"], "F1");
  const std::string job = Post(*one_, SlowToProve(100));
  EXPECT_EQ(Get(*two, job)["status"], "queued");
  EXPECT_EQ(Get(*two, "/v1/designs")["jobs"].size(), 1u);
  const Json queue = Get(*two, "/v1/queue");
  EXPECT_EQ(queue["waiting"], 1);
  EXPECT_EQ(queue["running"], 0);
  EXPECT_EQ(queue["oldest"], Get(*one_, job)["submitted_at"]);
  EXPECT_EQ(To(*two).Delete(job)->status, 200);
  EXPECT_EQ(Get(*one_, job)["status"], "cancelled");
  EXPECT_EQ(Get(*one_, "/readyz")["status"], "ready");
  const auto listed = bench_.Run("jobs --json --catalog '" + address_ + "'");
  EXPECT_EQ(JsonOf(listed.out)["jobs"][0]["status"], "cancelled") << listed.err;
  EXPECT_EQ(bench_.Run("token create me --catalog '" + address_ + "'").status, 0);
  EXPECT_THAT(bench_.Run("token list --catalog '" + address_ + "'").out, HasSubstr("me"));
}

// A client of one service hears of the end of a job that another process did.
TEST_P(OnServer, WhoWaitsHearsOfWhatAWorkerDid) {
  const auto worker = Work();
  const auto answer =
      To(*one_).Post("/v1/designs", {{"Prefer", "wait=60"}}, Example("gripper", 100).dump(), kJson);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(JsonOf(answer->body)["status"], "optimal");
}

TEST_P(OnServer, AWorkerOfAFileIsRefused) {
  const auto refused = bench_.Run("worker --catalog catalog.db");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("postgresql://USER@HOST/DATABASE"));
  EXPECT_THAT(bench_.Run("serve --workers 0 --port 0").err, HasSubstr("--workers 0"));
}

// The names end in "/Postgresql", which tests/CMakeLists.txt runs together, on one server.
INSTANTIATE_TEST_SUITE_P(Each, OnServer, testing::Values("Postgresql"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace worker_test
}  // namespace plenum::server
