// Whether measured numbers may go into the catalogue: good tests give the truth, bad ones are
// refused or say so.
#include "calibration/names/measured_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "calibration/diagnose.h"
#include "calibration/fit/forward.h"
#include "model/effects/registry.h"
#include "tests/calibration/bottle.h"

namespace plenum::calibration {
namespace measured_numbers_test {

using test::BottleTestOfAPump;
using test::BottleTestOfAValve;
using test::HiddenBottle;
using testing::Contains;
using testing::HasSubstr;

Diagnosis Diagnosed(const Dataset& dataset) { return Diagnose(dataset, {}); }

const MeasuredEstimate& At(const Diagnosis& diagnosis, std::size_t number) {
  return *std::find_if(diagnosis.measured.begin(), diagnosis.measured.end(),
                       [&](const MeasuredEstimate& one) { return one.number == number; });
}

void ExpectTruth(const Diagnosis& diagnosis, std::size_t number, double truth) {
  const MeasuredEstimate& estimate = At(diagnosis, number);
  EXPECT_NEAR(estimate.value, truth, 4.0 * estimate.deviation) << number;
  EXPECT_LT(estimate.deviation, 0.02 * truth) << number;
}

TEST(MeasuredNumbers, OfABottleWithHeatAreTheTruth) {
  HiddenBottle hidden;
  hidden.fill_c = 1.15, hidden.exhaust_c = 0.9, hidden.fill_b = 0.38;
  hidden.heat_s = 9.0;
  const Dataset dataset = BottleTestOfAValve(hidden, 1);
  const Diagnosis diagnosis = Diagnosed(dataset);
  EXPECT_THAT(WhyNoRevision(dataset, diagnosis), testing::IsEmpty());
  ExpectTruth(diagnosis, 0, 1.15 * test::kValveC);
  ExpectTruth(diagnosis, 1, 0.38);
  ExpectTruth(diagnosis, 2, 0.9 * test::kValveC);
  for (const MeasuredEstimate& estimate : diagnosis.measured)
    EXPECT_EQ(WhyNotKept(dataset, estimate), "");
}

// The residual shows the leak, and C is fitted beside it.
TEST(MeasuredNumbers, ALeakThatIsNotDeclaredIsFoundBesideThem) {
  HiddenBottle hidden;
  hidden.leak = test::OrificeLeak{0.004e-8, 0.4};
  const Dataset dataset = BottleTestOfAValve(hidden, 2);
  const Diagnosis diagnosis = Diagnosed(dataset);
  EXPECT_NE(diagnosis.verdict, Verdict::kAdequate);
  EXPECT_THAT(WhyNoRevision(dataset, diagnosis), testing::IsEmpty());
  ExpectTruth(diagnosis, 0, test::kValveC);
  ExpectTruth(diagnosis, 2, test::kValveC);
}

// A volume that is a fifth wrong shows in no pressure: the answer says that C goes with it.
TEST(MeasuredNumbers, AWrongVolumeIsWarnedOf) {
  HiddenBottle hidden;
  hidden.volume = 1.2;
  const Diagnosis diagnosis = Diagnosed(BottleTestOfAValve(hidden, 8));
  EXPECT_THAT(diagnosis.warnings,
              Contains(testing::AllOf(HasSubstr("known only as well as the volume of the bottle"),
                                      HasSubstr("declared to 0.4 %"),
                                      HasSubstr("sonic_conductance_fill"))));
}

// One pressure fixes C/V alone: without an uncertainty of the volume C has none either.
TEST(MeasuredNumbers, ABottleWithoutAnUncertaintyIsRefused) {
  Dataset dataset = BottleTestOfAValve({}, 3);
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.0;
  EXPECT_THAT(WhyNoRevision(dataset, Diagnosed(dataset)),
              Contains(HasSubstr("relative_uncertainty.rest_volume")));
}

TEST(MeasuredNumbers, ASaturatedSensorIsRefused) {
  Dataset dataset = BottleTestOfAValve({}, 4);
  for (calibration::Run& run : dataset.runs)
    for (double& pa : run.pressure_pa) pa = std::min(pa, 4.5e5);
  EXPECT_THAT(WhyNoRevision(dataset, Diagnosed(dataset)), testing::Not(testing::IsEmpty()));
}

// The source's record in place of the bottle's.
TEST(MeasuredNumbers, ExchangedColumnsAreRefused) {
  Dataset dataset = BottleTestOfAValve({}, 5);
  for (std::size_t k = 0; k < dataset.runs.size(); ++k) {
    calibration::Run& run = dataset.runs[k];
    const auto noise = test::WhiteNoise(900 + k, run.t_s.size(), 300.0);
    for (std::size_t i = 0; i < noise.size(); ++i)
      run.pressure_pa[i] = test::kBottleSourcePa + noise[i];
  }
  EXPECT_THAT(WhyNoRevision(dataset, Diagnosed(dataset)), testing::Not(testing::IsEmpty()));
}

TEST(MeasuredNumbers, APumpIsMeasuredPointByPoint) {
  const std::vector<double> truth = {1.05e-4, 8.2e-5, 5.7e-5, 3.3e-5, 0.9e-5};
  const Dataset dataset = BottleTestOfAPump(truth, 1.0, 6);
  const Diagnosis diagnosis = Diagnosed(dataset);
  EXPECT_THAT(WhyNoRevision(dataset, diagnosis), testing::IsEmpty());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const MeasuredEstimate& estimate = At(diagnosis, i);
    EXPECT_NEAR(estimate.value, truth[i], 4.0 * estimate.deviation) << i;
    EXPECT_EQ(WhyNotKept(dataset, estimate), "");
  }
}

// As the model has them, with heat from the wall and `noise_pa` beside it.
void MakeReadings(const std::vector<double>& falls, double heat_s, double noise_pa,
                  Dataset& dataset) {
  const ForwardModel forward(dataset);
  ModelState state = forward.Declared();
  state.measured = falls;
  state.effects = {{model::FindEffect("heat_transfer"), {heat_s}}};
  for (std::size_t k = 0; k < dataset.runs.size(); ++k) {
    calibration::Run& run = dataset.runs[k];
    run.pressure_pa = forward.Predict(k, state, {}, {}).reading.pressure_pa;
    const auto noise = test::WhiteNoise(700 + k, run.t_s.size(), noise_pa);
    for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
  }
}

// Behind the 2 ml of the protocol's template steps are held down, and fits with heat must end.
TEST(MeasuredNumbers, APumpsHeatIsFoundBehindASmallVolume) {
  const std::vector<double> truth = {1.05e-4, 8.2e-5, 5.7e-5, 3.3e-5, 0.9e-5};
  Dataset dataset = BottleTestOfAPump(truth, 1.0, 6);
  for (calibration::Run& run : dataset.runs) run.reservoir_volume_m3 = 2e-6;
  MakeReadings({2.3e-5, 2.5e-5, 2.4e-5, 2.4e-5, 0.9e-5}, 12.0, 200.0, dataset);
  const Diagnosis diagnosis = Diagnosed(dataset);
  EXPECT_THAT(WhyNoRevision(dataset, diagnosis), testing::IsEmpty()) << diagnosis.sentence;
  // Alone, or not told from a leak: five seconds of rest show little of either.
  std::vector<std::vector<std::string>> named = diagnosis.tied;
  for (const FittedEffect& effect : diagnosis.effects)
    named.push_back({std::string(effect.effect.spec->id)});
  EXPECT_THAT(named, Contains(std::vector<std::string>{"heat_transfer"})) << diagnosis.sentence;
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(At(diagnosis, i).value, truth[i], 4.0 * At(diagnosis, i).deviation) << i;
}

// It delivers nothing above 200 kPa: the points beyond cannot be told, and are not written.
TEST(MeasuredNumbers, APumpThatStallsIsNotMeasuredBeyond) {
  const Dataset dataset = BottleTestOfAPump({1e-4, 7e-5, 2e-5, 0.0, 0.0}, 1.0, 7);
  const Diagnosis diagnosis = Diagnosed(dataset);
  const bool refused = !WhyNoRevision(dataset, diagnosis).empty();
  EXPECT_TRUE(refused || !WhyNotKept(dataset, At(diagnosis, 3)).empty());
}

}  // namespace measured_numbers_test
}  // namespace plenum::calibration
