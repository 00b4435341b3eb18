// The real service on a free loopback port.
#include "server/http.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <memory>
#include <thread>

#include "catalog/store.h"
#include "server/protection.h"
#include "service.h"
#include "workbench.h"

namespace plenum::server {
namespace {

using api::Json;
using testing::HasSubstr;
using testing::StartsWith;

constexpr char kJson[] = "application/json";
constexpr char kProblem[] = "application/problem+json";

class Http : public testing::Test {
 protected:
  Http() { client_->set_read_timeout(60); }

  static Json Body(const httplib::Result& result) {
    auto parsed = api::ParseJson(result ? result->body : "");
    return std::holds_alternative<Json>(parsed) ? std::get<Json>(parsed) : Json();
  }

  // A problem document of that status with an error at `pointer` ("" asks for none).
  static void ExpectProblem(const httplib::Result& result, int status,
                            const std::string& pointer = "") {
    ASSERT_TRUE(result) << httplib::to_string(result.error());
    EXPECT_EQ(result->status, status) << result->body;
    EXPECT_EQ(result->get_header_value("Content-Type"), kProblem);
    const auto body = Body(result);
    EXPECT_EQ(body["status"], status);
    if (pointer.empty()) return;
    std::string pointers;
    for (const auto& error : body["errors"]) pointers += error["pointer"].get<std::string>() + " ";
    EXPECT_THAT(pointers, HasSubstr(pointer));
  }

  // Sends bytes as they are and gives all that comes back until the service closes.
  std::string Raw(const std::string& bytes) const {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(service_.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string answer;
    if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      char buffer[4096];
      for (ssize_t n; (n = recv(fd, buffer, sizeof buffer, 0)) > 0;)
        answer.append(buffer, static_cast<std::size_t>(n));
    }
    close(fd);
    return answer;
  }

  const Service service_{OneJobAtATime()};
  const Workbench& bench_ = service_.bench();
  const std::unique_ptr<httplib::Client> client_ =
      std::make_unique<httplib::Client>("127.0.0.1", service_.port());
};

TEST_F(Http, SaysThatItRunsAndWhatItIs) {
  EXPECT_EQ(Body(client_->Get("/healthz"))["status"], "ok");
  std::string paths;
  const Json table = Body(client_->Get("/v1"));
  for (const Json& route : table["routes"])
    paths += route["method"].get<std::string>() + " " + route["path"].get<std::string>() + "\n";
  EXPECT_THAT(paths, HasSubstr("GET /v1/designs/{id}/events\n"));
  EXPECT_THAT(paths, HasSubstr("GET /v1\n"));
}

TEST_F(Http, RefusesUnknownPathsAndMethods) {
  ExpectProblem(client_->Get("/v1/wheels"), 404);
  ExpectProblem(client_->Post("/v1/wheels", "{}", kJson), 404);
  const auto wrong = client_->Put("/v1/designs", "{}", kJson);
  ExpectProblem(wrong, 405);
  EXPECT_EQ(wrong->get_header_value("Allow"), "POST, GET");
  ExpectProblem(client_->Get("/v1/parts/" + std::string(6000, 'x')), 414);
}

TEST_F(Http, RefusesPagesOfOtherSites) {
  const httplib::Headers other = {{"Origin", "https://example.com"}};
  ExpectProblem(client_->Post("/v1/parts", other, NewFitting("a").dump(), kJson), 403);
  const httplib::Headers own = {{"Origin", "http://localhost:8080"}};
  EXPECT_EQ(client_->Post("/v1/parts", own, NewFitting("a").dump(), kJson)->status, 201);
}

TEST_F(Http, TellsNotJsonFromInvalid) {
  for (const char* path :
       {"/v1/designs", "/v1/diagnoses", "/v1/simulations", "/v1/maps", "/v1/parts"}) {
    ExpectProblem(client_->Post(path, "", kJson), 400);
    ExpectProblem(client_->Post(path, "{\"a\": 1,}", kJson), 400);
    ExpectProblem(client_->Post(path, std::string("{}\0{}", 5), kJson), 400);
    ExpectProblem(client_->Post(path, "[]", kJson), 422);
  }
}

TEST_F(Http, SurvivesDeepNesting) {
  ExpectProblem(client_->Post("/v1/designs", std::string(1'000'000, '['), kJson), 400);
  EXPECT_EQ(client_->Get("/healthz")->status, 200);
}

TEST_F(Http, RefusesLargeBodiesHoweverTheyCome) {
  const std::string large(9 << 20, ' ');
  ExpectProblem(client_->Post("/v1/designs", large, kJson), 413);
  std::size_t sent = 0;
  const auto chunked = client_->Post(
      "/v1/designs",
      [&](std::size_t, httplib::DataSink& sink) {
        const std::string piece(1 << 20, ' ');
        if (sent < large.size()) {
          sink.write(piece.data(), piece.size());
          sent += piece.size();
        } else {
          sink.done();
        }
        return true;
      },
      kJson);
  ExpectProblem(chunked, 413);
  EXPECT_EQ(client_->Get("/healthz")->status, 200);
}

TEST_F(Http, RefusesEncodedAndFormBodies) {
  ExpectProblem(client_->Post("/v1/maps", {{"Content-Encoding", "gzip"}}, "xyz", kJson), 415);
  ExpectProblem(client_->Post("/v1/maps", {{"Content-Encoding", "br"}}, "xyz", kJson), 415);
  const httplib::MultipartFormDataItems form = {{"a", "{}", "", ""}};
  ExpectProblem(client_->Post("/v1/maps", form), 415);
}

TEST_F(Http, ClosesTheConnectionWhenABodyBreaksOff) {
  // What follows the broken chunk must not be taken for a request of its own.
  const auto answer =
      Raw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"
          "DELETE /v1/parts/none HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 400"));
  EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << answer;
}

