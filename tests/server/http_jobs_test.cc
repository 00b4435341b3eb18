// Designs and models over HTTP.
#include <thread>

#include "catalog/store/store.h"
#include "server/http.h"
#include "tests/server/http_client.h"

namespace plenum::server {
namespace http_jobs_test {

using api::Json;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Http, DesignThatIsWaitedForGivesTheResult) {
  const auto result = client_->Post("/v1/designs", {{"Prefer", "respond-async, wait=30"}},
                                    Exosuit(1.0).dump(), kJson);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->status, 200) << result->body;
  EXPECT_EQ(Body(result)["schema"], "designs/1");
  const auto job = Body(client_->Get(result->get_header_value("Location")));
  EXPECT_EQ(job["status"], "done");
  EXPECT_EQ(job["result"], Body(result));
}

TEST_F(Http, APreferenceIsReadInAnyOfItsNotations) {
  const auto expect = [&](const char* prefer, int status) {
    const auto result =
        client_->Post("/v1/designs", {{"Prefer", prefer}}, Exosuit(1.0).dump(), kJson);
    EXPECT_EQ(result->status, status) << prefer << result->body;
    client_->Delete(result->get_header_value("Location"));  // gives its place in the queue back
  };
  expect("handling=strict; WAIT = \"30\"", 200);
  expect("awaited=30", 202);
  expect("wait=1e9", 202);
}

TEST_F(Http, TheListOfJobsSaysWhatEachSearchFound) {
  const auto found =
      Body(client_->Post("/v1/designs", {{"Prefer", "wait=30"}}, Exosuit(30.0).dump(), kJson));
  Json hopeless = Exosuit(30.0);
  hopeless["supply"]["mass_kg_max"] = 0.2;
  ASSERT_EQ(client_->Post("/v1/designs", {{"Prefer", "wait=30"}}, hopeless.dump(), kJson)->status,
            200);
  const auto jobs = Body(client_->Get("/v1/designs"))["jobs"];
  const Json best = jobs[1]["progress"], none = jobs[0]["progress"];
  EXPECT_EQ(best["outcome"], "optimal");
  EXPECT_EQ(best["objective"], (Json{{"minimize", "mass_kg"}}));
  EXPECT_EQ(best["best"], found["designs"][0]["totals"]["mass_kg"]);
  EXPECT_GT(best["seconds"], 0.0);
  EXPECT_EQ(none["outcome"], "infeasible");
  EXPECT_TRUE(none["best"].is_null());
}

TEST_F(Http, RequirementsCanBeCheckedWithoutAJob) {
  const std::string path = "/v1/designs?validate_only=";
  const auto valid = client_->Post(path + "true", Exosuit(1.0).dump(), kJson);
  EXPECT_EQ(valid->status, 200);
  EXPECT_EQ(Body(valid), (Json{{"valid", true}}));
  Json wrong = Exosuit(1.0);
  wrong["actuators"][0]["rest_volume_ml"] = -1;
  ExpectProblem(client_->Post(path + "true", wrong.dump(), kJson), 422,
                "/actuators/0/rest_volume_ml");
  ExpectProblem(client_->Post(path + "true", "{", kJson), 400);
  EXPECT_TRUE(Body(client_->Get("/v1/designs"))["jobs"].empty());
  ExpectProblem(client_->Post(path + "yes", Exosuit(1.0).dump(), kJson), 422, "/validate_only");
  ExpectProblem(client_->Post("/v1/designs?dry=true", Exosuit(1.0).dump(), kJson), 422, "/dry");
  EXPECT_EQ(client_->Post(path + "false", Exosuit(1.0).dump(), kJson)->status, 202);
}

