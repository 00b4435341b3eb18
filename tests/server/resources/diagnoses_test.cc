// Diagnoses as jobs of the real service. The data are a rigid chamber that leaks through a laminar
// resistance, whose pressure is known in closed form.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include "server/http.h"
#include "tests/server/service.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace diagnoses_test {

using api::Json;
using testing::HasSubstr;

constexpr char kJson[] = "application/json";
constexpr char kPath[] = "/v1/diagnoses";
constexpr double kLeakLPerMinBar = 0.5;

// V·dp/dt = −G·(p² − p_a²)/2, so (p − p_a)/(p + p_a) decays at the rate G·p_a/V.
double LeakingKpa(double initial_kpa, double t_s) {
  const double ambient_kpa = 100.0, volume_l = 0.05;
  const double rate_per_s = kLeakLPerMinBar / 60.0 / volume_l;
  const double e = initial_kpa / (initial_kpa + 2 * ambient_kpa) * std::exp(-rate_per_s * t_s);
  return 2 * ambient_kpa * e / (1 - e);
}

// Closed chambers whose pressures follow `kpa_gauge`.
Json ClosedChambers(int runs, double expansion_ratio, int samples, double interval_s,
                    const std::function<double(int run, double t_s)>& kpa_gauge) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise_kpa(0.0, 0.1);
  Json document = {{"schema", "measurement/1"},
                   {"name", "closed chamber"},
                   {"time_limit_s", 600},  // sanitizers are slow
                   {"rig",
                    {{"actuator",
                      {{"rest_volume_ml", 50.0},
                       {"expansion_ratio", expansion_ratio},
                       {"operating_pressure_kpa_gauge", 100.0}}},
                     {"supply", {{"kind", "none"}}}}}};
  for (int r = 0; r < runs; ++r) {
    Json run = {{"id", "r" + std::to_string(r)}, {"blocked", expansion_ratio == 1.0}};
    run["valve"] = Json::array({{{"t_s", 0.0}, {"state", "hold"}}});
    for (int i = 0; i < samples; ++i) {
      run["t_s"].push_back(interval_s * i);
      run["pressure_kpa_gauge"].push_back(kpa_gauge(r, interval_s * i) + noise_kpa(random));
    }
    document["runs"].push_back(std::move(run));
  }
  return document;
}

Json LeakingChamber(int runs = 2) {
  return ClosedChambers(runs, 1.0, 120, 0.25, [](int run, double t_s) {
    return LeakingKpa(run % 2 == 0 ? 100.0 : 60.0, t_s);
  });
}

class Diagnoses : public testing::Test {
 protected:
  Diagnoses() { client_->set_read_timeout(320); }

  static Json Body(const httplib::Result& result) { return Json::parse(result->body); }
  httplib::Result Post(const Json& document, const httplib::Headers& headers = {}) {
    return client_->Post(kPath, headers, document.dump(), kJson);
  }
  httplib::Result PostAndWait(const Json& document) {
    return Post(document, {{"Prefer", "wait=300"}, {"From", "bench"}});
  }
  // The events of a job until it has ended.
  std::string Events(const std::string& job) {
    std::string events;
    client_->Get(job + "/events", [&](const char* data, std::size_t size) {
      events.append(data, size);
      return true;
    });
    return events;
  }
  void ExpectInvalid(const Json& document, const std::string& pointer) {
    const auto refused = Post(document);
    EXPECT_EQ(refused->status, 422) << refused->body;
    EXPECT_THAT(refused->body, HasSubstr("\"pointer\":\"" + pointer + "\""));
  }

  const Service service_{OneJobAtATime()};
  const Workbench& bench_ = service_.bench();
  const std::unique_ptr<httplib::Client> client_ =
      std::make_unique<httplib::Client>("127.0.0.1", service_.port());
};

