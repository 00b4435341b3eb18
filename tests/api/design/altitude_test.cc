// Thin air at pumps: a given design gets worse with altitude, never better.
#include <gtest/gtest.h>

#include <limits>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/given/evaluation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace altitude_test {

// physics, 2.18: p_amb/100 kPa times the curve read at the same ratio of pressures.
TEST(Altitude, APumpDeliversTheShareThatTheAirHas) {
  const model::Ambient sea{.pressure_pa = 100e3}, high{.pressure_pa = 60e3};
  const auto all = [](const model::Parts& parts) {
    std::vector<model::Compressor> pumps = parts.compressors;
    pumps.insert(pumps.end(), parts.vacuum_pumps.begin(), parts.vacuum_pumps.end());
    return pumps;
  };
  const std::vector<model::Compressor> at_sea = all(ToModelParts(Project().parts, sea));
  const std::vector<model::Compressor> up_high = all(ToModelParts(Project().parts, high));
  ASSERT_EQ(at_sea.size(), up_high.size());
  ASSERT_GT(at_sea.size(), 200u);
  for (std::size_t i = 0; i < at_sea.size(); ++i) {
    const model::MonotoneCurve& low = at_sea[i].curve.free_air_m3_per_s;
    const model::MonotoneCurve& thin = up_high[i].curve.free_air_m3_per_s;
    for (double ratio = 1.0; ratio * sea.pressure_pa < low.back(); ratio += 0.1)
      EXPECT_NEAR(thin(ratio * high.pressure_pa), 0.6 * low(ratio * sea.pressure_pa),
                  1e-9 * low.y().front())
          << at_sea[i].basics.id;
  }
}

Json EvaluatedAt(Json request, const Json& design, double ambient_kpa) {
  request["ambient"] = {{"pressure_kpa_abs", ambient_kpa}, {"temperature_k", 293.15}};
  const auto evaluated =
      RunEvaluation({{"schema", "evaluation/1"}, {"requirements", request}, {"design", design}},
                    Project().parts, {});
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<Json>(evaluated);
}

TEST(Altitude, ADesignWithAPumpSustainsLess) {
  for (const char* name : {"exosuit", "four_fingers", "jamming_gripper"}) {
    SCOPED_TRACE(name);
    Json request = Example(name);
    request["ranking"] = {{"count", 1}, {"list", "combinations"}};
    if (std::string(name) == "exosuit") request["supply"]["configurations"] = {"compressor"};
    const Json design = Answered(request)["designs"][0];
    double before = std::numeric_limits<double>::infinity();
    // An evacuated actuator needs a source below 60 kPa of what there is.
    for (const double ambient_kpa : {105.0, 100.0, 92.0, 85.0}) {
      const Json figures = EvaluatedAt(request, design, ambient_kpa);
      if (figures["works"] != true) break;  // worse than any
      const double sustained = figures["performance"]["frequency_hz_sustained"];
      EXPECT_LT(sustained, before) << ambient_kpa;
      before = sustained;
    }
    EXPECT_LT(before, std::numeric_limits<double>::infinity());
  }
}

}  // namespace altitude_test
}  // namespace plenum::api
