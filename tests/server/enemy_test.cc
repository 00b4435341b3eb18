// Requests as an enemy would write them. Whatever comes, the service answers with a problem
// document that names the place, and goes on. PLENUM_ENEMY_ROUNDS makes more of them.
#include "tests/server/enemy.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <cstdlib>
#include <map>

#include "api/describe/catalogue_answers.h"
#include "api/describe/descriptions.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace enemy_test {

using api::Json;

constexpr char kJson[] = "application/json";

int Rounds() {
  const char* rounds = std::getenv("PLENUM_ENEMY_ROUNDS");
  return rounds == nullptr ? 1 : std::atoi(rounds);
}

class Enemy : public testing::Test {
 protected:
  Enemy() : client_("127.0.0.1", service_.port()) {
    client_.set_keep_alive(true);
    client_.set_tcp_nodelay(true);
    client_.set_read_timeout(60);
  }

  // 4xx, a problem document, and where there is a pointer, an error there.
  void ExpectRefused(const httplib::Result& result, const std::string& what,
                     const std::string& pointer) {
    ++sent_;
    ASSERT_TRUE(result) << what.substr(0, 2000);
    EXPECT_GE(result->status, 400) << pointer << " " << what.substr(0, 2000);
    EXPECT_LT(result->status, 500) << result->body << what.substr(0, 2000);
    EXPECT_EQ(result->get_header_value("Content-Type"), "application/problem+json");
    const Json body = JsonOf(result->body);
    EXPECT_EQ(body.value("status", 0), result->status);
    if (pointer.empty()) return;
    const Json errors = body.value("errors", Json::array());
    for (const Json& error : errors) {
      const auto at = error["pointer"].get<std::string>();
      if (at == pointer || at.starts_with(pointer + "/")) return;
      // What does not belong where it stands is refused as a whole.
      const auto detail = error["detail"].get<std::string>();
      const bool whole = detail.starts_with("unknown field") || detail.starts_with("give either");
      if (whole && pointer.starts_with(at + "/")) return;
    }
    const Json document = JsonOf(what);
    const Json::json_pointer place(pointer);
    ADD_FAILURE() << "no error at " << pointer << " for "
                  << (document.contains(place) ? document[place].dump() : "nothing") << ": "
                  << result->body.substr(0, 900);
  }

  void PostBad(const std::string& path, const std::vector<BadDocument>& documents) {
    // Rounds beyond the first send all of them.
    const std::size_t stride = Rounds() > 1 ? 1 : 2;
    for (std::size_t i = 0; i < documents.size(); i += stride) {
      const BadDocument& bad = documents[i];
      ExpectRefused(client_.Post(path, bad.text, kJson), bad.text, bad.pointer);
      if (HasFailure() && ++failures_ > 20) return;
    }
  }

  Service service_;
  httplib::Client client_;
  int sent_ = 0, failures_ = 0;
};

struct Target {
  const char* path;
  Json schema, example;
};

std::vector<Target> Targets() {
  return {{"/v1/designs", api::DescribeRequirements(), api::ExampleRequirements()},
          {"/v1/diagnoses", api::DescribeMeasurement(), api::ExampleMeasurement()},
          {"/v1/simulations", api::DescribeSimulation(), api::ExampleSimulation()},
          {"/v1/maps", api::DescribeMap(), api::ExampleMap()}};
}

TEST_F(Enemy, EveryFieldOfEveryDocumentIsChecked) {
  std::mt19937 random(20260101);
  for (int round = 0; round < Rounds(); ++round)
    for (const Target& target : Targets()) {
      PostBad(target.path, BadDocuments(target.schema, target.example, random));
      for (unsigned turn = 0; turn < 3; ++turn) {
        Json full = FullDocument(target.schema, turn);
        // A run's own rig covers the fields of the shared one.
        if (full.contains("runs")) full["runs"][0].erase("rig");
        // Of two fields that exclude each other one is read: now this, now that.
        for (const char* place : {"", "/runs/0", "/actuators/0"})
          if (const Json::json_pointer at(place); turn == 1 && full.contains(at))
            full[at].erase("valve");
        for (const char* place : {"/rig", "/runs/0/rig"})
          if (const Json::json_pointer at(place); full.contains(at))
            full[at].erase(turn == 1 ? "actuator" : "chambers");
        if (const Json::json_pointer at("/runs/0/channels"); turn != 1 && full.contains(at))
          full[at].erase("chambers");
        PostBad(target.path, BadDocuments(target.schema, full, random));
      }
    }
  RecordProperty("sent", sent_);
  EXPECT_GE(sent_, 5000);
  EXPECT_EQ(client_.Get("/healthz")->status, 200);
  EXPECT_TRUE(JsonOf(client_.Get("/v1/designs")->body)["jobs"].empty());
}

TEST_F(Enemy, EveryFieldOfAPartIsChecked) {
  std::mt19937 random(20260102);
  const Json families = api::DescribePart()["oneOf"];
  for (const Json& family : families)
    PostBad("/v1/parts", BadDocuments(family, FullDocument(family, 0), random));
  EXPECT_GE(sent_, 200);
}

