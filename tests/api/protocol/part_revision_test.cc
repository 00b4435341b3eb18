// What a diagnosis writes into a part.
#include "api/protocol/part_revision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "api/catalogue/stores.h"
#include "tests/api/support.h"
#include "tests/catalog/folder.h"

namespace plenum::api {
namespace part_revision_test {

using Origin = catalog::Provenance;
using testing::HasSubstr;

constexpr const char* kField = "sonic_conductance_fill_dm3_per_s_bar";
const std::string kHash(64, 'a'), kOther(64, 'b');

Json Row(const char* field, double fitted, double uncertainty) {
  return {{"part", "valve-1"}, {"number", "n"},    {"field", field},
          {"declared", 0.3},   {"fitted", fitted}, {"uncertainty", uncertainty},
          {"refused", nullptr}};
}
Json Answer(Json rows) {
  return {{"measured", std::move(rows)}, {"measured_refused", Json::array()}};
}
std::vector<Provenance::File> Files(const std::string& hash = kHash) {
  return {{"recording.csv", hash}};
}

TEST(PartRevision, ANumberIsMeasuredFromThenOn) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField].provenance = Origin::kEstimated;
  const PartRevision revised =
      RevisePart(part, Answer(Json::array({Row(kField, 0.28, 0.01)})), Files(), false);
  ASSERT_TRUE(revised.part);
  const catalog::Number& number = revised.part->numbers.at(kField);
  EXPECT_DOUBLE_EQ(number.value, 0.28);
  EXPECT_EQ(number.provenance, Origin::kMeasured);
  EXPECT_DOUBLE_EQ(number.uncertainty.value(), 0.01);
  EXPECT_THAT(number.source, HasSubstr("recording.csv"));
  EXPECT_EQ(revised.part->origin, "user");  // so that new seed rows leave it alone
  ASSERT_EQ(revised.part->documents.size(), part.documents.size() + 1);
  EXPECT_EQ(revised.part->documents.back().sha256, kHash);
  EXPECT_EQ(revised.part->numbers.at("critical_ratio_fill"),
            part.numbers.at("critical_ratio_fill"));
}

// By hand: 0.30 ± 0.003 and 0.294 ± 0.00294.
TEST(PartRevision, TwoTestsCombineByTheirVariances) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField] = {0.30, Origin::kMeasured, "first", 0.01};
  const PartRevision revised =
      RevisePart(part, Answer(Json::array({Row(kField, 0.294, 0.01)})), Files(), false);
  ASSERT_TRUE(revised.part);
  const catalog::Number& number = revised.part->numbers.at(kField);
  const double w1 = 1.0 / (0.003 * 0.003), w2 = 1.0 / (0.00294 * 0.00294);
  EXPECT_NEAR(number.value, (0.30 * w1 + 0.294 * w2) / (w1 + w2), 1e-6);
  EXPECT_NEAR(*number.uncertainty, 1.0 / std::sqrt(w1 + w2) / number.value, 1e-4);
  EXPECT_EQ(revised.told["numbers"][0]["combined"], true);
}

TEST(PartRevision, AContradictionIsShownAndNotAveraged) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField] = {0.30, Origin::kMeasured, "first", 0.01};
  const Json answer = Answer(Json::array({Row(kField, 0.27, 0.01)}));
  const PartRevision refused = RevisePart(part, answer, Files(), false);
  EXPECT_FALSE(refused.part);
  EXPECT_THAT(refused.told["numbers"][0]["contradiction"].get<std::string>(),
              HasSubstr("more than the uncertainties"));
  const PartRevision anyway = RevisePart(part, answer, Files(), true);
  ASSERT_TRUE(anyway.part);
  EXPECT_DOUBLE_EQ(anyway.part->numbers.at(kField).value, 0.27);
  EXPECT_EQ(anyway.told["numbers"][0]["combined"], false);
  part.numbers[kField] = {0.30, Origin::kDatasheet, "sheet"};
  EXPECT_FALSE(RevisePart(part, answer, Files(), false).part);  // a sheet: 5 %
  part.numbers[kField].provenance = Origin::kEstimated;         // a rule: 25 %
  EXPECT_TRUE(RevisePart(part, answer, Files(), false).part);
}

