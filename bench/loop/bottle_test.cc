#include "bench/loop/bottle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "api/catalogue/stores.h"
#include "api/protocol/protocol_document.h"
#include "tests/support/places.h"

namespace plenum::bench {
namespace {

using api::Json;

catalog::Part PartOf(const std::string& id) {
  for (const catalog::Part& row :
       catalog::Store(test::SourceDir() / "catalog.db", catalog::Access::kRead).List())
    if (row.id == id) return row;
  return {};
}

Json Recorded(const catalog::Part& known, const catalog::Part& truth) {
  test::Random random(1);
  return RecordBottleTest(api::RenderProtocol(known, {}).at("tests")[0], truth, random);
}

TEST(Bottle, ARecordingIsTheTemplateWithReadings) {
  const catalog::Part valve = PartOf("smc-vq110u-5m-m5");
  Json recorded = Recorded(valve, valve);
  for (Json& run : recorded["runs"]) {
    const Json& readings = run["pressure_kpa_gauge"];
    ASSERT_EQ(readings.size(), run["t_s"].size());
    const double source_kpa = run["source_pressure_kpa_gauge"];
    double highest_kpa = 0.0;
    for (const Json& reading : readings) {
      const double kpa = reading.get<double>();
      EXPECT_NEAR(kpa, 0.1 * std::round(10.0 * kpa), 1e-9);
      highest_kpa = std::max(highest_kpa, kpa);
    }
    EXPECT_NEAR(highest_kpa, source_kpa, 0.03 * source_kpa);
    EXPECT_NEAR(readings.front().get<double>(), 0.0, 1.0);
    EXPECT_NEAR(readings.back().get<double>(), 0.0, 0.1 * source_kpa);
    run.erase("t_s");
    run.erase("pressure_kpa_gauge");
  }
  EXPECT_EQ(recorded, api::RenderProtocol(valve, {}).at("tests")[0].at("recording").at("template"));
}

TEST(Bottle, APumpThatDeliversLessIsRecordedForLonger) {
  const catalog::Part pump = PartOf("parker-btc-iis-14.8v");
  catalog::Part weak = pump;
  for (catalog::CurvePoint& point : weak.curve->points) point.free_air_l_per_min *= 0.4;
  const Json as_told = Recorded(pump, pump), longer = Recorded(pump, weak);
  const auto end_s = [](const Json& of) { return of["runs"][0]["t_s"].back().get<double>(); };
  const auto end_kpa = [](const Json& of) {
    return of["runs"][0]["pressure_kpa_gauge"].back().get<double>();
  };
  EXPECT_GT(end_s(longer), 1.9 * end_s(as_told));
  EXPECT_NEAR(end_kpa(longer), end_kpa(as_told), 0.15 * end_kpa(as_told));
}

}  // namespace
}  // namespace plenum::bench