TEST_F(Diagnoses, FindsTheLeakSavesItAndPredictsWithIt) {
  Json document = LeakingChamber();
  document["save"] = "leaky";
  const auto found = PostAndWait(document);
  ASSERT_EQ(found->status, 200) << found->body;
  EXPECT_EQ(found->get_header_value("Preference-Applied"), "wait=300");
  const Json result = Body(found);
  EXPECT_EQ(result["schema"], "diagnosis/1");
  EXPECT_EQ(result["verdict"], "explained");
  ASSERT_EQ(result["effects"].size(), 1u);
  EXPECT_EQ(result["effects"][0]["id"], "leak");
  const Json& leak = result["effects"][0]["parameters"]["conductance_l_per_min_bar"];
  EXPECT_NEAR(leak["value"].get<double>(), kLeakLPerMinBar, 0.01 * kLeakLPerMinBar);
  EXPECT_EQ(result["saved"]["name"], "leaky");
  EXPECT_EQ(result["saved"]["who"], "bench");
  EXPECT_EQ(Body(client_->Get("/v1/models/leaky"))["versions"].size(), 1u);

  const Json job = Body(client_->Get(found->get_header_value("Location")));
  EXPECT_EQ(job["status"], "done");
  EXPECT_EQ(job["name"], "closed chamber");
  EXPECT_EQ(job["result"], result);

  document = LeakingChamber();
  document["model"] = "leaky";
  const Json again = Body(PostAndWait(document));
  EXPECT_EQ(again["verdict"], "adequate") << again["sentence"];
  EXPECT_TRUE(again["candidates"].empty());  // nothing was searched
  EXPECT_FALSE(again.contains("saved"));
}

TEST_F(Diagnoses, AModelThatCannotBeSavedLosesNoDiagnosis) {
  SQLite::Database(bench_.catalog(), SQLite::OPEN_READWRITE)
      .exec("CREATE TRIGGER full BEFORE INSERT ON model BEGIN SELECT RAISE(ABORT, 'no room'); END");
  Json document = LeakingChamber();
  document["save"] = "leaky";
  const auto found = PostAndWait(document);
  ASSERT_EQ(found->status, 200) << found->body;
  Json result = Body(found);
  EXPECT_EQ(result["verdict"], "explained");
  EXPECT_TRUE(result["saved"].is_null());
  EXPECT_THAT(result["not_saved"]["detail"].get<std::string>(), HasSubstr("POST"));
  EXPECT_EQ(client_->Get("/v1/models/leaky")->status, 404);
  // What is in the answer is what can be posted when there is room again.
  SQLite::Database(bench_.catalog(), SQLite::OPEN_READWRITE).exec("DROP TRIGGER full");
  result["not_saved"].erase("detail");
  const auto saved = client_->Post("/v1/models", result["not_saved"].dump(), kJson);
  ASSERT_EQ(saved->status, 201) << saved->body;
  EXPECT_EQ(Body(saved)["model"]["effects"][0]["id"], "leak");
}

// In a short hold a leak falls as creep does.
TEST_F(Diagnoses, SaysWhatCannotBeToldApartAndWhichRunWouldTell) {
  const Json document =
      ClosedChambers(2, 2.0, 60, 0.05, [](int, double t_s) { return 100.0 - 0.45 * t_s; });
  const Json result = Body(PostAndWait(document));
  ASSERT_EQ(result["verdict"], "tie") << result["sentence"];
  EXPECT_THAT(result["tied"], testing::Contains(Json::array({"leak"})));
  EXPECT_GE(result["tied"].size(), 2u);
  EXPECT_TRUE(result["effects"].empty());
  EXPECT_FALSE(result["next_experiment"].is_null());
}

// A leak that opens above a pressure is none of the effects listed; the term that is learned is.
TEST_F(Diagnoses, LearnsWhatNoEffectExplainsAndPredictsWithIt) {
#ifdef PLENUM_SANITIZED
  GTEST_SKIP() << "takes minutes; Discrepancy.ASeamThatGapesIsLearnedAsALeakThatOpens goes the "
                  "same way";
#endif
  const auto gaping = [](int run, double t_s) {
    double kpa = std::array{100.0, 75.0, 50.0, 90.0}[static_cast<std::size_t>(run % 4)];
    for (double t = 0.0; t < t_s; t += 0.01)
      kpa -= 0.01 * 0.06 * kpa * std::clamp((kpa - 60.0) / 2.0, 0.0, 1.0);
    return kpa;
  };
  Json document = ClosedChambers(4, 1.0, 80, 0.25, gaping);
  document["save"] = "gaping";
  const Json result = Body(PostAndWait(document));
  ASSERT_EQ(result["verdict"], "unexplained") << result["sentence"];
  EXPECT_TRUE(result["effects"].empty());
  ASSERT_FALSE(result["discrepancy"]["learned"].is_null());
  EXPECT_EQ(result["discrepancy"]["learned"]["id"], "learned_leak");
  const double after_kpa = result["discrepancy"]["rms_after_kpa"];
  EXPECT_LT(after_kpa, 0.3);
  EXPECT_LT(after_kpa, 0.1 * result["discrepancy"]["rms_before_kpa"].get<double>());

  document.erase("save");
  document["model"] = "gaping";
  const Json again = Body(PostAndWait(document));
  EXPECT_NEAR(again["after"]["rms_kpa"].get<double>(), after_kpa, 0.05);
}