constexpr const char* kRatio = "critical_ratio_fill";

// Not the number that contradicts a sheet, but the other one is written.
TEST(PartRevision, OneContradictionDoesNotBlockTheOthers) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField] = {0.30, Origin::kDatasheet, "sheet"};
  part.numbers[kRatio] = {0.30, Origin::kDatasheet, "sheet"};
  const Json answer = Answer(Json::array({Row(kField, 0.20, 0.01), Row(kRatio, 0.31, 0.01)}));
  const PartRevision revised = RevisePart(part, answer, Files(), false);
  ASSERT_TRUE(revised.part) << revised.told.dump();
  EXPECT_EQ(revised.part->numbers.at(kField), part.numbers.at(kField));
  EXPECT_DOUBLE_EQ(revised.part->numbers.at(kRatio).value, 0.31);
  EXPECT_EQ(revised.told["numbers"][0]["written"], false);
  EXPECT_EQ(revised.told["numbers"][1]["written"], true);
  ASSERT_EQ(revised.told["refused"].size(), 1u);
  EXPECT_THAT(revised.told["refused"][0].get<std::string>(), HasSubstr(kField));
  // What was left out can be written from the same recording, and what was written counts once.
  const PartRevision anyway = RevisePart(*revised.part, answer, Files(), true);
  ASSERT_TRUE(anyway.part) << anyway.told.dump();
  EXPECT_DOUBLE_EQ(anyway.part->numbers.at(kField).value, 0.20);
  EXPECT_EQ(anyway.part->numbers.at(kRatio), revised.part->numbers.at(kRatio));
  EXPECT_EQ(anyway.part->documents.size(), revised.part->documents.size());
}

// C 0.150 for 0.29 and b 0.31 for 0.22, of rules of the catalogue.
TEST(PartRevision, AnEstimateThatIsOffIsWrittenOverWithAWarning) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField] = {0.150, Origin::kEstimated, "rule"};
  part.numbers[kRatio] = {0.31, Origin::kEstimated, "rule"};
  const Json answer = Answer(Json::array({Row(kField, 0.29, 0.005), Row(kRatio, 0.22, 0.02)}));
  const PartRevision revised = RevisePart(part, answer, Files(), false);
  ASSERT_TRUE(revised.part) << revised.told.dump();
  EXPECT_TRUE(revised.told["refused"].empty());
  EXPECT_DOUBLE_EQ(revised.part->numbers.at(kField).value, 0.29);
  EXPECT_TRUE(revised.told["numbers"][0]["contradiction"].is_null());
  EXPECT_EQ(revised.told["numbers"][0]["warning"], "the estimate 0.15 was 48 % too low");
  EXPECT_EQ(revised.told["numbers"][1]["warning"], "the estimate 0.31 was 41 % too high");
  part.numbers[kField].value = 0.28;  // within 25 %
  EXPECT_TRUE(RevisePart(part, answer, Files(), false).told["numbers"][0]["warning"].is_null());
}

