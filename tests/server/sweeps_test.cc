// Sweeps over HTTP, in a file and over the end of the service.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "api/design/sweep/sweep_table.h"
#include "tests/server/http_client.h"

namespace plenum::server {
namespace sweeps_test {

using api::Json;
using testing::HasSubstr;

constexpr char kSweeps[] = "/v1/sweeps";

Json Hz(double hz) { return {{"duty", {{"frequency_hz", hz}}}}; }
Json SweepOf(const Json& requirements, const std::vector<Json>& merges) {
  Json patches = Json::array();
  for (const Json& merge : merges)
    patches.push_back({{"name", std::to_string(patches.size())}, {"merge", merge}});
  return {{"schema", "sweep/1"}, {"requirements", requirements}, {"patches", patches}};
}
std::string WithoutSeconds(const std::string& answer) {
  Json json = Json::parse(answer);
  json.erase("seconds");
  json.erase("conflicts_complete");  // whether all were found in the time that there was
  return json.dump();
}

class Sweeps : public Http {
 protected:
  httplib::Result Post(const Json& sweep, const httplib::Headers& headers = {}) {
    return client_->Post(kSweeps, headers, sweep.dump(), kJson);
  }
  Json WhenEnded(const std::string& path) {
    for (int i = 0; i < 6000; ++i) {
      Json sweep = Body(client_->Get(path));
      if (sweep["ended_at"].is_string()) return sweep;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
  }
};

TEST_F(Sweeps, EachJobAnswersAsItsRequirementsAlone) {
  const Json base = Exosuit(120.0);
  const std::vector<Json> merges = {Hz(0.05), {{"supply", {{"mass_kg_max", 0.2}}}}};
  const auto answered = Post(SweepOf(base, merges), {{"Prefer", "wait=60"}});
  ASSERT_EQ(answered->status, 200) << answered->body;
  const Json table = Body(answered);
  ASSERT_EQ(table["rows"].size(), 2u);
  EXPECT_EQ(table["rows"][1]["outcome"], "infeasible");
  for (std::size_t i = 0; i < 2; ++i) {
    Json merged = base;
    merged.merge_patch(merges[i]);
    const auto alone = client_->Post("/v1/designs", {{"Prefer", "wait=60"}}, merged.dump(), kJson);
    ASSERT_EQ(alone->status, 200);
    const Json& row = table["rows"][i];
    const Json job = Body(client_->Get(row["link"].get<std::string>()));
    EXPECT_EQ(WithoutSeconds(job["result"].dump()), WithoutSeconds(alone->body));
    Json expected = api::SweepRow(job["result"]);
    for (const auto& [name, value] : expected.items()) EXPECT_EQ(row[name], value) << name;
  }
}

TEST_F(Sweeps, TheTableIsJsonOrCsv) {
  const auto answered = Post(SweepOf(Exosuit(30.0), {Hz(0.05)}), {{"Prefer", "wait=60"}});
  const std::string table = answered->get_header_value("Location") + "/table";
  const auto type = [&](const std::string& query, const char* accept) {
    const auto got = client_->Get(table + query, {{"Accept", accept}});
    return got->get_header_value("Content-Type").substr(0, 8);
  };
  EXPECT_EQ(type("", "*/*"), "applicat");
  EXPECT_EQ(type("", "text/csv"), "text/csv");
  EXPECT_EQ(type("", "text/csv, application/json;q=0.5"), "text/csv");
  EXPECT_EQ(type("", "application/json, text/csv;q=0.9"), "applicat");
  EXPECT_EQ(type("", "text/html, */*;q=0.8"), "applicat");
  EXPECT_EQ(type("?format=csv", "*/*"), "text/csv");
  EXPECT_EQ(type("?format=json", "text/csv"), "applicat");
  EXPECT_THAT(client_->Get(table + "?format=csv")->body, HasSubstr("\n0,done,0.05,optimal,"));
}

TEST_F(Sweeps, OneWrongPatchStoresNothing) {
  const auto refused = Post(SweepOf(Exosuit(30.0), {Hz(0.05), Hz(1000)}));
  EXPECT_EQ(refused->status, 422);
  EXPECT_EQ(Body(refused)["errors"][0]["pointer"], "/patches/1/merge/duty/frequency_hz");
  EXPECT_TRUE(Body(client_->Get(kSweeps))["sweeps"].empty());
  EXPECT_TRUE(Body(client_->Get("/v1/designs"))["jobs"].empty());
  const auto checked = client_->Post(std::string(kSweeps) + "?validate_only=true",
                                     SweepOf(Exosuit(30.0), {Hz(0.05)}).dump(), kJson);
  EXPECT_EQ(Body(checked), Json({{"valid", true}, {"patches", 1}}));
  EXPECT_TRUE(Body(client_->Get(kSweeps))["sweeps"].empty());
}

TEST_F(Sweeps, AKeyStandsForOneSweep) {
  const Json sweep = SweepOf(Exosuit(30.0), {Hz(0.05), Hz(0.06)});
  const auto first = Post(sweep, {{"Idempotency-Key", "k"}});
  const auto again = Post(sweep, {{"Idempotency-Key", "k"}});
  EXPECT_EQ(again->status, 202);
  EXPECT_EQ(again->get_header_value("Location"), first->get_header_value("Location"));
  const auto other = Post(SweepOf(Exosuit(30.0), {Hz(0.05)}), {{"Idempotency-Key", "k"}});
  EXPECT_EQ(other->status, 422);
  EXPECT_EQ(Body(client_->Get(kSweeps))["sweeps"].size(), 1u);
  EXPECT_EQ(Body(client_->Get("/v1/designs"))["jobs"].size(), 2u);
}

TEST_F(Sweeps, CancelEndsWhatHasNotEnded) {
  Json base = SlowToProve(60.0);
  const std::vector<Json> merges(6, Json::object());
  const auto accepted = Post(SweepOf(base, merges));
  ASSERT_EQ(accepted->status, 202) << accepted->body;
  const std::string path = accepted->get_header_value("Location");
  EXPECT_EQ(client_->Delete(path)->status, 200);
  const Json ended = WhenEnded(path);
  EXPECT_EQ(ended["status"], "cancelled");
  EXPECT_EQ(ended["jobs"]["queued"], 0);
  EXPECT_EQ(ended["patches"].size(), 6u);
  EXPECT_EQ(client_->Delete("/v1/sweeps/none")->status, 404);
}

// A hundred jobs that wait end together, in one write: all at one time, in the order of the
// patches.
TEST_F(Sweeps, WhatWaitsIsCancelledAsOne) {
  Json base = SlowToProve(60.0);
  const auto accepted = Post(SweepOf(base, std::vector<Json>(100, Json::object())));
  ASSERT_EQ(accepted->status, 202) << accepted->body;
  const std::string path = accepted->get_header_value("Location");
  EXPECT_EQ(client_->Delete(path)->status, 200);
  const Json ended = WhenEnded(path);
  EXPECT_EQ(ended["jobs"]["cancelled"], 100);
  std::map<std::string, int> times;
  for (const Json& patch : ended["patches"]) {
    const Json job = Body(client_->Get(patch["link"].get<std::string>()));
    if (job["attempts"] == 0) ++times[job["ended_at"].get<std::string>()];
  }
  EXPECT_EQ(times.size(), 1u);
  EXPECT_GT(times.begin()->second, 50);
  EXPECT_EQ(Body(client_->Get("/v1/queue"))["waiting"], 0);
}

// Its jobs have a limit of their own: a sweep is not refused for single jobs, nor they for it.
TEST(SweepLimits, CountJobsOfSweepsByThemselves) {
  HttpOptions options;
  options.jobs.workers = 0;
  options.jobs.queued_per_client_max = 1;
  options.jobs.swept_queued_per_client_max = 3;
  const Service service(options);
  httplib::Client client("127.0.0.1", service.port());
  const auto post = [&](const char* path, const Json& document) {
    return client.Post(path, document.dump(), kJson);
  };
  const Json two = SweepOf(Exosuit(1.0), {Hz(0.05), Hz(0.06)});
  EXPECT_EQ(post(kSweeps, two)->status, 202);
  const auto refused = post(kSweeps, two);
  EXPECT_EQ(refused->status, 429);
  EXPECT_EQ(JsonOf(refused->body)["limit"]["name"], "sweep_jobs_queued_per_client_max");
  EXPECT_EQ(JsonOf(client.Get(kSweeps)->body)["sweeps"].size(), 1u);
  EXPECT_EQ(post("/v1/designs", Exosuit(1.0))->status, 202);
  EXPECT_EQ(post("/v1/designs", Exosuit(1.0))->status, 429);
  EXPECT_EQ(client.Get("/readyz")->status, 200);
}

// Killed while it is under way: its next service ends it, and the table is that of an
// uninterrupted one.
TEST(SweepRestart, AKilledServiceLosesNoJobOfASweep) {
  const Workbench bench;
  const Json sweep = SweepOf(Exosuit(60.0), {Hz(0.05), Hz(0.08), Hz(0.1), Hz(0.12), Hz(0.15)});
  std::string path;
  const auto table_of = [&](const ServeProcess& serve, bool is_last) {
    httplib::Client client("127.0.0.1", serve.port());
    client.set_read_timeout(120);
    if (path.empty()) {
      const auto accepted = client.Post(kSweeps, {{"Idempotency-Key", "k"}}, sweep.dump(), kJson);
      EXPECT_EQ(accepted->status, 202);
      path = accepted->get_header_value("Location");
    }
    while (is_last && JsonOf(client.Get(path)->body)["ended_at"].is_null())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return JsonOf(client.Get(path + "/table")->body);
  };
  for (int kill = 0; kill < 4; ++kill) {
    ServeProcess serve(bench.catalog());
    EXPECT_EQ(table_of(serve, false)["rows"].size(), 5u);
    std::this_thread::sleep_for(std::chrono::milliseconds(100 * kill));
    serve.End(SIGKILL);
  }
  ServeProcess serve(bench.catalog());
  const Json table = table_of(serve, true);
  bench.Write("sweep.json", sweep.dump());
  const auto alone = bench.Run("sweep sweep.json --json");
  ASSERT_EQ(alone.status, 0) << alone.err;
  const Json expected = JsonOf(alone.out);
  for (std::size_t i = 0; i < 5; ++i) {
    Json row = table["rows"][i], wanted = expected["rows"][i];
    for (const char* differs : {"seconds", "link"}) row[differs] = wanted[differs] = nullptr;
    EXPECT_EQ(row, wanted);
  }
}

}  // namespace sweeps_test
}  // namespace plenum::server
