// A tight vessel whose walls give off gas after it was evacuated, in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "calibration/diagnose.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace outgassing_test {

constexpr double kAmbientPa = 101.3e3, kVolumeM3 = 150e-6, kNoisePa = 10.0;
constexpr double kTimeConstantS = 70.0;

Run Evacuated(const std::string& id, double start_pa, std::uint64_t seed) {
  Run run;
  run.id = id;
  run.ambient = {kAmbientPa, model::kReferenceTemperatureK};
  run.chamber = {.rest_volume_m3 = kVolumeM3,
                 .expansion_ratio = 1.0,
                 .operating_pressure_pa = 2e5,
                 .ambient_pressure_pa = kAmbientPa,
                 .volume_curve = {}};
  run.blocked = true;
  run.initial_temperature_k = run.ambient.temperature_k;  // no heat is left of the evacuation
  run.valve = {{0.0, model::ValveState::kHold}};
  const std::vector<double> noise = test::WhiteNoise(seed, 300, kNoisePa);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double t_s = 2.0 * static_cast<double>(i);
    run.t_s.push_back(t_s);
    run.pressure_pa.push_back(start_pa + 1200.0 * (1.0 - std::exp(-t_s / kTimeConstantS)) +
                              noise[i]);
  }
  return run;
}

TEST(Outgassing, OfAnEvacuatedVesselIsNamed) {
  Dataset dataset;
  dataset.name = "vessel";
  dataset.runs = {Evacuated("a", 300.0, 1), Evacuated("b", 900.0, 2), Evacuated("c", 500.0, 3)};
  dataset.holdout = {"c"};
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  ASSERT_EQ(d.effects[0].effect.spec->id, "outgassing");
  // 1.2 kPa in 150 mL, over 70 s.
  const double flow_m3_per_s = 1200.0 / kTimeConstantS * kVolumeM3 / model::kReferencePressurePa;
  EXPECT_NEAR(d.effects[0].effect.parameters[0], flow_m3_per_s, 0.03 * flow_m3_per_s);
  EXPECT_NEAR(d.effects[0].effect.parameters[1], kTimeConstantS, 0.03 * kTimeConstantS);
  EXPECT_LT(*d.after.holdout_rms_pa, 1.2 * kNoisePa);
}

// At the rate of a leak, from first to last, it is none.
TEST(Outgassing, ThatDoesNotDecayIsALeak) {
  Dataset dataset;
  dataset.name = "vessel";
  dataset.runs.reserve(2);
  for (const std::uint64_t seed : {1, 2}) {
    dataset.runs.push_back(Evacuated("r" + std::to_string(seed), 300.0, seed));
    calibration::Run& run = dataset.runs.back();
    const std::vector<double> noise = test::WhiteNoise(seed, run.t_s.size(), kNoisePa);
    for (std::size_t i = 0; i < noise.size(); ++i)
      run.pressure_pa[i] = 300.0 + 2.4 * run.t_s[i] + noise[i];
  }
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
}

// Beside a leak, whose flow hardly changes near vacuum, the sum of both is a drift of the sensor,
// too, of as many numbers. That a term that has no name does as well is said; it is no reason
// against names.
TEST(Outgassing, BesideALeakIsNamedThoughASensorMightDrift) {
  Dataset dataset;
  dataset.name = "vessel";
  dataset.runs = {Evacuated("a", 300.0, 1), Evacuated("b", 900.0, 2), Evacuated("c", 500.0, 3)};
  for (calibration::Run& run : dataset.runs)
    for (std::size_t i = 0; i < run.t_s.size(); ++i) run.pressure_pa[i] += 2.0 * run.t_s[i];
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 2u) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
  ASSERT_EQ(d.effects[1].effect.spec->id, "outgassing");
  const double flow_m3_per_s = 1200.0 / kTimeConstantS * kVolumeM3 / model::kReferencePressurePa;
  EXPECT_NEAR(d.effects[1].effect.parameters[0], flow_m3_per_s, 0.05 * flow_m3_per_s);
  EXPECT_NEAR(d.effects[1].effect.parameters[1], kTimeConstantS, 0.05 * kTimeConstantS);
  EXPECT_THAT(d.warnings, testing::Contains(testing::HasSubstr("a sensor that drifts")));
}

}  // namespace outgassing_test
}  // namespace plenum::calibration