TEST_F(Enemy, EveryFilterIsChecked) {
  const Json filters = api::DescribePartFilters();
  for (const Json& filter : filters) {
    const auto name = filter["name"].get<std::string>();
    const Json type = filter["schema"].value("type", Json());
    std::vector<std::string> values;
    if (type == "number" || type == "integer")
      values = {"x", "", "nan", "inf", "1e999", "0x10", "1 ", "--1", "1,5", "%00"};
    if (type == "boolean") values = {"x", "", "1", "TRUE"};
    if (name == "family" || name == "sort") values = {"wheels", "-", "mass_kg'"};
    if (name == "cursor") values = {"x", "1", "-1.x", "99999999999999999999.x"};
    const auto with = [&](const std::string& value) { return std::string(name) + '=' + value; };
    for (const auto& value : values)
      ExpectRefused(client_.Get("/v1/parts?" + with(value)), with(value), "/" + name);
    const std::string twice = "/v1/parts?" + with("1&" + with("2"));
    ExpectRefused(client_.Get(twice), twice, "/" + name);
  }
  EXPECT_GE(sent_, 500);
}

// Texts that parsers of JSON disagree on or fall over, after the JSONTestSuite of Nicolas Seriot.
TEST_F(Enemy, WhatIsNotJsonIsRefused) {
  std::vector<std::string> texts = {"",
                                    " ",
                                    "[",
                                    "]",
                                    "{",
                                    "}",
                                    "[1,]",
                                    "[,1]",
                                    "[1,,2]",
                                    "{\"a\":1,}",
                                    "{,}",
                                    "{\"a\"}",
                                    "{\"a\":}",
                                    "{a:1}",
                                    "{'a':1}",
                                    "{\"a\":1 \"b\":2}",
                                    "[1 2]",
                                    "[1",
                                    "[\"a",
                                    "\"",
                                    "\"\\",
                                    "nul",
                                    "nulll",
                                    "True",
                                    "NaN",
                                    "Infinity",
                                    "-Infinity",
                                    "+1",
                                    "01",
                                    "-01",
                                    "-",
                                    "1.",
                                    ".5",
                                    "1e",
                                    "1e+",
                                    "0x1",
                                    "1_0",
                                    "[1e]",
                                    "--1",
                                    "1-",
                                    "[\"\\x\"]",
                                    "[\"\\u12\"]",
                                    "[\"\\uD800\\u\"]",
                                    "[\"\t\"]",
                                    "[\"\n\"]",
                                    std::string("[\"\0\"]", 5),
                                    std::string("{}\0", 3),
                                    "{}{}",
                                    "{} x",
                                    "/**/{}",
                                    "{}//",
                                    "{\"a\":1,\"a\":2}",
                                    "\xEF\xBB\xBF{",
                                    std::string("\xFF\xFE{\0}", 5),
                                    "[\"\xFF\"]",
                                    "[\"\xC0\xAF\"]",
                                    "[\"\xED\xA0\x80\"]",
                                    "[1e400]",
                                    "[-1e400]",
                                    std::string(100000, '['),
                                    std::string(100000, '{'),
                                    "[" + std::string(100000, ' '),
                                    std::string(65, '[') + std::string(65, ']')};
  std::string nested;
  for (int i = 0; i < 20000; ++i) nested += "{\"a\":[";
  texts.push_back(nested);
  for (const char* path :
       {"/v1/designs", "/v1/diagnoses", "/v1/simulations", "/v1/maps", "/v1/parts", "/v1/models"})
    for (const std::string& text : texts) {
      const auto result = client_.Post(path, text, kJson);
      ExpectRefused(result, text, "");
      EXPECT_EQ(result ? result->status : 0, 400) << path << text.substr(0, 100);
    }
}

TEST_F(Enemy, BytesAtRandomAreRefused) {
  std::mt19937 random(20260103);
  const std::string seed = api::ExampleRequirements().dump();
  for (int i = 0; i < 500 * Rounds(); ++i) {
    std::string text = seed;
    for (int flips = 0; flips < 3; ++flips)
      text[random() % text.size()] = static_cast<char>(random());
    const auto result = client_.Post("/v1/designs?validate_only=true", text, kJson);
    ASSERT_TRUE(result);
    EXPECT_LT(result->status, 500) << text;
  }
}

TEST_F(Enemy, RowsOfCsvAreChecked) {
  std::mt19937 random(20260104);
  const std::string csv = client_.Get("/v1/parts/export?family=valve")->body;
  const std::string path = "/v1/parts/import?dry_run=true&family=valve";
  for (int i = 0; i < 300 * Rounds(); ++i) {
    std::string text = csv.substr(0, csv.find('\n', 2000) + 1);
    for (int flips = 0; flips < 3; ++flips)
      text[random() % text.size()] = static_cast<char>(random());
    const auto result = client_.Post(path, text, "text/csv");
    ASSERT_TRUE(result);
    EXPECT_LT(result->status, 500) << text;
  }
}

TEST_F(Enemy, PathsAreChecked) {
  for (const char* path :
       {"/v1/parts/%00", "/v1/parts/%2e%2e%2f", "/v1/parts/..%2f..%2fetc%2fpasswd",
        "/../etc/passwd", "/assets/..%2findex.html", "/v1/revisions/-1", "/v1/revisions/1e3",
        "/v1/designs/%ff", "/v1/designs/a/events", "/v1/models/%20", "//", "/v1/parts/"}) {
    client_.set_url_encode(false);
    ExpectRefused(client_.Get(path), path, "");
  }
}

}  // namespace enemy_test
}  // namespace plenum::server
