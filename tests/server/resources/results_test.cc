// Results of jobs as bytes: with entity tags, and in gzip for clients that take it.
#include <gtest/gtest.h>
#include <httplib.h>

#include "fmu/unit_file.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace results_test {

using api::Json;

class ResultsInGzip : public ::testing::Test {
 protected:
  ResultsInGzip() {
    client_.set_decompress(false);
    client_.set_read_timeout(320);
  }
  httplib::Result Get(const std::string& path, const httplib::Headers& headers) {
    return client_.Get(path, headers);
  }
  // Where a job stands that has ended.
  std::string Done() {
    const auto answer =
        client_.Post("/v1/designs", {{"Prefer", "wait=60"}, {"Accept-Encoding", ""}},
                     Exosuit(5.0).dump(), "application/json");
    EXPECT_EQ(answer->status, 200) << answer->body;
    return answer->get_header_value("Location");
  }

  const Service service_;
  httplib::Client client_{"127.0.0.1", service_.port()};
};

TEST_F(ResultsInGzip, AreCompressedForWhoTakesGzip) {
  const std::string path = Done();
  const auto plain = Get(path, {{"Accept-Encoding", "identity"}});
  ASSERT_EQ(plain->status, 200);
  EXPECT_FALSE(plain->has_header("Content-Encoding"));
  EXPECT_EQ(plain->get_header_value("Vary"), "Accept-Encoding");
  const auto zipped = Get(path, {{"Accept-Encoding", "gzip"}});
  ASSERT_EQ(zipped->status, 200);
  EXPECT_EQ(zipped->get_header_value("Content-Encoding"), "gzip");
  EXPECT_EQ(zipped->get_header_value("Vary"), "Accept-Encoding");
  EXPECT_LT(zipped->body.size(), plain->body.size() / 2);
  // The other representation has another tag; the client's own reader gives the same text.
  EXPECT_NE(zipped->get_header_value("ETag"), plain->get_header_value("ETag"));
  client_.set_decompress(true);
  EXPECT_EQ(Get(path, {{"Accept-Encoding", "gzip"}})->body, plain->body);
  EXPECT_EQ(JsonOf(plain->body)["status"], "done");
  for (const auto* answer : {&plain, &zipped}) {
    const std::string tag = (*answer)->get_header_value("ETag");
    const auto known = Get(path, {{"Accept-Encoding", "gzip"}, {"If-None-Match", tag}});
    EXPECT_EQ(known->status, 304);
    EXPECT_EQ(known->get_header_value("ETag"), tag);
    EXPECT_EQ(known->body, "");
  }
  const auto head = client_.Head(path, {{"Accept-Encoding", "gzip"}});
  EXPECT_EQ(head->get_header_value("Content-Length"), std::to_string(zipped->body.size()));
}

TEST_F(ResultsInGzip, OfWhoWaitedAreCompressed) {
  const std::string request = Exosuit(5.0).dump();
  const auto zipped =
      client_.Post("/v1/designs", {{"Prefer", "wait=60"}, {"Accept-Encoding", "gzip"}}, request,
                   "application/json");
  ASSERT_EQ(zipped->status, 200);
  EXPECT_EQ(zipped->get_header_value("Content-Encoding"), "gzip");
  EXPECT_EQ(zipped->get_header_value("Preference-Applied"), "wait=60");
}

// The contract's way to a unit: of a job, by the rank of a design.
TEST_F(ResultsInGzip, GiveTheUnitOfADesign) {
  const std::string path = Done();
  EXPECT_EQ(Get(path + "/9/fmu", {})->status, 404);
  EXPECT_EQ(Get(path + "/x/fmu", {})->status, 404);
  EXPECT_EQ(Get(path + "/1/2/fmu", {})->status, 404);
  EXPECT_EQ(Get("/v1/designs/none/1/fmu", {})->status, 404);
  if (!fmu::MakesUnits()) return;
  const auto unit = Get(path + "/1/fmu", {});
  ASSERT_EQ(unit->status, 200) << unit->body;
  EXPECT_EQ(unit->get_header_value("Content-Type"), "application/octet-stream");
  const Json result = JsonOf(Get(path, {{"Accept-Encoding", ""}})->body)["result"];
  const Json evaluation = {{"schema", "evaluation/1"},
                           {"requirements", result["requirements"]},
                           {"design", result["designs"][0]}};
  const auto posted = client_.Post("/v1/fmus", evaluation.dump(), "application/json");
  EXPECT_EQ(unit->body.substr(0, 2), "PK");
  EXPECT_EQ(unit->body.size(), posted->body.size());
}

TEST(Results, OfAJobThatWaitsGiveNoUnit) {
  Service service(OneJobAtATime());
  httplib::Client client("127.0.0.1", service.port());
  client.Post("/v1/designs", SlowToProve(60.0).dump(), "application/json");
  const auto waits = client.Post("/v1/designs", SlowToProve(60.0).dump(), "application/json");
  ASSERT_EQ(waits->status, 202) << waits->body;
  EXPECT_EQ(client.Get(waits->get_header_value("Location") + "/1/fmu")->status, 409);
}

}  // namespace results_test
}  // namespace plenum::server
