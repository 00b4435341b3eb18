// Answers of any size, however slowly they are read, and the order in which they come.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <thread>

#include "api/catalogue/part_document.h"
#include "catalog/fields/csv.h"
#include "catalog/store/store.h"
#include "server/call/service_limits.h"
#include "tests/server/raw.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace answers_test {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// More than all that connections may hold of requests, and than the system takes of an answer.
constexpr int kManyParts = 6000;

std::string FillCatalogue(const Workbench& bench) {
  api::Json document = NewFitting("x");
  document["notes"] = std::string(3900, 'n');
  catalog::Part part = std::get<catalog::Part>(api::ParsePart(document));
  catalog::Store store(bench.catalog(), catalog::Access::kWrite);
  const auto parts = [&](const catalog::TakeEach& take) {
    for (int i = 0; i < kManyParts; ++i) {
      part.id = "many-" + std::to_string(i);
      take(part);
    }
  };
  store.Import(parts, {"test", "", ""});
  return catalog::WriteCsv("fitting", store.List("fitting"));
}

TEST(Answers, ALongTableReachesSlowReadersByteForByte) {
  const Workbench bench;
  const std::string table = FillCatalogue(bench);
  ASSERT_GT(table.size(), kBufferedBytesMax);
  HttpOptions options;
  options.catalog = bench.catalog();
  Service service(options);
  std::vector<std::future<bool>> readers;
  readers.reserve(4);
  for (int i = 0; i < 4; ++i)
    readers.push_back(std::async(std::launch::async, [&, i] {
      httplib::Client client("127.0.0.1", service.port());
      std::string got;
      const auto answer =
          client.Get("/v1/parts/export?family=fitting", [&](const char* data, std::size_t size) {
            if (got.empty()) std::this_thread::sleep_for(i * 500ms);
            got.append(data, size);
            return true;
          });
      return answer && answer->status == 200 && got == table;
    }));
  for (auto& reader : readers) EXPECT_TRUE(reader.get());
}

// HTTP/1.0 knows no chunks: the end of the connection ends the table.
TEST(Answers, AnOldClientGetsATableWithoutChunks) {
  Service service;
  Raw raw(service.port());
  raw.Send("GET /v1/parts/export?family=fitting HTTP/1.0\r\nHost: localhost\r\n\r\n");
  const std::string answer = raw.Receive();
  EXPECT_THAT(answer, HasSubstr("Connection: close\r\n"));
  EXPECT_EQ(answer.find("chunked"), std::string::npos);
  const catalog::Store store(service.bench().catalog(), catalog::Access::kRead);
  EXPECT_THAT(answer, EndsWith("\r\n\r\n" + catalog::WriteCsv("fitting", store.List("fitting"))));
}

TEST(Answers, EveryRequestOfAPipelineIsAnswered) {
  Service service;
  Raw raw(service.port());
  std::string requests;
  constexpr int kRequests = 41;
  for (int i = 0; i < kRequests; ++i)
    requests.append("GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n")
        .append(i + 1 < kRequests ? "\r\n" : "Connection: close\r\n\r\n");
  raw.Send(requests);
  std::this_thread::sleep_for(200ms);  // the service can send no more meanwhile
  const std::string answers = raw.Receive("no such bytes");
  int count = 0;
  for (std::size_t at = 0; (at = answers.find("HTTP/1.1 200", at)) != std::string::npos; ++at)
    ++count;
  EXPECT_EQ(count, kRequests);
}

TEST(Answers, TheConnectionEndsWhenAnyOptionSaysSo) {
  Service service;
  const auto answer = [&](const std::string& fields) {
    Raw raw(service.port());
    raw.Send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    return raw.Receive("no such bytes");  // until it is closed
  };
  for (const char* fields : {"Connection: close\r\n", "Connection: x, Close\r\n",
                             "Connection: close,x\r\n", "Connection: x\r\nConnection: close\r\n"})
    EXPECT_THAT(answer(fields), HasSubstr("Connection: close\r\n")) << fields;
}