TEST_F(Diagnoses, OutOfTimeNamesNothing) {
  Json document = LeakingChamber(200);
  document["time_limit_s"] = 0.1;
  const Json result = Body(PostAndWait(document));
  EXPECT_EQ(result["verdict"], "undecided");
  EXPECT_TRUE(result["effects"].empty());
  EXPECT_TRUE(result["tied"].empty());
}

TEST_F(Diagnoses, CanBeFollowedAndPolled) {
  const auto accepted = Post(LeakingChamber());
  ASSERT_EQ(accepted->status, 202) << accepted->body;
  const std::string id = Body(accepted)["id"], job = std::string(kPath) + "/" + id;
  EXPECT_EQ(accepted->get_header_value("Location"), job);
  EXPECT_EQ(Body(accepted)["links"]["self"], job);
  EXPECT_EQ(Body(client_->Get(kPath))["jobs"][0]["id"], id);
  EXPECT_TRUE(Body(client_->Get("/v1/designs"))["jobs"].empty());
  EXPECT_EQ(client_->Get("/v1/designs/" + id)->status, 404);
  EXPECT_THAT(Events(job), HasSubstr("event: end\n"));
  const Json polled = Body(client_->Get(job));
  EXPECT_EQ(polled["status"], "done");
  EXPECT_EQ(polled["progress"]["share"], 1.0);
  EXPECT_FALSE(polled["progress"]["doing"].get<std::string>().empty());
  EXPECT_EQ(polled["result"]["verdict"], "explained");
  EXPECT_EQ(Body(client_->Get(kPath))["jobs"][0]["progress"]["outcome"], "explained");
}

TEST_F(Diagnoses, CanBeCancelledRunningOrQueued) {
  const Json slow = LeakingChamber(200);
  const std::string running = Post(slow)->get_header_value("Location");
  while (Body(client_->Get(running))["status"] == "queued") std::this_thread::yield();
  const std::string queued = Post(slow)->get_header_value("Location");
  const auto refused = Post(slow);
  EXPECT_EQ(refused->status, 429);
  EXPECT_FALSE(refused->get_header_value("Retry-After").empty());
  EXPECT_EQ(Body(client_->Delete(queued))["status"], "cancelled");
  EXPECT_TRUE(Body(client_->Get(queued))["result"].is_null());
  EXPECT_EQ(client_->Delete(running)->status, 200);
  EXPECT_THAT(Events(running), HasSubstr("event: end\n"));
  EXPECT_EQ(Body(client_->Get(running))["status"], "cancelled");
  EXPECT_EQ(client_->Delete(std::string(kPath) + "/none")->status, 404);
}

TEST_F(Diagnoses, NamesWhatIsWrong) {
  EXPECT_EQ(client_->Post(kPath, "{\"schema\":", kJson)->status, 400);
  EXPECT_EQ(client_->Post(kPath, "[]", kJson)->status, 422);
  Json wrong = LeakingChamber();
  wrong["rig"]["actuator"]["rest_volume_ml"] = -1;
  ExpectInvalid(wrong, "/rig/actuator/rest_volume_ml");
  Json names = LeakingChamber();
  names["save"] = "Not A Name";
  ExpectInvalid(names, "/save");
  names["save"] = 7;
  names["model"] = "unheard-of";
  ExpectInvalid(names, "/save");
  ExpectInvalid(names, "/model");
  EXPECT_TRUE(Body(client_->Get(kPath))["jobs"].empty());
}

// Saving is part of the job, and done once however often the job is begun.
TEST(DiagnosesOverARestart, EndAndSaveTheirModel) {
  const Workbench bench;
  Json document = LeakingChamber(8);
  document["save"] = "leaky";
  std::string job;
  for (int starts = 0; starts < 3; ++starts) {
    ServeProcess serve(bench.catalog());
    httplib::Client client("127.0.0.1", serve.port());
    if (starts == 0) job = client.Post(kPath, document.dump(), kJson)->get_header_value("Location");
    Json seen;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      seen = Json::parse(client.Get(job)->body);
      ASSERT_TRUE(starts == 2 || seen["result"].is_null());
    } while (starts < 2 ? seen["progress"].is_null() : seen["result"].is_null());
    EXPECT_EQ(serve.End(SIGKILL), -SIGKILL);
    if (starts < 2) continue;
    EXPECT_EQ(seen["status"], "done");
    EXPECT_EQ(seen["result"]["verdict"], "explained");
    EXPECT_EQ(seen["result"]["saved"]["version"], 1);
  }
}

}  // namespace diagnoses_test
}  // namespace plenum::server