// By hand: A 0.30 ± 1 %, B 0.33 ± 1 %: mean 0.315, spread 0.0212, standard error 0.015.
TEST(PartRevision, PiecesOfATypeCombineWithTheirSpread) {
  catalog::Part part = PartOf("valve");
  part.numbers[kField].provenance = Origin::kEstimated;
  const auto test = [&](double fitted, const std::string& hash, const char* piece) {
    const PartRevision revised = RevisePart(part, Answer(Json::array({Row(kField, fitted, 0.01)})),
                                            Files(hash), false, piece);
    EXPECT_TRUE(revised.part) << revised.told.dump();
    if (revised.part) part = *revised.part;
    return revised.told;
  };
  test(0.30, std::string(64, 'a'), "A");
  EXPECT_DOUBLE_EQ(part.numbers.at(kField).uncertainty.value(), 0.01);
  const Json told = test(0.33, std::string(64, 'b'), "B");
  EXPECT_EQ(told["specimen"], "B");
  EXPECT_EQ(told["numbers"][0]["pieces"], 2);
  EXPECT_EQ(told["numbers"][0]["combined"], false);
  const double spread = 0.03 / std::sqrt(2.0), error = 0.015;
  EXPECT_DOUBLE_EQ(part.numbers.at(kField).value, 0.315);
  EXPECT_NEAR(*part.numbers.at(kField).uncertainty, std::hypot(spread, error) / 0.315, 1e-4);
  EXPECT_NEAR(told["numbers"][0]["spread"].get<double>(), spread / 0.315, 1e-9);
  EXPECT_EQ(part.documents.back().link, "recording.csv, piece B");
  EXPECT_THAT(part.numbers.at(kField).source, HasSubstr("\"A\" 0.3 ± 0.01; \"B\" 0.33 ± 0.01"));
  // A second test of A combines with that of A.
  EXPECT_EQ(test(0.302, std::string(64, 'c'), "A")["numbers"][0]["combined"], true);
  EXPECT_NEAR(part.numbers.at(kField).value, (0.300993 + 0.33) / 2.0, 1e-5);
  // A third one of A that is far off contradicts it.
  const PartRevision off = RevisePart(part, Answer(Json::array({Row(kField, 0.35, 0.01)})),
                                      Files(std::string(64, 'd')), false, "A");
  EXPECT_FALSE(off.part);
  // A value that was typed since is a test of a piece without a name.
  part.numbers[kField].value = 0.5;
  test(0.30, std::string(64, 'e'), "C");
  EXPECT_DOUBLE_EQ(part.numbers.at(kField).value, 0.4);
}

TEST(PartRevision, ACurveOfTwoPumpsIsTheirMean) {
  catalog::Part part = PartOf("compressor");
  part.curve->free_air_provenance = Origin::kEstimated;
  for (const auto& [piece, factor] : {std::pair{"one", 1.0}, std::pair{"two", 1.1}}) {
    Json rows = Json::array();
    const double fitted[] = {20.0, 12.0, 6.0};
    for (std::size_t i = 0; i < 3; ++i) {
      Json row = Row("free_air", factor * fitted[i], 0.01);
      row["part"] = part.id;
      row["pressure_kpa_gauge"] = part.curve->points[i].pressure_kpa_gauge;
      rows.push_back(row);
    }
    const std::string hash(64, piece[0] == 'o' ? 'a' : 'b');
    const PartRevision revised = RevisePart(part, Answer(rows), Files(hash), false, piece);
    ASSERT_TRUE(revised.part) << revised.told.dump();
    part = *revised.part;
  }
  EXPECT_DOUBLE_EQ(part.curve->points[1].free_air_l_per_min, 12.6);
  const double spread = 0.1 / std::sqrt(2.0) / 1.05;
  EXPECT_NEAR(part.curve->free_air_uncertainty.value(), std::hypot(spread, 0.05 / 1.05), 1e-4);
}

TEST(PartRevision, APieceHasAShortName) {
  EXPECT_EQ(WhyInvalidSpecimen("pump 2", "valve-1"), "");
  EXPECT_EQ(WhyInvalidSpecimen("", ""), "");
  EXPECT_THAT(WhyInvalidSpecimen("pump 2", ""), HasSubstr("no part"));
  EXPECT_THAT(WhyInvalidSpecimen(std::string(65, 'x'), "valve-1"), HasSubstr("64"));
  EXPECT_THAT(WhyInvalidSpecimen("a\nb", "valve-1"), HasSubstr("one line"));
}

TEST(PartRevision, WhatTheDiagnosisRefusesIsNotWritten) {
  Json answer = Answer(Json::array({Row(kField, 0.3, 0.01)}));
  answer["measured_refused"].push_back("the diagnosis is undecided");
  const PartRevision revised = RevisePart(PartOf("valve"), answer, Files(), true);
  EXPECT_FALSE(revised.part);
  EXPECT_EQ(revised.told["refused"][0], "the diagnosis is undecided");
  Json row = Row(kField, 0.3, 0.5);
  row["refused"] = "is known to 50 % only";
  EXPECT_FALSE(RevisePart(PartOf("valve"), Answer(Json::array({row})), Files(), true).part);
}

