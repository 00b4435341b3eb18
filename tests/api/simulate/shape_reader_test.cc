#include "api/simulate/shape_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace shape_reader_test {

using testing::HasSubstr;

// The contract's simulation with the group's volumes replaced by a shape.
Json WithShape(const char* name, const char* shape) {
  Json document = Simulation();
  Json& group = document["actuators"][0];
  group.erase("rest_volume_ml");
  group.erase("expansion_ratio");
  group[name] = Parse(shape);
  return document;
}

Json Simulated(const Json& document) {
  const auto answer = RunSimulation(document, SmallCatalogue());
  for (const Error& error : ErrorsOf(answer))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::get<Json>(answer);
}

std::string DetailOf(const Json& document, const std::string& pointer) {
  return DetailAt(ErrorsOf(RunSimulation(document, SmallCatalogue())), pointer);
}

Json Named(const Json& answer, const std::string& name) {
  for (const Json& row : answer["understood"])
    if (row.value("name", "") == name) return row;
  ADD_FAILURE() << name;
  return Json();
}

// Volumes by hand: bore 10 mm and stroke 50 mm sweep 3.92699 mL; a muscle of 100 by 10 mm holds
// 7.85398 mL; a body of 50 mm and 1 m 1963.50 mL; ratios as physics/actuator_shapes_test.cc checks.
TEST(Shapes, ComeToVolumesThatAreToldWithTheirFormula) {
  const struct {
    const char *name, *shape;
    double rest_ml, operating_ml;
  } cases[] = {
      {"cylinder", R"({ "bore_mm": 10, "stroke_mm": 50, "dead_volume_ml": 1 })", 1, 4.92699},
      {"cylinder", R"({ "bore_mm": "1 cm", "stroke_mm": 50, "acting": "single", "rod_mm": 4 })",
       0.1963495, 4.1233404},
      {"muscle",
       R"({ "length_mm": 100, "diameter_mm": 10, "braid_angle_deg": 20, "contraction": 0.25 })",
       7.8539816, 25.34397},
      {"pouch", R"({ "width_mm": 30, "length_mm": 3000, "cells": 2 })", 1.711, 1711.2},
      {"body", R"({ "diameter_mm": 50, "length_m": 1 })", 1.9634954, 1963.4954}};
  for (const auto& [name, shape, rest_ml, operating_ml] : cases) {
    const Json answer = Simulated(WithShape(name, shape));
    const Json rest = Named(answer, "rest_volume_ml"), grown = Named(answer, "operating_volume_ml");
    EXPECT_NEAR(rest["value"].get<double>() / rest_ml, 1.0, 1e-3) << name;
    EXPECT_NEAR(grown["value"].get<double>() / operating_ml, 1.0, 1e-3) << name;
    EXPECT_EQ(rest["pointer"], std::string("/actuators/0/") + name);
    EXPECT_EQ(rest["given"], Parse(shape));
    EXPECT_FALSE(grown["formula"].get<std::string>().empty());
    const double ratio = Named(answer, "expansion_ratio")["value"].get<double>();
    EXPECT_NEAR(ratio, operating_ml / rest_ml, 2e-3 * ratio);
    // The same as with the volumes that were told.
    Json plain = Simulation();
    plain["actuators"][0]["rest_volume_ml"] = rest["value"];
    plain["actuators"][0]["expansion_ratio"] = ratio;
    const Json same = Simulated(plain);
    EXPECT_NEAR(answer["performance"]["groups"][0]["fall_time_s"].get<double>(),
                same["performance"]["groups"][0]["fall_time_s"].get<double>(), 1e-6);
  }
}

TEST(Shapes, ServeRequirementsToo) {
  Json document = Requirements();
  document["actuators"][0].erase("rest_volume_ml");
  document["actuators"][0].erase("expansion_ratio");
  document["actuators"][0]["body"] = Parse(R"({ "diameter_mm": "2 in", "length_m": "3 ft" })");
  const auto parsed = ParseRequirements(document, SmallCatalogue());
  ASSERT_TRUE(ErrorsOf(parsed).empty());
  const auto& chamber = std::get<DesignRequest>(parsed).problem.groups[0].chamber;
  EXPECT_NEAR(chamber.rest_volume_m3 * chamber.expansion_ratio, 1.853333e-3, 1e-9);
  EXPECT_NEAR(chamber.expansion_ratio, 1000.0, 1e-9);
  EXPECT_GE(std::get<DesignRequest>(parsed).remarks.understood.size(), 5u);
}

TEST(Shapes, AreRefusedWithTheirRange) {
  const auto muscle = [](const char* contraction) {
    return DetailOf(WithShape("muscle", (std::string(R"({ "length_mm": 100, "diameter_mm": 10,
                                "braid_angle_deg": 20, "contraction": )") +
                                         contraction + "}")
                                            .c_str()),
                    "/actuators/0/muscle/contraction");
  };
  EXPECT_EQ(muscle("0.5"),
            "must be > 0 and ≤ 0.3855 with a braid angle of 20°: there the braid stands at 54.7° "
            "and contracts no further; not 0.5");
  EXPECT_THAT(muscle("0"), HasSubstr("must be > 0"));
  EXPECT_THAT(DetailOf(WithShape("cylinder", R"({ "bore_mm": 10, "stroke_mm": 50,
                                                  "acting": "double" })"),
                       "/actuators/0/cylinder/acting"),
              HasSubstr("must be single here"));
  EXPECT_THAT(DetailOf(WithShape("cylinder", R"({ "bore_mm": 10, "stroke_mm": 50, "rod_mm": 12 })"),
                       "/actuators/0/cylinder/rod_mm"),
              HasSubstr("must be less than the bore of 10 mm, not 12"));
  EXPECT_THAT(DetailOf(WithShape("cylinder", R"({ "bore_mm": 10, "stroke_mm": 50,
                                                  "dead_volume_ml": 0.001 })"),
                       "/actuators/0/cylinder/dead_volume_ml"),
              HasSubstr("must be ≥ 0.0039309"));
  EXPECT_THAT(DetailOf(WithShape("pouch", R"({ "width_mm": 30, "length_mm": 60, "depth": 1 })"),
                       "/actuators/0/pouch/depth"),
              HasSubstr("unknown field"));
  EXPECT_THAT(DetailOf(WithShape("body", R"({ "diameter_mm": 1000, "length_m": 1000 })"),
                       "/actuators/0/body"),
              HasSubstr("has an operating volume of"));
}

TEST(Shapes, StandAlone) {
  Json document = WithShape("body", R"({ "diameter_mm": 50, "length_m": 1 })");
  document["actuators"][0]["rest_volume_ml"] = 50;
  EXPECT_THAT(DetailOf(document, "/actuators/0/rest_volume_ml"), HasSubstr("not both"));
  document["actuators"][0].erase("rest_volume_ml");
  document["actuators"][0]["pouch"] = Parse(R"({ "width_mm": 30, "length_mm": 60 })");
  EXPECT_THAT(DetailOf(document, "/actuators/0/body"),
              HasSubstr("give either pouch or body, not both"));
}

}  // namespace shape_reader_test
}  // namespace plenum::api
