// What holds for every answer: paths, bodies, origins, connections.
#include "server/http.h"

#include <csignal>
#include <filesystem>
#include <memory>

#include "server/call/protection.h"
#include "server/call/service_limits.h"
#include "tests/server/http_client.h"

namespace plenum::server {
namespace http_test {

using api::Json;
using testing::HasSubstr;
using testing::StartsWith;

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
  EXPECT_EQ(wrong->get_header_value("Allow"), "POST, GET, HEAD, OPTIONS");
  ExpectProblem(client_->Get("/v1/parts/" + std::string(6000, 'x')), 414);
}

TEST_F(Http, RefusesPagesOfOtherSites) {
  const httplib::Headers other = {{"Origin", "https://example.com"}};
  ExpectProblem(client_->Post("/v1/parts", other, NewFitting("a").dump(), kJson), 403);
  const std::string port = std::to_string(service_.port());
  ExpectProblem(
      client_->Post("/v1/parts", {{"Origin", "http://127.0.0.1:1"}}, NewFitting("a").dump(), kJson),
      403);
  const httplib::Headers own = {{"Origin", "http://127.0.0.1:" + port}};
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

// A page of another site can send text or a form without being asked.
TEST_F(Http, BodiesNeedTheirContentType) {
  const std::string part = NewFitting("a").dump();
  for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "text/json", "json"})
    ExpectProblem(client_->Post("/v1/parts", part, type), 415);
  ExpectProblem(client_->Post("/v1/parts/import?family=fitting", "id\n", "text/plain"), 415);
  EXPECT_THAT(Raw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n"
                  "Content-Length: 2\r\n\r\n{}"),
              StartsWith("HTTP/1.1 415"));
  EXPECT_EQ(client_->Post("/v1/parts", part, "Application/JSON ; charset=utf-8")->status, 201);
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

TEST_F(Http, AnswersAreWholeWhateverRangeIsAskedFor) {
  const std::string whole = client_->Get("/v1/limits")->body;
  for (const char* range : {"bytes=0-9", "bytes=9-5", "bytes=-3", "items=1-2", "bytes=0-1,4-5"}) {
    const auto answer = client_->Get("/v1/limits", {{"Range", range}});
    EXPECT_EQ(answer->status, 200) << range;
    EXPECT_EQ(answer->body, whole) << range;
  }
  EXPECT_EQ(client_->Head("/v1/limits")->get_header_value("Accept-Ranges"), "none");
}

// No part hides a route, and no route a part.
TEST_F(Http, NoPartHasTheNameOfARoute) {
  const Json table = Body(client_->Get("/v1"));
  const std::string parts = "/v1/parts/";
  int words = 0;
  for (const Json& route : table["routes"]) {
    const auto path = route["path"].get<std::string>();
    if (!path.starts_with(parts) || path.find('{') != std::string::npos) continue;
    ++words;
    ExpectProblem(client_->Post("/v1/parts", NewFitting(path.substr(parts.size())).dump(), kJson),
                  422, "/id");
  }
  EXPECT_EQ(words, 4);
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

TEST(Serve, HoldsTheCatalogueUnderEveryName) {
  const Workbench bench;
  ServeProcess serve(bench.catalog());
  std::filesystem::create_hard_link(bench.catalog(), bench.Path("hard.db"));
  std::filesystem::create_symlink(bench.catalog(), bench.Path("soft.db"));
  for (const char* name : {"hard.db", "soft.db"}) {
    HttpOptions options;
    options.catalog = bench.Path(name);
    options.port = 0;
    EXPECT_THROW(HttpService{options}, catalog::StoreError) << name;
  }
}

TEST(Serve, IsNotReadyWithoutItsOwnFile) {
  Service service;
  const std::filesystem::path catalog = service.bench().catalog();
  const auto away = catalog.string() + ".away";
  httplib::Client client("127.0.0.1", service.port());
  const auto failed = [&] {
    const auto answer = client.Get("/readyz");
    std::string names;
    const Json checks = JsonOf(answer->body)["checks"];
    for (const auto& [name, state] : checks.items())
      if (state == "failed") names.append(name).append(" ");
    return std::to_string(answer->status) + " " + names;
  };
  EXPECT_EQ(failed(), "200 ");
  std::filesystem::rename(catalog, away);
  EXPECT_EQ(failed(), "503 catalogue_in_place ");
  std::filesystem::copy(away, catalog);
  EXPECT_EQ(failed(), "503 catalogue_in_place ");
  std::filesystem::rename(away, catalog);
  EXPECT_EQ(failed(), "200 ");
  std::filesystem::resize_file(catalog, std::filesystem::file_size(catalog) / 2);
  EXPECT_EQ(failed(), "503 catalogue_readable catalogue_writable ");
}

TEST(Serve, IsNotReadyWhereAWriteWouldFail) {
  const Workbench bench;
  const ServeProcess serve(bench.catalog());
  serve.LimitFiles(1);
  httplib::Client client("127.0.0.1", serve.port());
  EXPECT_EQ(client.Get("/healthz")->status, 200);
  EXPECT_EQ(client.Get("/readyz")->status, 503);
}

TEST(Serve, SaysWhenThePortIsTaken) {
  const Workbench bench;
  ServeProcess serve(bench.catalog());
  HttpOptions options;
  options.catalog = bench.catalog();
  options.port = serve.port();
  EXPECT_THROW(HttpService{options}, ListenError);
}

TEST_F(Http, LimitsAreThoseOfRefusals) {
  const Json limits = JsonOf(client_->Get("/v1/limits")->body)["limits"];
  const auto refused = client_->Get("/" + std::string(2000, 'x'));
  EXPECT_EQ(refused->status, 414);
  const Json limit = JsonOf(refused->body)["limit"];
  EXPECT_EQ(limit["value"], limits[limit["name"].get<std::string>()]);
  EXPECT_EQ(limits["body_bytes_max"], kBodyBytesMax);
}

}  // namespace http_test
}  // namespace plenum::server