TEST(Answers, ATargetInAbsoluteFormNamesTheHost) {
  Service service;
  const auto status = [&](const std::string& target, const std::string& host) {
    Raw raw(service.port());
    raw.Send("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n");
    return raw.Receive().substr(9, 3);
  };
  EXPECT_EQ(status("http://localhost/healthz", "localhost"), "200");
  EXPECT_EQ(status("HTTP://127.0.0.1:8080/v1/parts?limit=1", "rebound.example"), "200");
  EXPECT_EQ(status("http://rebound.example/healthz", "localhost"), "403");
  EXPECT_EQ(status("http://localhost@rebound.example/healthz", "localhost"), "403");
  EXPECT_EQ(status("http://localhost?x", "localhost"), "200");
  EXPECT_EQ(status("ftp://localhost/healthz", "localhost"), "404");
}

// Who waits for a job, for its place or its turn, leaves all else alive.
TEST(Turns, WhoWaitsForAJobHoldsUpNobody) {
  HttpOptions options = OneJobAtATime();
  options.jobs.queued_max = options.jobs.queued_per_client_max = 100;
  Service service(options);
  httplib::Client client("127.0.0.1", service.port());
  ASSERT_EQ(client.Post("/v1/designs", SlowToProve(120.0).dump(), "application/json")->status, 202);
  // Large requests, of which one is read at a time, that wait for their job.
  const std::string body = Exosuit(1.0).dump() + std::string(kLargeBodyBytes, ' ');
  std::vector<std::unique_ptr<Raw>> waiting;
  for (std::size_t i = 0; i < kRequestThreads + 8; ++i) {
    waiting.push_back(std::make_unique<Raw>(service.port()));
    waiting.back()->Send(
        "POST /v1/designs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        "Prefer: wait=60\r\nContent-Length: " +
        std::to_string(body.size()) + "\r\n\r\n" + body);
  }
  httplib::Client other("127.0.0.1", service.port());
  other.set_read_timeout(20);
  other.Get("/v1/parts?limit=500");  // when all of them have been read
  other.set_read_timeout(5);
  for (int i = 0; i < 10; ++i) {
    const auto page = other.Get("/v1/parts?limit=500");
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200) << page->body;
    EXPECT_EQ(other.Get("/healthz")->status, 200);
  }
}

TEST(Results, AreStoredBytesWithATag) {
  Service service;
  httplib::Client client("127.0.0.1", service.port());
  client.set_read_timeout(60);
  const auto waited =
      client.Post("/v1/designs", {{"Prefer", "wait=60"}}, Exosuit(1.0).dump(), "application/json");
  ASSERT_EQ(waited->status, 200) << waited->body;
  const std::string path = waited->get_header_value("Location");
  const auto first = client.Get(path);
  const std::string tag = first->get_header_value("ETag");
  EXPECT_THAT(tag, StartsWith("\""));
  EXPECT_EQ(JsonOf(first->body)["result"], JsonOf(waited->body));
  EXPECT_EQ(JsonOf(first->body)["links"]["self"], path);
  // The very bytes of the result.
  EXPECT_THAT(first->body, HasSubstr(waited->body.substr(0, waited->body.size() - 1)));
  EXPECT_EQ(client.Get(path)->body, first->body);
  const auto known = client.Get(path, {{"If-None-Match", "W/" + tag}});
  EXPECT_EQ(known->status, 304);
  EXPECT_EQ(known->body, "");
  EXPECT_EQ(known->get_header_value("ETag"), tag);
}

TEST(Results, OfAJobThatIsDoneAgainHaveAnotherTag) {
  Service service;
  httplib::Client client("127.0.0.1", service.port());
  const auto posted = client.Post("/v1/designs", SlowToProve(120.0).dump(), "application/json");
  const std::string path = posted->get_header_value("Location");
  EXPECT_EQ(client.Get(path)->get_header_value("ETag"), "");
  const auto cancel = [&] {
    client.Delete(path);
    while (JsonOf(client.Get(path)->body)["status"] != "cancelled")
      std::this_thread::sleep_for(10ms);
    return client.Get(path)->get_header_value("ETag");
  };
  const std::string tag = cancel();
  EXPECT_NE(tag, "");
  EXPECT_EQ(client.Post(path + "/again", "", "application/json")->status, 202);
  EXPECT_NE(cancel(), tag);
}

}  // namespace answers_test
}  // namespace plenum::server
