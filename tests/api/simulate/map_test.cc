#include "api/simulate/map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/json/json.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace map_test {

using testing::HasSubstr;

Json Rows(const Json& request) {
  const auto result = RunMap(request);
  for (const Error& error : ErrorsOf(result))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::holds_alternative<Json>(result) ? std::get<Json>(result)["rows"] : Json::array();
}

TEST(Map, MeetsThePublishedTimes) {
  const struct {
    double source, operating, expansion, critical, rise, fall;
  } oracles[] = {
      {3.0, 2.0, 2.0, 0.30, 1.066905, 2.459439}, {2.2, 2.0, 2.0, 0.30, 1.809829, 2.459439},
      {1.5, 1.3, 1.2, 0.20, 0.544652, 0.964523}, {6.0, 2.0, 1.0, 0.30, 0.166679, 0.869134},
      {6.0, 5.0, 1.5, 0.30, 1.225728, 2.328377}, {2.0, 1.7, 1.5, 0.60, 0.826105, 1.297414},
  };
  for (const auto& row : oracles) {
    const Json rows = Rows(Json{{"schema", "map/1"},
                                {"source_pressure_ratio", row.source},
                                {"operating_pressure_ratio", row.operating},
                                {"expansion_ratio", row.expansion},
                                {"critical_ratio", row.critical},
                                {"rise", {{"to_fraction", 1.0}}}});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_NEAR(rows[0]["rise_time_normalised"].get<double>(), row.rise, 1e-6);
    EXPECT_NEAR(rows[0]["fall_time_normalised"].get<double>(), row.fall, 1e-6);
    EXPECT_NEAR(rows[0]["frequency_max_normalised"].get<double>(), 1 / (row.rise + row.fall), 1e-6);
  }
}

TEST(Map, HasOneRowPerPointWithItsCoordinates) {
  const Json rows = Rows(Map());
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0]["source_pressure_ratio"], 1.5);
  EXPECT_EQ(rows[0]["expansion_ratio"], 1.0);
  EXPECT_EQ(rows[1]["expansion_ratio"], 2.0);
  EXPECT_EQ(rows[5]["source_pressure_ratio"], 3.0);
  EXPECT_EQ(rows[5]["operating_pressure_ratio"], 2.0);
  EXPECT_EQ(rows[5]["critical_ratio"], 0.3);
  // 1.5 times ambient never reaches 95 % of the way to 2; the fall does not depend on the source.
  EXPECT_TRUE(rows[0]["rise_time_normalised"].is_null());
  EXPECT_TRUE(rows[0]["frequency_max_normalised"].is_null());
  EXPECT_EQ(rows[1]["fall_time_normalised"], rows[5]["fall_time_normalised"]);
}

TEST(Map, AnEndlessReservoirEqualsConstantPressure) {
  Json request = Parse(R"({"schema": "map/1", "source_pressure_ratio": 3, "expansion_ratio": 2,
    "operating_pressure_ratio": 2, "critical_ratio": 0.3, "rise": {"to_fraction": 1}})");
  request["compressor_flow_normalised"] = 0.0;
  request["reservoir_volume_normalised"] = Json{1e6, 20};
  request["actuator_count"] = Json{1, 6};
  const Json rows = Rows(request);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[3]["actuator_count"], 6);
  EXPECT_EQ(rows[3]["reservoir_volume_normalised"], 20.0);
  EXPECT_NEAR(rows[0]["rise_time_normalised"].get<double>(), 1.066905, 1e-5);
  EXPECT_NEAR(rows[0]["fall_time_normalised"].get<double>(), 2.459439, 1e-5);
  // A small reservoir droops; for six actuators its content is just enough: 20·3 + 6·1 = 66 against
  // 20·2 + 6·4 = 64 at the target.
  EXPECT_GT(rows[2]["rise_time_normalised"].get<double>(), 1.066905);
  EXPECT_GT(rows[3]["rise_time_normalised"].get<double>(),
            rows[2]["rise_time_normalised"].get<double>());
}

TEST(Map, AReservoirTooSmallNeverReachesTheTargetWithoutAPump) {
  Json request = Parse(R"({"schema": "map/1", "source_pressure_ratio": 3, "expansion_ratio": 2,
    "operating_pressure_ratio": 2, "critical_ratio": 0.3, "rise": {"to_fraction": 1},
    "reservoir_volume_normalised": 2, "compressor_flow_normalised": [0, 0.5]})");
  // Content 2·3 + 1·1 = 7 against 2·2 + 2·2 = 8 at the target: one unit of gas is missing, which a
  // pump of 0.5 delivers in two units of time at the earliest.
  const Json rows = Rows(request);
  EXPECT_TRUE(rows[0]["rise_time_normalised"].is_null());
  EXPECT_GT(rows[1]["rise_time_normalised"].get<double>(), 2.0);
  EXPECT_LT(rows[1]["rise_time_normalised"].get<double>(), 6.0);
}

TEST(Map, NamesEveryFieldThatIsWrong) {
  const struct {
    const char* pointer;
    const char* value;
    const char* at;
    const char* detail;
  } cases[] = {
      {"/schema", "\"map\"", "/schema", "map/1"},
      {"/source_pressure_ratio", "[]", "/source_pressure_ratio", "1 to 1000"},
      {"/source_pressure_ratio", "[2, 0.5]", "/source_pressure_ratio/1", "≥ 1"},
      {"/operating_pressure_ratio", "[1]", "/operating_pressure_ratio/0", "> 1"},
      {"/expansion_ratio", "[\"2\"]", "/expansion_ratio/0", "number"},
      {"/critical_ratio", "[1]", "/critical_ratio/0", "≤ 0.95"},
      {"/compressor_flow_normalised", "[1]", "/reservoir_volume_normalised", "is required"},
      {"/actuator_count", "[1]", "/actuator_count", "compressor source"},
      {"/expansion_ration", "[1]", "/expansion_ration", "nearest known: expansion_ratio"},
  };
  for (const auto& [pointer, value, at, detail] : cases) {
    const Errors errors = ErrorsOf(RunMap(With(Map(), pointer, Parse(value))));
    ASSERT_EQ(errors.size(), 1u) << pointer;
    EXPECT_EQ(errors[0].pointer, at);
    EXPECT_THAT(errors[0].detail, HasSubstr(detail));
  }
  Json huge = Map();
  for (int i = 0; i < 1000; ++i) {
    huge["source_pressure_ratio"][i] = 1.5 + i;
    huge["operating_pressure_ratio"][i] = 1.5 + i * 0.01;
  }
  for (int i = 0; i < 1000; ++i)
    if (huge["source_pressure_ratio"][i] > 1000) huge["source_pressure_ratio"][i] = 1000;
  EXPECT_THAT(DetailAt(ErrorsOf(RunMap(huge)), ""), HasSubstr("at most 1e5 points"));
}

}  // namespace map_test
}  // namespace plenum::api
