// Parts of the catalogue in the rig of a measurement, and what is measured of them.
#include "api/measure/rig_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/describe/descriptions.h"
#include "api/measure/measurement.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace rig_parts_test {

using calibration::MeasuredNumber;
using testing::HasSubstr;

Json WithElement(Json element) {
  Json document = ExampleMeasurement();
  document["rig"]["line"] = {{"elements", Json::array({std::move(element)})}};
  return document;
}

calibration::Dataset Read(const Json& document) {
  Errors errors;
  const Json filled = WithParts(document, SmallCatalogue(), errors);
  EXPECT_TRUE(errors.empty());
  const auto parsed = ParseMeasurement(filled);
  for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<calibration::Dataset>(parsed);
}

Errors Refused(const Json& document) {
  Errors errors;
  const Json filled = WithParts(document, SmallCatalogue(), errors);
  if (!errors.empty()) return errors;
  return ErrorsOf(ParseMeasurement(filled));
}

TEST(RigParts, AValveBringsItsPairsAndSaysWhatIsMeasured) {
  const auto dataset = Read(WithElement(
      {{"part", "valve-1"}, {"measure", {"sonic_conductance_fill", "critical_ratio_exhaust"}}}));
  ASSERT_EQ(dataset.runs[0].line.size(), 1u);
  EXPECT_DOUBLE_EQ(dataset.runs[0].line[0].fill.sonic_conductance_m3_per_s_pa, 0.3e-8);
  EXPECT_DOUBLE_EQ(dataset.runs[0].line[0].exhaust.critical_ratio, 0.3);
  ASSERT_EQ(dataset.measured.size(), 2u);
  EXPECT_EQ(dataset.measured[0].name, "sonic_conductance_fill");
  EXPECT_EQ(dataset.measured[0].part, "valve-1");
  EXPECT_DOUBLE_EQ(dataset.measured[0].declared, 0.3e-8);
  EXPECT_EQ(dataset.measured[1].kind, MeasuredNumber::Kind::kRatio);
  EXPECT_EQ(dataset.runs[0].measured.places.size(), 2u);
}

TEST(RigParts, AFittingIsOnePairForBothDirections) {
  const auto dataset =
      Read(WithElement({{"part", "fitting-1"}, {"measure", {"sonic_conductance"}}}));
  EXPECT_EQ(dataset.measured.size(), 1u);
  EXPECT_EQ(dataset.runs[0].measured.places.size(), 2u);
}

TEST(RigParts, WhatTheRigDeclaresStands) {
  const auto dataset =
      Read(WithElement({{"part", "fitting-1"}, {"sonic_conductance_dm3_per_s_bar", 0.5}}));
  EXPECT_DOUBLE_EQ(dataset.runs[0].line[0].fill.sonic_conductance_m3_per_s_pa, 0.5e-8);
  EXPECT_TRUE(dataset.measured.empty());
}

TEST(RigParts, TubingBecomesATube) {
  const auto dataset = Read(WithElement({{"part", "tubing-1"}, {"length_m", 0.5}}));
  ASSERT_TRUE(dataset.runs[0].line[0].tube);
  EXPECT_DOUBLE_EQ(dataset.runs[0].line[0].tube->inner_diameter_m, 2.5e-3);
}

TEST(RigParts, APumpBringsItsCurveAsFallsFromPointToPoint) {
  Json document = ExampleMeasurement();
  document["rig"]["supply"] = {
      {"kind", "compressor"}, {"part", "compressor-1"}, {"measure", {"free_air"}}};
  const auto dataset = Read(document);
  ASSERT_EQ(dataset.measured.size(), 3u);
  EXPECT_NEAR(dataset.measured[0].declared, (24.9 - 14.2) / 6e4, 1e-12);
  EXPECT_NEAR(dataset.measured[2].declared, 6.5 / 6e4, 1e-12);
  EXPECT_EQ(dataset.runs[0].measured.delivery, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(RigParts, AReservoirIsFilled) {
  Json document = ExampleMeasurement();
  document["rig"]["actuator"] = {{"part", "reservoir-1"}, {"measure", {"internal_volume"}}};
  const auto dataset = Read(document);
  EXPECT_DOUBLE_EQ(dataset.runs[0].chamber.rest_volume_m3, 500e-6);
  EXPECT_EQ(dataset.measured[0].kind, MeasuredNumber::Kind::kVolume);
}

TEST(RigParts, WhatCannotBeIsRefusedByItsField) {
  const std::string at = "/rig/line/elements/0";
  EXPECT_THAT(DetailAt(Refused(WithElement({{"part", "valv-1"}})), at + "/part"),
              HasSubstr("nearest id: valve-1"));
  EXPECT_THAT(DetailAt(Refused(WithElement({{"part", "battery-1"}})), at + "/part"),
              HasSubstr("a line takes"));
  EXPECT_THAT(DetailAt(Refused(WithElement({{"part", "tubing-1"}})), at + "/length_m"),
              HasSubstr("required"));
  EXPECT_THAT(DetailAt(Refused(WithElement({{"part", "valve-1"}, {"measure", {"mass"}}})),
                       at + "/measure/0"),
              HasSubstr("sonic_conductance_fill"));
  EXPECT_THAT(DetailAt(Refused(WithElement({{"sonic_conductance_dm3_per_s_bar", 0.5},
                                            {"critical_ratio", 0.3},
                                            {"measure", {"sonic_conductance"}}})),
                       at + "/part"),
              HasSubstr("required with measure"));
  Json document = ExampleMeasurement();
  document["rig"]["supply"] = {{"kind", "compressor"}, {"part", "valve-1"}};
  EXPECT_THAT(DetailAt(Refused(document), "/rig/supply/part"), HasSubstr("compressor"));
}

TEST(RigParts, AreFoundInRunsToo) {
  Json document = ExampleMeasurement();
  EXPECT_FALSE(NamesParts(document));
  document["runs"][0]["rig"] = {{"line", {{"elements", Json::array({{{"part", "none"}}})}}}};
  EXPECT_TRUE(NamesParts(document));
  EXPECT_THAT(DetailAt(Refused(document), "/runs/0/rig/line/elements/0/part"),
              HasSubstr("no part"));
}

}  // namespace rig_parts_test
}  // namespace plenum::api
