// Who may ask, and what happens to clients that take too much or too long.
#include "server/call/protection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/stat.h>

#include <csignal>

#include "server/call/service_limits.h"
#include "tests/server/raw.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace protection_test {

using testing::HasSubstr;
using testing::StartsWith;

constexpr char kJson[] = "application/json";

TEST(Protection, OnlyServedHostsAndOwnPages) {
  Service service;
  httplib::Client client("127.0.0.1", service.port());
  const auto status = [&](const httplib::Headers& headers) {
    return client.Get("/v1/limits", headers)->status;
  };
  EXPECT_EQ(status({{"Host", "localhost:1"}}), 200);
  EXPECT_EQ(status({{"Host", "[::1]:8080"}}), 200);
  EXPECT_EQ(status({{"Host", "LOCALHOST"}}), 200);
  EXPECT_EQ(status({{"Host", "rebound.example"}}), 403);
  // What begins like a name that is served and goes on; what is no name at all (RFC 9112, 3.2).
  EXPECT_EQ(status({{"Host", "localhost:"}}), 200);
  EXPECT_EQ(status({{"Host", "localhost.rebound.example"}}), 403);
  for (const char* host :
       {"[::1].rebound.example", "[::1", "localhost:1@rebound.example", "127.0.0.1:8080:1"})
    EXPECT_EQ(status({{"Host", host}}), 400) << host;
  EXPECT_EQ(status({{"Origin", "http://[::1].rebound.example"}}), 403);
  EXPECT_EQ(status({{"Origin", "http://localhost:1@rebound.example"}}), 403);
  EXPECT_EQ(status({{"Host", "127.0.0.1.example"}}), 403);
  const std::string port = std::to_string(service.port());
  EXPECT_EQ(status({{"Origin", "http://127.0.0.1:" + port}}), 200);
  EXPECT_EQ(status({{"Origin", "http://localhost"}, {"Host", "localhost"}}), 200);
  EXPECT_EQ(status({{"Origin", "http://localhost:80"}, {"Host", "LOCALHOST"}}), 200);
  // Another port, scheme or name of this machine is another site.
  EXPECT_EQ(status({{"Origin", "http://127.0.0.1:5173"}}), 403);
  EXPECT_EQ(status({{"Origin", "http://127.0.0.1"}}), 403);
  EXPECT_EQ(status({{"Origin", "https://127.0.0.1:" + port}}), 403);
  EXPECT_EQ(status({{"Origin", "http://localhost:" + port}}), 403);
  EXPECT_EQ(status({{"Sec-Fetch-Site", "same-site"}, {"Sec-Fetch-Mode", "cors"}}), 403);
  EXPECT_EQ(status({{"Origin", "https://example.com"}}), 403);
  EXPECT_EQ(status({{"Origin", "null"}}), 403);
  EXPECT_EQ(status({{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "no-cors"}}), 403);
  EXPECT_EQ(status({{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "navigate"}}), 200);
  Raw old(service.port());
  old.Send("GET /healthz HTTP/1.1\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(old.Receive(), StartsWith("HTTP/1.1 400"));
}

class WithTokens : public testing::Test {
 protected:
  static HttpOptions Options(const Workbench& bench) {
    HttpOptions options;
    options.catalog = bench.catalog();
    options.allow_hosts = {"plenum.example"};
    return options;
  }
  int Get(const std::string& path, const std::string& token) {
    httplib::Headers headers = {{"Host", "plenum.example"}};
    if (!token.empty()) headers.emplace("Authorization", "Bearer " + token);
    return client_.Get(path, headers)->status;
  }
  int Post(const std::string& token) {
    return client_
        .Post("/v1/parts", {{"Authorization", "Bearer " + token}}, NewFitting("t").dump(), kJson)
        ->status;
  }

  const Workbench bench_;
  const std::filesystem::path file_ = TokenFile(bench_.catalog());
  Service service_{Options(bench_)};
  httplib::Client client_{"127.0.0.1", service_.port()};
};

TEST_F(WithTokens, EveryRequestNeedsOneButThoseThatGiveNothingAway) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  for (const char* path : {"/", "/healthz", "/readyz", "/openapi", "/openapi.json"})
    EXPECT_EQ(Get(path, ""), 200) << path;
  for (const char* path : {"/v1", "/v1/parts", "/v1/designs", "/metrics", "/v1/limits"}) {
    EXPECT_EQ(Get(path, ""), 401) << path;
    EXPECT_EQ(Get(path, "plenum_0"), 401) << path;
    EXPECT_EQ(Get(path, reader), 200) << path;
  }
  const auto refused = client_.Get("/v1/parts");
  EXPECT_THAT(refused->get_header_value("WWW-Authenticate"), StartsWith("Bearer"));
}

