// The catalogue over HTTP.
#include <map>

#include "catalog/fields/fields.h"
#include "server/http.h"
#include "tests/server/http_client.h"

namespace plenum::server {
namespace http_catalog_test {

using api::Json;
using testing::HasSubstr;
using testing::StartsWith;

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

TEST_F(Http, SearchesInTheRevisionThatIsAskedFor) {
  const auto ids = [&](const std::string& query) {
    std::vector<std::string> all;
    const Json page = Body(client_->Get("/v1/parts?" + query));
    for (const Json& part : page["parts"]) all.push_back(part["id"]);
    return all;
  };
  const Json before = Body(client_->Get("/v1/parts?limit=1"))["catalogue_revision"]["number"];
  Json part = NewFitting("odd-one");
  part["notes"] = "An oddment";
  ASSERT_EQ(client_->Post("/v1/parts", part.dump(), kJson)->status, 201);
  EXPECT_EQ(ids("q=oddment"), std::vector<std::string>{"odd-one"});
  EXPECT_EQ(ids("q=oddment&revision=" + before.dump()), std::vector<std::string>{});
  part["notes"] = "A thing";
  ASSERT_EQ(client_->Put("/v1/parts/odd-one", {{"If-Match", "*"}}, part.dump(), kJson)->status,
            200);
  EXPECT_EQ(ids("q=oddment"), std::vector<std::string>{});
  EXPECT_EQ(ids("q=thing%20odd"), std::vector<std::string>{"odd-one"});
  // Any bytes are text.
  for (const char* text : {"%22", "%27%3B--", "NEAR(a+b", "a*+OR", "%FF%C3", "%00", "^a", "a:b"}) {
    const auto answer = client_->Get(std::string("/v1/parts?facets=true&q=") + text);
    ASSERT_TRUE(answer) << text;
    EXPECT_EQ(answer->status, 200) << text << answer->body;
  }
}

TEST_F(Http, SaysWhatItUnderstoodOfAPart) {
  Json part = NewFitting("f");
  part["mass_kg"] = "3 g";
  part["sonic_conductance_dm3_per_s_bar"] = {{"orifice_mm", 2}};
  const auto added = client_->Post("/v1/parts", part.dump(), kJson);
  ASSERT_EQ(added->status, 201) << added->body;
  const Json answer = Body(added);
  ASSERT_EQ(answer["understood"].size(), 2u) << answer;
  for (const Json& one : answer["understood"]) {
    const auto field = one["pointer"].get<std::string>().substr(1);
    EXPECT_EQ(one["given"], part[field]);
    EXPECT_EQ(one["value"], answer[field]);
    EXPECT_EQ(one.contains("formula"), field != "mass_kg");
  }
  const Json kept = Body(client_->Get("/v1/parts/f"));
  EXPECT_FALSE(kept.contains("understood"));
  EXPECT_EQ(kept["mass_kg"], 0.003);
  // The answer goes back as it is.
  const auto put = client_->Put("/v1/parts/f", {{"If-Match", added->get_header_value("ETag")}},
                                answer.dump(), kJson);
  EXPECT_EQ(put->status, 200) << put->body;
  EXPECT_FALSE(Body(put).contains("understood"));
}

TEST_F(Http, ComparesParts) {
  Json heavy = NewFitting("g");
  heavy["mass_kg"] = 0.5;
  for (const Json& part : {NewFitting("f"), heavy})
    ASSERT_EQ(client_->Post("/v1/parts", part.dump(), kJson)->status, 201);
  const Json comparison = Body(client_->Get("/v1/parts/compare?ids=g,f"));
  EXPECT_EQ(comparison["parts"][0]["id"], "g");
  int differing = 0;
  for (const Json& field : comparison["fields"]) differing += field["differs"].get<bool>();
  EXPECT_GE(differing, 1);
  EXPECT_EQ(client_->Get("/v1/parts/compare")->status, 422);
  EXPECT_EQ(client_->Get("/v1/parts/compare?ids=f,none")->status, 404);
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

TEST_F(Http, ImportAsksWhatAForeignTableLeavesOpen) {
  const std::string table = "Hersteller;Modell;Stations;Weight [g]\nFesto;VX-9;4;1,234\n";
  const std::string path = "/v1/parts/import?family=manifold&dry_run=true";
  const auto asked = client_->Post(path, table, "text/csv");
  ExpectProblem(asked, 422, "/decimal/Weight [g]");
  EXPECT_EQ(Body(asked)["questions"][0]["option"], "decimal");
  EXPECT_EQ(Body(asked)["understood"]["columns"][3]["targets"][0], "mass_kg [g]");
  const auto read = client_->Post(path + "&decimal=comma", table, "text/csv");
  ASSERT_EQ(read->status, 200) << read->body;
  EXPECT_EQ(Body(read)["added"], Json::array({"festo-vx-9"}));
  EXPECT_EQ(Body(read)["understood"]["delimiter"], "semicolon");
  // Of two columns one is left out, and all rows share what no column says.
  const auto answered =
      client_->Post(path + "&column=A%3Dstations&column=B%3D&set=manufacturer%3DMe",
                    "Model;A;B\nx;4;7\n", "text/csv");
  ASSERT_EQ(answered->status, 200) << answered->body;
  EXPECT_EQ(Body(answered)["added"], Json::array({"me-x"}));
  ExpectProblem(client_->Post(path + "&decimal=dot", table, "text/csv"), 422, "/decimal");
  ExpectProblem(client_->Post(path + "&header_row=x", table, "text/csv"), 422, "/header_row");
}

TEST_F(Http, CheckCountsWhatTheCatalogueHolds) {
  const auto check = Body(client_->Get("/v1/parts/check"));
  int parts = 0;
  for (const Json& family : check["families"]) parts += family["parts"].get<int>();
  EXPECT_EQ(parts, check["parts"]);
  EXPECT_TRUE(check["duplicates"].is_array());
  EXPECT_TRUE(check["catalogue_revision"].contains("hash"));
}

TEST_F(Http, FamiliesNameTheirFields) {
  const Json families = Body(client_->Get("/v1/families"))["families"];
  EXPECT_EQ(families.size(), catalog::Families().size());
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

}  // namespace http_catalog_test
}  // namespace plenum::server