TEST_F(Http, DesignJobsCanBeFollowedAndCancelled) {
  const auto accepted = client_->Post("/v1/designs", SlowToProve(120.0).dump(), kJson);
  ASSERT_EQ(accepted->status, 202) << accepted->body;
  const auto path = accepted->get_header_value("Location");
  const std::string id = Body(accepted)["id"];
  EXPECT_EQ(path, "/v1/designs/" + id);
  EXPECT_EQ(Body(accepted)["links"]["self"], path);
  EXPECT_EQ(Body(client_->Get("/v1/designs"))["jobs"][0]["id"], id);

  std::string events;
  std::thread listener([&] {
    httplib::Client other("127.0.0.1", service_.port());
    other.set_read_timeout(60);
    other.Get(path + "/events", [&](const char* data, std::size_t size) {
      events.append(data, size);
      return true;
    });
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(client_->Delete(path)->status, 200);
  listener.join();  // the stream ends with the job
  EXPECT_THAT(events, HasSubstr("event: progress\n"));
  EXPECT_THAT(events, HasSubstr("event: end\n"));
  EXPECT_EQ(Body(client_->Get(path))["status"], "cancelled");
  ExpectProblem(client_->Get("/v1/designs/none"), 404);
  ExpectProblem(client_->Delete("/v1/designs/none"), 404);
  ExpectProblem(client_->Get("/v1/designs/none/events"), 404);
}

TEST(Serve, SaysThatTheQueueIsFull) {
  const Workbench bench;
  HttpOptions options;
  options.catalog = bench.catalog();
  options.port = 0;
  options.jobs.queued_max = 0;
  HttpService service(options);
  std::thread thread([&] { service.Run(); });
  httplib::Client client("127.0.0.1", service.port());
  const auto refused = client.Post("/v1/designs", Exosuit(1.0).dump(), kJson);
  EXPECT_EQ(refused->status, 429);
  EXPECT_EQ(refused->get_header_value("Retry-After"), "10");
  service.Stop();
  thread.join();
}

TEST_F(Http, SavesAModelThatThenRanks) {
  const Json creep = {{"id", "creep"},
                      {"parameters", {{"fraction", 0.15}, {"time_constant_s", 2.0}}}};
  Json request = {{"name", "bench-creep"},
                  {"model", {{"schema", "model/1"}, {"effects", Json::array({creep})}}}};
  const auto saved = client_->Post("/v1/models", request.dump(), kJson);
  ASSERT_EQ(saved->status, 201) << saved->body;
  EXPECT_EQ(Body(saved)["version"], 1);
  EXPECT_EQ(Body(saved)["model"]["effects"][0]["id"], "creep");
  EXPECT_EQ(Body(client_->Get("/v1/models"))["models"][0]["name"], "bench-creep");
  // The same again is the same version, also with a key.
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(Body(client_->Post("/v1/models", {{"Idempotency-Key", "k"}}, request.dump(),
                                 kJson))["version"],
              1);
  ExpectProblem(client_->Post("/v1/models", {{"Idempotency-Key", "k"}}, request.dump(1), kJson),
                422);
  EXPECT_EQ(Body(client_->Post("/v1/models", request.dump(), kJson))["version"], 1);

  Json requirements = Exosuit(1.0);
  requirements["model"] = "bench-creep";
  EXPECT_EQ(client_->Post("/v1/designs?validate_only=true", requirements.dump(), kJson)->status,
            200);

  request["name"] = "nominal";
  ExpectProblem(client_->Post("/v1/models", request.dump(), kJson), 422, "/name");
  request["name"] = "bench-creep";
  request["model"]["effects"][0]["parameters"]["fraction"] = -1;
  ExpectProblem(client_->Post("/v1/models", request.dump(), kJson), 422,
                "/model/effects/0/parameters/fraction");
  request.erase("model");
  ExpectProblem(client_->Post("/v1/models", request.dump(), kJson), 422, "/model");
  EXPECT_EQ(Body(client_->Get("/v1/models/bench-creep"))["versions"].size(), 1u);
}

TEST_F(Http, ListsSavedModelsAndTheirVersions) {
  EXPECT_EQ(Body(client_->Get("/v1/models")), Json({{"models", Json::array()}}));
  {
    catalog::Store store(bench_.catalog(), catalog::Access::kWrite);
    store.SaveModel("bench", "{\"a\":1}", "me");
    store.SaveModel("bench", "{\"a\":2}", "me");
  }
  const Json models = Body(client_->Get("/v1/models"))["models"];
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0]["version"], 2);
  EXPECT_EQ(models[0]["model"], Json({{"a", 2}}));
  const Json versions = Body(client_->Get("/v1/models/bench"))["versions"];
  ASSERT_EQ(versions.size(), 2u);
  EXPECT_EQ(versions[1]["model"], Json({{"a", 1}}));
  ExpectProblem(client_->Get("/v1/models/none"), 404);
  ExpectProblem(client_->Delete("/v1/models/bench"), 405);
}

}  // namespace http_jobs_test
}  // namespace plenum::server