// RFC 9110, 11.1: the scheme is compared without case.
TEST_F(WithTokens, TheSchemeHasNoCase) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  for (const char* scheme : {"bearer ", "BEARER ", "Bearer  "})
    EXPECT_EQ(client_.Get("/v1", {{"Authorization", scheme + reader}})->status, 200) << scheme;
  EXPECT_EQ(client_.Get("/v1", {{"Authorization", "Basic " + reader}})->status, 401);
}

// Behind a proxy the page has its name, and the proxy's scheme.
TEST_F(WithTokens, ThePageOfANamedHostMayBeSecure) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  const auto status = [&](const std::string& origin, const std::string& host) {
    return client_
        .Get("/v1", {{"Authorization", "Bearer " + reader}, {"Origin", origin}, {"Host", host}})
        ->status;
  };
  EXPECT_EQ(status("https://plenum.example", "plenum.example"), 200);
  EXPECT_EQ(status("https://plenum.example:443", "Plenum.Example"), 200);
  EXPECT_EQ(status("https://plenum.example:8443", "plenum.example"), 403);
  EXPECT_EQ(status("https://other.example", "plenum.example"), 403);
}

// What is known goes on while the file cannot be read, and what changed counts when it can again.
TEST_F(WithTokens, AFileThatCannotBeReadForAMomentEndsNothing) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  EXPECT_EQ(Get("/v1", reader), 200);
  const std::string good = ReadAll(file_);
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);  // which no reader can read, whoever he is
  EXPECT_EQ(Get("/v1", reader), 200);
  EXPECT_EQ(Get("/v1", "plenum_0"), 401);
  std::filesystem::remove(file_);
  bench_.Write(file_.filename(), good);
  EXPECT_EQ(Get("/v1", reader), 200);
  EXPECT_TRUE(RevokeToken(file_, ReadTokens(file_).front().id));
  EXPECT_EQ(Get("/v1", reader), 401);
}

TEST_F(WithTokens, ScopesTellReadingFromWriting) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  const std::string writer = CreateToken(file_, "writer", Scope::kWrite);
  EXPECT_EQ(Post(reader), 403);
  EXPECT_EQ(Post(writer), 201);
  const auto history = client_.Get("/v1/parts/t/history", {{"Authorization", "Bearer " + reader}});
  EXPECT_EQ(JsonOf(history->body)["history"][0]["revision"]["who"], "writer");
}