TEST(PartRevision, ARecordingCountsOnce) {
  catalog::Part part = PartOf("valve");
  part.documents.push_back({"recording.csv", kHash});
  const Json answer = Answer(Json::array({Row(kField, 0.3, 0.01)}));
  EXPECT_FALSE(RevisePart(part, answer, Files(), true).part);
  EXPECT_TRUE(RevisePart(part, answer, Files(kOther), true).part);
}

TEST(PartRevision, ACurveIsOneNumberAtAllItsPoints) {
  const catalog::Part part = PartOf("compressor");
  Json rows = Json::array();
  const double fitted[] = {25.0, 14.0, 6.6}, uncertainty[] = {0.01, 0.02, 0.03};
  for (std::size_t i = 0; i < 3; ++i) {
    Json row = Row("free_air", fitted[i], uncertainty[i]);
    row["part"] = part.id;
    row["pressure_kpa_gauge"] = part.curve->points[i].pressure_kpa_gauge;
    rows.push_back(row);
  }
  const PartRevision revised = RevisePart(part, Answer(rows), Files(), false);
  ASSERT_TRUE(revised.part) << revised.told.dump();
  EXPECT_DOUBLE_EQ(revised.part->curve->points[1].free_air_l_per_min, 14.0);
  EXPECT_EQ(revised.part->curve->points[1].current_a, 8.0);
  EXPECT_DOUBLE_EQ(revised.part->curve->free_air_uncertainty.value(), 0.03);
  EXPECT_EQ(revised.part->curve->free_air_provenance, Origin::kMeasured);
}

// A test of the protocol ends before the pump stalls: what it does not tell of the last point is no
// reason against the others, and of a point at which the pump delivers it is.
TEST(PartRevision, TheEndOfACurveWhereNothingIsDeliveredMayStayUnknown) {
  catalog::Part part = PartOf("compressor");
  part.curve->points[2].free_air_l_per_min = 0.0;
  Json rows = Json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    Json row = Row("free_air", i == 0 ? 25.0 : i == 1 ? 14.0 : 0.02, i == 2 ? 0.36 : 0.01);
    row["part"] = part.id;
    row["pressure_kpa_gauge"] = part.curve->points[i].pressure_kpa_gauge;
    row["interval_95"] = {0.006, 0.034};
    rows.push_back(row);
  }
  rows[2]["refused"] = "is known to 36 % only";
  const PartRevision revised = RevisePart(part, Answer(rows), Files(), false);
  ASSERT_TRUE(revised.part) << revised.told.dump();
  EXPECT_DOUBLE_EQ(revised.part->curve->points[1].free_air_l_per_min, 14.0);
  EXPECT_EQ(revised.part->curve->points[2].free_air_l_per_min, 0.0);
  EXPECT_DOUBLE_EQ(revised.part->curve->free_air_uncertainty.value(), 0.01);
  part.curve->points[2].free_air_l_per_min = 1.0;
  EXPECT_FALSE(RevisePart(part, Answer(rows), Files(), false).part);
}

// History and undo are the catalogue's.
using PartRevisionInStore = catalog::InFolder;
TEST_F(PartRevisionInStore, IsOneRevisionThatCanBeUndone) {
  catalog::Store store = Write();
  catalog::Part part = PartOf("valve");
  ASSERT_EQ(store.Add(part).status, catalog::WriteStatus::kDone);
  const Json answer = Answer(Json::array({Row(kField, 0.29, 0.01)}));
  const Json told =
      SavePart(store, part.id, answer, Files(), false, {.who = "ann", .key = "", .request = ""});
  ASSERT_TRUE(told["revision"].is_object()) << told.dump();
  EXPECT_DOUBLE_EQ(store.Get(part.id)->numbers.at(kField).value, 0.29);
  EXPECT_EQ(store.History(part.id, 1000, 10).size(), 2u);
  const auto number = told["revision"]["number"].get<std::int64_t>();
  EXPECT_EQ(store.Undo(number, {}).status, catalog::WriteStatus::kDone);
  EXPECT_EQ(store.Get(part.id)->numbers.at(kField), part.numbers.at(kField));
  EXPECT_FALSE(SavePart(store, "none", answer, Files(), false, {})["refused"].empty());
}

}  // namespace part_revision_test
}  // namespace plenum::api
