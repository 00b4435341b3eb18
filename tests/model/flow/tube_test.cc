#include "model/flow/tube.h"

#include <gtest/gtest.h>

#include "tests/support/flow/fanno.h"

namespace plenum::model {
namespace tube_test {

struct Row {
  double bore_mm, length_m;
  double formula_c, formula_b;
  double fanno_c, fanno_b;
};

constexpr Row kRows[] = {
    {1.2, 0.5, 0.0797, 0.26, 0.0820, 0.01}, {2.5, 0.5, 0.484, 0.37, 0.499, 0.17},
    {4.0, 0.5, 1.46, 0.43, 1.50, 0.27},     {5.0, 0.5, 2.44, 0.46, 2.48, 0.31},
    {4.0, 1.0, 1.20, 0.35, 1.23, 0.15},     {4.0, 3.0, 0.785, 0.23, 0.805, -0.03},
};

TEST(Tube, FormulaReproducesTheTable) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(row.bore_mm);
    const FlowElement tube = TubeElement(row.bore_mm * 1e-3, row.length_m);
    EXPECT_NEAR(tube.sonic_conductance_m3_per_s_pa * 1e8, row.formula_c, 0.01 * row.formula_c);
    EXPECT_NEAR(tube.critical_ratio, row.formula_b, 0.02);
    EXPECT_EQ(tube.subsonic_index, 0.5);
    EXPECT_EQ(tube.cracking_pressure_pa, 0.0);
  }
}

TEST(Tube, FormulaAgreesWithFannoFlow) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(row.bore_mm);
    const FlowElement tube = TubeElement(row.bore_mm * 1e-3, row.length_m);
    const auto fanno = test::SolveFanno(row.bore_mm * 1e-3, row.length_m, 3e5);
    EXPECT_NEAR(fanno.sonic_conductance_m3_per_s_pa * 1e8, row.fanno_c, 0.01 * row.fanno_c);
    EXPECT_NEAR(fanno.critical_ratio, row.fanno_b, 0.02);
    EXPECT_NEAR(tube.sonic_conductance_m3_per_s_pa / fanno.sonic_conductance_m3_per_s_pa, 1.0,
                0.035);
  }
}

TEST(Tube, CriticalRatioStaysBelowTheIdealNozzle) {
  EXPECT_EQ(TubeElement(10e-3, 0.01).critical_ratio, 0.528);
}

TEST(Tube, BoreVolumePerMetre) {
  EXPECT_NEAR(BoreVolume(2.5e-3, 1.0) * 1e6, 4.9, 0.05);
  EXPECT_NEAR(BoreVolume(4e-3, 1.0) * 1e6, 12.6, 0.05);
}

}  // namespace tube_test
}  // namespace plenum::model