// A body that is announced is not waited for where the head is enough for a refusal, and takes no
// place from others.
TEST_F(WithTokens, TheHeadIsJudgedBeforeTheBody) {
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  const std::string writer = CreateToken(file_, "writer", Scope::kWrite);
  const auto head = [](const std::string& what, const std::string& token,
                       const std::string& more = "Host: plenum.example\r\n") {
    return what + " HTTP/1.1\r\n" + more +
           (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") +
           "Content-Type: text/csv\r\nContent-Length: 20000000\r\nExpect: 100-continue\r\n\r\n";
  };
  const std::string import = "POST /v1/parts/import?family=tubing";
  std::vector<std::unique_ptr<Raw>> waiting;  // all open at once
  const auto status = [&](const std::string& bytes) {
    waiting.push_back(std::make_unique<Raw>(service_.port()));
    waiting.back()->Send(bytes);
    return waiting.back()->Receive("\r\n\r\n").substr(9, 3);
  };
  EXPECT_EQ(status(head(import, "")), "401");
  EXPECT_EQ(status(head(import, "plenum_0")), "401");
  EXPECT_EQ(status(head(import, reader)), "403");
  EXPECT_EQ(status(head(import, writer, "Host: rebound.example\r\n")), "403");
  EXPECT_EQ(status(head(import, writer, "Host: localhost\r\nOrigin: http://evil.example\r\n")),
            "403");
  EXPECT_EQ(status(head(import, writer, "")), "400");
  EXPECT_EQ(status(head(import, writer, "Host: localhost\r\nContent-Encoding: gzip\r\n")), "415");
  EXPECT_EQ(status(head(import, writer)), "100");
  EXPECT_EQ(status(head(import, writer)), "429");

  // The same for smaller bodies of every route.
  const auto announced = [&](const std::string& what, const std::string& token) {
    return what + " HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + token +
           "\r\nContent-Type: application/json\r\nContent-Length: 100\r\nExpect: "
           "100-continue\r\n\r\n";
  };
  for (const char* route :
       {"POST /v1/designs", "POST /v1/diagnoses", "POST /v1/simulations", "POST /v1/evaluations",
        "POST /v1/fmus", "POST /v1/maps", "POST /v1/catalog/update", "POST /v1/parts",
        "PUT /v1/parts/x", "DELETE /v1/parts/x", "POST /v1/models", "POST /v1/revisions/1/undo",
        "GET /v1/parts"}) {
    EXPECT_EQ(status(announced(route, "none")), "401") << route;
    EXPECT_EQ(status(announced(route, writer)), "100") << route;
  }
  EXPECT_EQ(status(announced("POST /v1/nothing", writer)), "404");
  EXPECT_EQ(status(announced("PATCH /v1/parts/x", writer)), "405");
}

TEST_F(WithTokens, ARevokedTokenEndsAtOnce) {
  const std::string text = CreateToken(file_, "a", Scope::kRead);
  CreateToken(file_, "b", Scope::kRead);
  EXPECT_EQ(Get("/v1", text), 200);
  EXPECT_TRUE(RevokeToken(file_, ReadTokens(file_).front().id));
  EXPECT_EQ(Get("/v1", text), 401);
  EXPECT_FALSE(RevokeToken(file_, "none"));
}

// A stream ends with its token; a request that was admitted is answered.
TEST_F(WithTokens, ARevokedTokenEndsItsStreams) {
  const std::string writer = CreateToken(file_, "writer", Scope::kWrite);
  const std::string reader = CreateToken(file_, "reader", Scope::kRead);
  const httplib::Headers headers = {{"Authorization", "Bearer " + writer}};
  const auto job = client_.Post("/v1/designs", headers, SlowToProve(120.0).dump(), kJson);
  ASSERT_EQ(job->status, 202);
  const std::string path = job->get_header_value("Location");
  Raw stream(service_.port());
  stream.Send("GET " + path + "/events HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
              reader + "\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(stream.Receive("event: progress"), HasSubstr("200 OK"));
  for (const Token& token : ReadTokens(file_))
    if (token.name == "reader") RevokeToken(file_, token.id);
  EXPECT_THAT(stream.Receive(), testing::Not(HasSubstr("event: end")));  // closed by the service
  const auto still = client_.Get(path, headers);
  EXPECT_EQ(JsonOf(still->body)["status"], "running");
  EXPECT_EQ(client_.Delete(path, headers)->status, 200);
}

TEST_F(WithTokens, TheFileHoldsNoTokens) {
  const std::string text = CreateToken(file_, "a", Scope::kRead);
  EXPECT_EQ(text.size(), 7u + 64u);
  EXPECT_EQ(ReadAll(file_).find(text.substr(7)), std::string::npos);
  struct stat status {};
  ASSERT_EQ(stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(Tokens, AreNeededForOtherAddresses) {
  const Workbench bench;
  const auto refused = bench.Run("serve --host 0.0.0.0 --port 0");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("token"));
  EXPECT_EQ(bench.Run("serve --allow-host example.org --port 0").status, 2);
  const auto made = bench.Run("token create me --scope write");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, StartsWith("plenum_"));
  const auto list = bench.Run("token list --json");
  EXPECT_THAT(list.out, HasSubstr("\"name\":\"me\",\"scope\":\"write\""));
  EXPECT_EQ(list.out.find(made.out.substr(7, 20)), std::string::npos);
  EXPECT_EQ(bench.Run("token revoke none").status, 2);
}

TEST(SlowClients, DoNotStopOthers) {
  Service service;
  std::vector<std::unique_ptr<Raw>> slow;
  for (int i = 0; i < 200; ++i) {
    slow.push_back(std::make_unique<Raw>(service.port()));
    slow.back()->Send(i % 2 == 0 ? "GET /healthz HTTP/1.1\r\nHost: loc"
                                 : "POST /v1/designs HTTP/1.1\r\nHost: localhost\r\n"
                                   "Content-Type: application/json\r\n"
                                   "Content-Length: 1000\r\n\r\n{");
  }
  httplib::Client client("127.0.0.1", service.port());
  client.set_read_timeout(5);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(client.Get("/healthz")->status, 200);
  slow[0]->Send(
      "alhost\r\nConnection: close\r\n\r\n");  // who is slow but within the limits is served
  EXPECT_THAT(slow[0]->Receive(), StartsWith("HTTP/1.1 200"));
}

TEST(SlowClients, ReadTheirAnswersWithoutAThread) {
  Service service;
  std::vector<std::unique_ptr<Raw>> idle;
  for (int i = 0; i < 64; ++i) {
    idle.push_back(std::make_unique<Raw>(service.port()));
    for (int k = 0; k < 20; ++k)
      idle.back()->Send("GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  httplib::Client client("127.0.0.1", service.port());
  client.set_read_timeout(5);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(client.Get("/healthz")->status, 200);
}

TEST(Connections, ServeRequestsThatComeAtOnce) {
  Service service;
  Raw raw(service.port());
  raw.Send(
      "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
      "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\n"
      "Content-Type: application/json\r\nContent-Length: 2\r\n"
      "\r\n{}GET /v1/none HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answers = raw.Receive();
  const auto first = answers.find("HTTP/1.1 200"), second = answers.find("HTTP/1.1 422");
  EXPECT_EQ(first, 0u);
  EXPECT_LT(first, second);
  EXPECT_LT(second, answers.find("HTTP/1.1 404")) << answers;
}

TEST(Connections, SayThatABodyMayCome) {
  Service service;
  Raw raw(service.port());
  raw.Send(
      "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\n"
      "Content-Type: application/json\r\nConnection: close\r\nContent-Length: 2\r\n\r\n");
  EXPECT_EQ(raw.Receive("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  raw.Send("{}");
  EXPECT_THAT(raw.Receive(), StartsWith("HTTP/1.1 422"));
}

TEST(Connections, AThousandClientsAreServed) {
  Service service;
  std::vector<std::unique_ptr<Raw>> clients;
  clients.reserve(1000);
  for (int i = 0; i < 1000; ++i) clients.push_back(std::make_unique<Raw>(service.port()));
  for (const auto& client : clients)
    client->Send("GET /v1/limits HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  for (const auto& client : clients) EXPECT_THAT(client->Receive(), StartsWith("HTTP/1.1 200"));
}

TEST(Log, HasALineForEachRequestAndNoSecrets) {
  const Workbench bench;
  std::string token = bench.Run("token create me").out;
  token.pop_back();  // the end of the line
  const std::string log = bench.Path("log");
  ServeProcess serve(bench.catalog(), {.log = log, .is_known_elsewhere = true});
  httplib::Client client("127.0.0.1", serve.port());
  const auto answer =
      client.Get("/v1/parts?manufacturer=secret", {{"Authorization", "Bearer " + token}});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(serve.End(SIGINT), 0);  // with its last line written
  const std::string lines = ReadAll(log);
  EXPECT_THAT(lines, HasSubstr("\"route\":\"/v1/parts\",\"status\":200"));
  EXPECT_THAT(lines, HasSubstr("\"user\":\"me\""));
  EXPECT_EQ(lines.find(token.substr(7, 20)), std::string::npos);
  EXPECT_EQ(lines.find("secret"), std::string::npos);
}

}  // namespace protection_test
}  // namespace plenum::server
