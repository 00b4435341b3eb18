// Saved model revisions: the document there and back, and rankings that name one.
#include "api/measure/model_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/verification.h"
#include "api/json/json.h"
#include "api/simulate/effects.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace model_document_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

const char* kDocument = R"({
  "schema": "model/1",
  "effects": [ { "id": "valve_delay", "parameters": { "delay_s": 0.02 } },
               { "id": "sensor_offset", "parameters": { "offset_kpa": 1.5 } } ],
  "factors": { "sonic_conductance": 1.03 },
  "covariance": { "parameters": [ "valve_delay.delay_s", "sonic_conductance" ],
                  "matrix": [ [ 1e-8, 0.0 ], [ 0.0, 1e-4 ] ] },
  "data": [ { "name": "bench.json", "sha256": "00ff" } ],
  "noise_kpa": 0.2, "before_rms_kpa": 3.0, "after_rms_kpa": 0.21, "holdout_rms_kpa": null })";

catalog::ModelRevision Saved(const std::string& document = kDocument) {
  return {"bench", 2, "2026-01-01T00:00:00Z", "me", document, std::string(64, 'a')};
}

TEST(ModelRevision, ReadsWhatItWrites) {
  const auto model = std::get<SavedModel>(ParseModel(Parse(kDocument)));
  EXPECT_EQ(model.effects[1].parameters, std::vector<double>{1500.0});
  EXPECT_EQ(model.factors.front().second, 1.03);
  EXPECT_EQ(model.before_rms_pa, 3000.0);
  EXPECT_FALSE(model.holdout_rms_pa);
  EXPECT_EQ(RenderModel(model), RenderModel(std::get<SavedModel>(ParseModel(RenderModel(model)))));
  EXPECT_EQ(RenderModel(model)["covariance"], Parse(kDocument)["covariance"]);
}

TEST(ModelRevision, OfATieSaysSoAndWarnsWhatIsRankedWithIt) {
  const Json tied = Json::parse(R"([["valve_delay", "sensor_offset"], ["leak"], ["creep"]])");
  const Json document = With(Parse(kDocument), "/tied", tied);
  EXPECT_EQ(RenderModel(std::get<SavedModel>(ParseModel(document)))["tied"], tied);
  EXPECT_FALSE(RenderModel(std::get<SavedModel>(ParseModel(Parse(kDocument)))).contains("tied"));
  const Json request = With(Requirements(), "/model", "bench");
  const auto parsed = std::get<DesignRequest>(
      ParseRequirements(request, SmallCatalogue(), {Saved(document.dump())}));
  ASSERT_THAT(parsed.remarks.warnings, SizeIs(1));
  EXPECT_EQ(parsed.remarks.warnings[0]["pointer"], "/model");
  EXPECT_THAT(parsed.remarks.warnings[0]["detail"], HasSubstr("leak, or creep would explain"));
}

TEST(ModelRevision, RefusesWhatMakesNoSense) {
  const auto detail = [](const char* pointer, const Json& value, const char* at) {
    return DetailAt(ErrorsOf(ParseModel(With(Parse(kDocument), pointer, value))), at);
  };
  EXPECT_THAT(detail("/schema", "model/2", "/schema"), HasSubstr("model/1"));
  EXPECT_THAT(detail("/covariance/matrix/1", Json::array({1.0}), "/covariance/matrix"),
              HasSubstr("a row and a column for each"));
  EXPECT_THAT(detail("/factors/sonic_conductance", -1, "/factors/sonic_conductance"),
              HasSubstr("> 0"));
  EXPECT_THAT(detail("/effects/0/id", "leek", "/effects/0/id"), HasSubstr("leak"));
  EXPECT_THAT(detail("/more", 1, "/more"), HasSubstr("unknown"));
  EXPECT_THAT(detail("/tied", Json::array({"leak"}), "/tied"), HasSubstr("lists of effects"));
  EXPECT_THAT(detail("/tied", Json::array({Json::array({1})}), "/tied"), HasSubstr("texts"));
}

TEST(ModelRevision, ARankingNamesOne) {
  const Json request = With(Requirements(), "/model", "bench");
  const auto unknown = ErrorsOf(ParseRequirements(request, SmallCatalogue()));
  EXPECT_THAT(DetailAt(unknown, "/model"), HasSubstr("available: nominal"));
  const auto parsed =
      std::get<DesignRequest>(ParseRequirements(request, SmallCatalogue(), {Saved()}));
  // The sensor's offset changes no actuator.
  ASSERT_THAT(parsed.problem.groups[0].effects, SizeIs(1));
  EXPECT_EQ(parsed.problem.groups[0].effects[0].spec->id, "valve_delay");
  EXPECT_EQ(parsed.model->version, 2);
  EXPECT_THAT(
      DetailAt(ErrorsOf(ParseRequirements(request, SmallCatalogue(), {Saved("{}")})), "/model"),
      HasSubstr("cannot be read"));
  const Json proof = With(request, "/ranking/proof", true);
  EXPECT_THAT(
      DetailAt(ErrorsOf(ParseRequirements(proof, SmallCatalogue(), {Saved()})), "/ranking/proof"),
      HasSubstr("nominal"));
}

TEST(ModelRevision, TheAnswerComparesWithTheNominalOne) {
  const std::filesystem::path root = test::SourceDir();
  const auto parts = catalog::Store(root / "catalog.db", catalog::Access::kRead).List();
  std::ifstream file(root / "examples/gripper.json");
  Json request = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
  request["model"] = "bench";
  request["ranking"] = {{"count", 2}, {"time_limit_s", 60}};
  request["supply"]["configurations"] = Json::array({"mains"});
  // A valve that closes late passes the operating pressure.
  for (Json& group : request["actuators"]) group["pressure_kpa_gauge_max"] = 500.0;
  const auto parsed = std::get<DesignRequest>(ParseRequirements(request, parts, {Saved()}));
  optimizer::SearchOptions options;
  double told = 0.0;  // the highest lower bound on the way
  options.progress = [&](const optimizer::Progress& progress) {
    told = std::max(told, progress.lower_bound);
  };
  const Json answer = AnswerRequest(parsed, options, parts);
  EXPECT_LE(told, answer["proof"]["lower_bound"].get<double>());
  EXPECT_EQ(answer["model"]["name"], "bench");
  EXPECT_EQ(answer["model"]["version"], 2);
  EXPECT_TRUE(answer["model"]["proved"]);
  ASSERT_THAT(answer["designs"], Not(IsEmpty()));
  const Json& rows = answer["against_nominal"]["designs"];
  ASSERT_EQ(rows.size(), answer["designs"].size());
  // A delay asks for more pressure, or drops what has none to give.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i]["nominal_rank"].is_null()) continue;
    EXPECT_GE(answer["designs"][i]["objective"], rows[i]["nominal"]["objective"]);
  }
  EXPECT_THAT(
      ErrorsOf(VerifyAnswer(With(answer, "/catalogue_revision", nullptr), SmallCatalogue(), {})),
      Not(IsEmpty()));
}

}  // namespace model_document_test
}  // namespace plenum::api
