// "save_part" of POST /v1/diagnoses: measured numbers into the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <string>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/measurement.h"
#include "tests/server/service.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace save_part_test {

using api::Json;
using testing::HasSubstr;

constexpr const char* kPart = "generic-lp-small-200kpa";

// The tutorial's recording.
Json Recording() {
  const auto folder = test::SourceDir() / "examples";
  const Json rig = JsonOf(ReadAll(folder / "bottle_test_rig.json"));
  return std::get<Json>(
      api::MeasurementFromCsv(ReadAll(folder / "bottle_test_simulated.csv"), rig));
}

class SavePart : public testing::Test {
 protected:
  SavePart() { client_.set_read_timeout(320); }
  httplib::Result Post(const Json& document) {
    return client_.Post("/v1/diagnoses", {{"Prefer", "wait=300"}}, document.dump(),
                        "application/json");
  }
  Json Part(const std::string& query = "") {
    return JsonOf(client_.Get(std::string("/v1/parts/") + kPart + query)->body);
  }

 private:
  const Service service_;

 protected:
  httplib::Client client_{"127.0.0.1", service_.port()};
};

TEST_F(SavePart, WritesOneRevisionThatTheHistoryHas) {
  Json document = Recording();
  document["time_limit_s"] = 600;  // sanitizers are slow
  document["save_part"] = kPart;
  const std::size_t changes = Part("/history")["history"].size();
  const auto reply = Post(document);
  ASSERT_EQ(reply->status, 200) << reply->body;
  const Json answer = JsonOf(reply->body);
  EXPECT_EQ(answer["measured"].size(), 2u);
  ASSERT_TRUE(answer["saved_part"]["revision"].is_object()) << answer["saved_part"].dump();
  const Json part = Part();
  EXPECT_EQ(part["provenance"]["sonic_conductance_dm3_per_s_bar"]["kind"], "measured");
  EXPECT_EQ(part["documents"].size(), 1u);
  EXPECT_EQ(Part("/history")["history"].size(), changes + 1u);
  // With the recording as it was sent.
  const Json kept = Part("/documents")["documents"][0]["file"];
  ASSERT_TRUE(kept.is_object());
  EXPECT_EQ(client_.Get(kept["href"].get<std::string>())->body, document.dump());
}

TEST_F(SavePart, IsRefusedBeforeTheWorkWhereNothingIsMeasured) {
  Json document = Recording();
  document["save_part"] = "smc-tia01";
  auto reply = Post(document);
  EXPECT_EQ(reply->status, 422);
  EXPECT_THAT(reply->body, HasSubstr("/save_part"));
  document["save_part"] = kPart;
  document["rig"]["line"]["elements"][0]["part"] = "no such part";
  reply = Post(document);
  EXPECT_EQ(reply->status, 422);
  EXPECT_THAT(reply->body, HasSubstr("/rig/line/elements/0/part"));
}

}  // namespace save_part_test
}  // namespace plenum::server
