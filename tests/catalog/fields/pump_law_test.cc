// The law of pumps here against catalog/estimates/pumps.py: the seed's rows are its answers.
#include "catalog/fields/laws/pump_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "catalog/fields/csv.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace pump_law_test {

std::vector<Part> Seed(const std::string& family) {
  std::ifstream file(test::SourceDir() / ("catalog/data/" + family + ".csv"), std::ios::binary);
  return ReadCsv(family, std::string{std::istreambuf_iterator<char>(file), {}}).parts;
}

std::optional<double> Printed(const Part& part, const char* name) {
  const auto found = part.numbers.find(name);
  if (found == part.numbers.end() || found->second.provenance == Provenance::kEstimated) return {};
  return found->second.value;
}

// Of the seed's own law: both flow and current estimated, no single point.
bool IsByLaw(const Part& part) {
  return part.curve && part.curve->free_air_provenance == Provenance::kEstimated &&
         part.curve->current_provenance == Provenance::kEstimated &&
         part.curve->points.size() > 1 &&
         part.curve->free_air_source.find("JSG") == std::string::npos;
}

TEST(PumpLaw, GivesTheCurvesOfTheSeed) {
  int compared = 0;
  for (const char* family : {"compressor", "vacuum_pump"})
    for (const Part& part : Seed(family)) {
      if (!IsByLaw(part)) continue;
      PumpSheet sheet;
      for (const CurvePoint& point : part.curve->points) {
        sheet.free_flow_l_per_min = std::max(sheet.free_flow_l_per_min, point.free_air_l_per_min);
        if (std::abs(point.pressure_kpa_gauge) > std::abs(sheet.far_kpa_gauge))
          sheet.far_kpa_gauge = point.pressure_kpa_gauge;
      }
      sheet.voltage_v = part.numbers.at("voltage_v").value;
      sheet.power_min_w = Printed(part, "power_min_w");
      sheet.power_max_w = Printed(part, "power_max_w");
      const auto type = part.texts.find("type");
      sheet.is_piston = type != part.texts.end() && type->second.value == "piston" &&
                        !part.series.starts_with("JSG ");
      const PumpEstimate estimate = EstimatePump(sheet);
      EXPECT_EQ(estimate.points, part.curve->points) << part.id;
      EXPECT_EQ(estimate.free_air_uncertainty, part.curve->free_air_uncertainty) << part.id;
      EXPECT_EQ(estimate.current_uncertainty, part.curve->current_uncertainty) << part.id;
      ++compared;
    }
  EXPECT_GT(compared, 200);
}

}  // namespace pump_law_test
}  // namespace plenum::catalog
