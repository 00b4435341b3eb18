#include "calibration/fit/source_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace plenum::calibration {
namespace source_record_test {

// A regulator that dips while an actuator fills, twice.
double Dipping(double t_s) {
  double pressure_pa = 3e5;
  for (const double start_s : {1.0, 4.0}) {
    if (t_s > start_s) pressure_pa -= 4e4 * std::exp(-(t_s - start_s) / 0.4);
  }
  return pressure_pa;
}

TEST(SourceRecord, KeepsAPiecewiseStraightRecordExactly) {
  const model::TimeCourse curve = CondenseRecord(std::vector{0.0, 1.0, 2.0, 2.5, 3.0},
                                                 std::vector{1.0, 2.0, 3.0, 3.0, 3.0}, 0.01);
  EXPECT_EQ(curve.At(0.0), 1.0);
  EXPECT_NEAR(curve.At(1.5), 2.5, 1e-12);
  EXPECT_NEAR(curve.At(2.0), 3.0, 1e-12);
  EXPECT_NEAR(curve.At(2.75), 3.0, 1e-12);
}

TEST(SourceRecord, AveragesNoiseAndKeepsTheDips) {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 300.0);
  std::vector<double> t_s, read_pa;
  for (int i = 0; i <= 2000; ++i) {
    t_s.push_back(i * 4e-3);
    read_pa.push_back(Dipping(t_s.back()) + noise(generator));
  }
  read_pa[17] = std::numeric_limits<double>::quiet_NaN();
  const model::TimeCourse curve = CondenseRecord(t_s, read_pa, 300.0);
  EXPECT_LT(curve.time_s.size(), 100u);
  double squares = 0.0;
  for (const double t : t_s) squares += std::pow(curve.At(t) - Dipping(t), 2);
  const double error_pa = std::sqrt(squares / static_cast<double>(t_s.size()));
  EXPECT_LT(error_pa, 150.0);  // half of that of the samples
  // The step at 1 s lies between two samples.
  EXPECT_NEAR(curve.At(1.02), Dipping(1.02), 3e3);
}

TEST(SourceRecord, CountsSamplesOfOneInstantTogether) {
  const model::TimeCourse curve =
      CondenseRecord(std::vector{0.0, 0.0, 1.0, 1.0}, std::vector{1.0, 3.0, 5.0, 7.0}, 10.0);
  EXPECT_NEAR(curve.At(0.0), 2.0, 1e-12);
  EXPECT_NEAR(curve.At(1.0), 6.0, 1e-12);
  const double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(CondenseRecord(std::vector{0.0}, std::vector{missing}, 1.0).time_s.empty());
  EXPECT_EQ(CondenseRecord(std::vector{0.5}, std::vector{4.0}, 1.0).At(9.0), 4.0);
}

}  // namespace source_record_test
}  // namespace plenum::calibration