TEST_F(Http, AnswersPostsAndDeletesWithoutABody) {
  EXPECT_THAT(Raw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(Raw("DELETE /v1/parts/none HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 404"));
}

TEST_F(Http, NamesTheFieldsThatAreInvalid) {
  auto request = Exosuit(1.0);
  request["actuators"][0]["rest_volume_ml"] = 0;
  ExpectProblem(client_->Post("/v1/designs", request.dump(), kJson), 422,
                "/actuators/0/rest_volume_ml");
}

TEST_F(Http, AddsGetsReplacesAndDeletesAPart) {
  const std::string name = "bench-f1", path = "/v1/parts/" + name;
  ASSERT_EQ(client_->Post("/v1/parts", NewFitting(name).dump(), kJson)->status, 201);
  ExpectProblem(client_->Post("/v1/parts", NewFitting(name).dump(), kJson), 409);

  const auto got = client_->Get(path);
  ASSERT_EQ(got->status, 200);
  const auto etag = got->get_header_value("ETag");
  EXPECT_EQ(client_->Get(path, {{"If-None-Match", etag}})->status, 304);

  auto heavier = NewFitting(name);
  heavier["mass_kg"] = 0.004;
  ExpectProblem(client_->Put(path, heavier.dump(), kJson), 412);
  ExpectProblem(client_->Put(path, {{"If-Match", "\"old\""}}, heavier.dump(), kJson), 412);
  const auto put = client_->Put(path, {{"If-Match", etag}}, heavier.dump(), kJson);
  ASSERT_EQ(put->status, 200) << put->body;
  EXPECT_NE(put->get_header_value("ETag"), etag);
  EXPECT_EQ(Body(client_->Get(path))["mass_kg"], 0.004);
  ExpectProblem(client_->Put(path, {{"If-Match", etag}}, heavier.dump(), kJson), 412);
  ExpectProblem(client_->Put("/v1/parts/other", {{"If-Match", "*"}}, heavier.dump(), kJson), 422,
                "/id");

  ExpectProblem(client_->Delete(path, {{"If-Match", etag}}), 412);
  ExpectProblem(client_->Delete(path), 412);
  const auto now = put->get_header_value("ETag");
  EXPECT_EQ(client_->Delete(path, {{"If-Match", now}})->status, 204);
  ExpectProblem(client_->Get(path), 404);
  ExpectProblem(client_->Delete(path, {{"If-Match", now}}), 404);
}

TEST_F(Http, GivesTheLocationOfAnAddedPart) {
  const auto added = client_->Post("/v1/parts", NewFitting("bench-f1").dump(), kJson);
  ASSERT_EQ(added->status, 201);
  EXPECT_EQ(added->get_header_value("Location"), "/v1/parts/bench-f1");
  EXPECT_EQ(Body(client_->Get("/v1/parts/bench-f1"))["origin"], "user");
}

TEST_F(Http, RefusesABadPart) {
  auto part = NewFitting("bench-f1");
  part["mass_kg"] = -1;
  ExpectProblem(client_->Post("/v1/parts", part.dump(), kJson), 422, "/mass_kg");
}

TEST_F(Http, PagesThroughAllPartsOnce) {
  std::vector<std::string> ids;
  std::string cursor;
  for (int pages = 0; pages < 100; ++pages) {
    const auto page = Body(client_->Get("/v1/parts?family=valve&limit=7&cursor=" + cursor));
    ASSERT_LE(page["parts"].size(), 7u);
    for (const auto& part : page["parts"]) {
      EXPECT_EQ(part["family"], "valve");
      ids.push_back(part["id"]);
    }
    if (page["next_cursor"].is_null()) break;
    cursor = page["next_cursor"];
  }
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  const auto all = Body(client_->Get("/v1/parts?family=valve&limit=1000"));
  EXPECT_EQ(ids.size(), all["parts"].size());
  EXPECT_GT(ids.size(), 7u);
}

TEST_F(Http, RefusesBadQueries) {
  ExpectProblem(client_->Get("/v1/parts?family=wheels"), 422, "/family");
  for (const char* limit : {"0", "1001", "-1", "ten", "1e2", ""}) {
    ExpectProblem(client_->Get(std::string("/v1/parts?limit=") + limit), 422, "/limit");
  }
  ExpectProblem(client_->Get("/v1/parts?colour=red"), 422, "/colour");
  ExpectProblem(client_->Get("/v1/parts/export"), 422, "/family");
}

TEST_F(Http, ExportGoesBackInUnchanged) {
  const auto csv = client_->Get("/v1/parts/export?family=battery");
  ASSERT_EQ(csv->status, 200);
  EXPECT_THAT(csv->get_header_value("Content-Type"), StartsWith("text/csv"));
  const auto imported = client_->Post("/v1/parts/import?family=battery", csv->body, "text/csv");
  ASSERT_EQ(imported->status, 200) << imported->body;
  EXPECT_TRUE(Body(imported)["added"].empty());
  EXPECT_TRUE(Body(imported)["replaced"].empty());
  EXPECT_GT(Body(imported)["unchanged"].size(), 0u);
}

TEST_F(Http, ImportRefusesAFileWithABadRowAltogether) {
  client_->Post("/v1/parts", NewFitting("bench-f1").dump(), kJson);
  auto csv = client_->Get("/v1/parts/export?family=fitting")->body;
  ASSERT_EQ(client_->Delete("/v1/parts/bench-f1", {{"If-Match", "*"}})->status, 204);
  csv += "only-an-id\n";
  ExpectProblem(client_->Post("/v1/parts/import?family=fitting", csv, "text/csv"), 422, "/");
  ExpectProblem(client_->Get("/v1/parts/bench-f1"), 404);
}

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

TEST_F(Http, FamiliesNameTheirFields) {
  const Json families = Body(client_->Get("/v1/families"))["families"];
  EXPECT_EQ(families.size(), 9u);
  for (const Json& family : families) {
    const auto page =
        Body(client_->Get("/v1/parts?limit=1&family=" + family["name"].get<std::string>()));
    std::map<std::string, Json> fields;
    for (const char* kind : {"numbers", "texts"})
      for (const Json& field : family[kind]) fields[field["name"]] = field;
    for (const auto& [name, origin] : page["parts"][0]["provenance"].items())
      EXPECT_TRUE(fields.contains(name) ||
                  (family["has_curve"] && page["parts"][0].contains("curve")))
          << family["name"] << " " << name;
    for (const auto& [name, field] : fields) {
      EXPECT_FALSE(field["meaning"].get<std::string>().empty()) << name;
      if (field["required"].get<bool>()) {
        EXPECT_TRUE(page["parts"][0].contains(name)) << name;
      }
    }
  }
}

TEST_F(Http, APostedPartChangesTheRankingUntilItIsDeleted) {
  int revision = 0;  // of the catalogue that the last answer names
  const auto rank_one = [&] {
    const auto result =
        client_->Post("/v1/designs", {{"Prefer", "wait=60"}}, Exosuit(30.0).dump(), kJson);
    revision = Body(result)["catalogue_revision"]["number"];
    const auto parts = Body(result)["designs"][0]["parts"];
    std::map<std::string, std::string> ids;
    for (const auto& part : parts) ids[part["family"]] = part["id"];
    return ids;
  };
  const auto before = rank_one();
  const int first = revision;
  auto lighter = Body(client_->Get("/v1/parts/" + before.at("battery")));
  lighter["id"] = "bench-light-pack";
  lighter["mass_kg"] = 0.5 * lighter["mass_kg"].get<double>();
  ASSERT_EQ(client_->Post("/v1/parts", lighter.dump(), kJson)->status, 201);
  EXPECT_EQ(rank_one().at("battery"), "bench-light-pack");
  EXPECT_EQ(revision, first + 1);
  ASSERT_EQ(client_->Delete("/v1/parts/bench-light-pack", {{"If-Match", "*"}})->status, 204);
  EXPECT_EQ(rank_one(), before);
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

TEST_F(Http, AnswersAreWholeWhateverRangeIsAskedFor) {
  const std::string whole = client_->Get("/v1/limits")->body;
  for (const char* range : {"bytes=0-9", "bytes=9-5", "bytes=-3", "items=1-2", "bytes=0-1,4-5"}) {
    const auto answer = client_->Get("/v1/limits", {{"Range", range}});
    EXPECT_EQ(answer->status, 200) << range;
    EXPECT_EQ(answer->body, whole) << range;
  }
  EXPECT_EQ(client_->Head("/v1/limits")->get_header_value("Accept-Ranges"), "none");
}

TEST_F(Http, ServesWhileConnectionsIdle) {
  // A client may hold some connections without others being starved.
  std::vector<std::unique_ptr<httplib::Client>> clients;
  for (int i = 0; i < 12; ++i) {
    clients.push_back(std::make_unique<httplib::Client>("127.0.0.1", service_.port()));
    clients.back()->set_keep_alive(true);
    ASSERT_EQ(clients.back()->Get("/healthz")->status, 200);
  }
}

TEST(Loopback, IsToldFromOtherAddresses) {
  for (const char* host : {"127.0.0.1", "127.8.9.1", "::1", "localhost"}) {
    EXPECT_TRUE(IsLoopback(host)) << host;
  }
  for (const char* host :
       {"", "0.0.0.0", "::", "10.0.0.1", "127.0.0.1.example.com", "localhost.example.com"}) {
    EXPECT_FALSE(IsLoopback(host)) << host;
  }
}

TEST(Serve, KeepsPartsWhenItIsKilled) {
  const Workbench bench;
  {
    ServeProcess serve(bench.catalog());
    httplib::Client client("127.0.0.1", serve.port());
    ASSERT_EQ(client.Post("/v1/parts", NewFitting("bench-f1").dump(), kJson)->status, 201);
    EXPECT_EQ(serve.End(SIGKILL), -SIGKILL);
  }
  ServeProcess serve(bench.catalog());
  httplib::Client client("127.0.0.1", serve.port());
  EXPECT_EQ(client.Get("/v1/parts/bench-f1")->status, 200);
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

TEST(Serve, SaysWhenThePortIsTaken) {
  const Workbench bench;
  ServeProcess serve(bench.catalog());
  HttpOptions options;
  options.catalog = bench.catalog();
  options.port = serve.port();
  EXPECT_THROW(HttpService{options}, ListenError);
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

}  // namespace
}  // namespace plenum::server
