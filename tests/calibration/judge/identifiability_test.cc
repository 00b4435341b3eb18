#include "calibration/judge/identifiability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace identifiability_test {

using model::ValveState;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// One run of the bench, made by the model itself with 200 Pa of noise.
Dataset MakeData(bool blocked, bool flow_known) {
  Dataset dataset;
  calibration::Run run;
  run.id = "r1";
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  run.line = {{{5e-10, 0.3}, {5e-10, 0.3}, {}}};
  run.supply = Supply::kRegulated;
  run.source_pressure_pa = 3e5;
  run.initial_pressure_pa = 1e5;
  run.blocked = blocked;
  run.valve = {{0.1, ValveState::kInflate}, {1.0, ValveState::kHold}, {2.0, ValveState::kDeflate}};
  run.t_s = test::EvenTimes(400, 0.01);
  dataset.runs = {run};
  const ForwardModel forward(dataset);
  const Prediction truth = forward.Predict(0, forward.Declared(), {}, {});
  dataset.runs[0].pressure_pa = truth.reading.pressure_pa;
  const std::vector<double> noise = test::WhiteNoise(1, run.t_s.size(), 200.0);
  for (std::size_t i = 0; i < noise.size(); ++i) dataset.runs[0].pressure_pa[i] += noise[i];
  if (flow_known) dataset.runs[0].channels.flow_m3_per_s = truth.reading.channels.flow_m3_per_s;
  return dataset;
}

Identifiability Of(const Dataset& dataset, std::vector<model::Effect> effects = {}) {
  const ForwardModel forward(dataset);
  const std::vector<ObservedRun> observed = Observe(dataset);
  FitData data;
  data.forward = &forward;
  data.observed = &observed;
  data.runs = {0};
  data.sizes = SizesOf(dataset);
  ModelState start = forward.Declared();
  start.effects = std::move(effects);
  const Fit fit = FitModel(data, start, {});
  EXPECT_TRUE(fit.Usable()) << fit.detail;
  return Identify(data, fit, {}).value();
}

constexpr auto kVolume = static_cast<std::size_t>(Declared::kRestVolume);
constexpr auto kConductance = static_cast<std::size_t>(Declared::kSonicConductance);

TEST(Identify, ConductanceAndVolumeOfOneChamberAreAliases) {
  Dataset dataset = MakeData(false, false);
  dataset.relative_uncertainty[kVolume] = kUnknown;
  dataset.relative_uncertainty[kConductance] = 0.03;
  const Identifiability found = Of(dataset);
  ASSERT_EQ(found.aliases.size(), 1u);
  EXPECT_THAT(found.aliases[0], UnorderedElementsAre("rest_volume", "sonic_conductance"));
  EXPECT_THAT(found.silent, IsEmpty());
  EXPECT_THAT(Sentences(found)[0], testing::HasSubstr("rest_volume and sonic_conductance"));
}

// A measured conductance and the bottle behind it: what that means is said, not the names alone.
TEST(Identify, AMeasuredConductanceIsAsWellKnownAsItsVolume) {
  Dataset dataset = MakeData(false, false);
  dataset.relative_uncertainty[kVolume] = 0.02;
  dataset.measured = {{"valve-1", "sonic_conductance_fill"}};
  dataset.measured[0].declared = 5e-10;
  dataset.runs[0].measured.places = {{0, MeasuredPlace::Of::kFillConductance, 0},
                                     {0, MeasuredPlace::Of::kExhaustConductance, 0}};
  const Identifiability found = Of(dataset);
  EXPECT_THAT(found.aliases, IsEmpty());
  EXPECT_THAT(found.by_volume, UnorderedElementsAre("sonic_conductance_fill of valve-1"));
  EXPECT_EQ(Sentences(found)[0],
            "sonic_conductance_fill of valve-1 is known only as well as the volume of the bottle, "
            "which is declared to 2 %: where the volume is 2 % wrong, so is it.");
}

TEST(Identify, EachAloneIsFixed) {
  for (const std::size_t number : {kVolume, kConductance}) {
    Dataset dataset = MakeData(false, false);
    dataset.relative_uncertainty[number] = kUnknown;
    const Identifiability found = Of(dataset);
    EXPECT_THAT(found.aliases, IsEmpty());
    EXPECT_THAT(found.silent, IsEmpty());
  }
}

TEST(Identify, AMeasuredFlowTellsThemApart) {
  Dataset dataset = MakeData(false, true);
  dataset.relative_uncertainty[kVolume] = kUnknown;
  dataset.relative_uncertainty[kConductance] = kUnknown;
  EXPECT_THAT(Of(dataset).aliases, IsEmpty());
}

TEST(Identify, DeadVolumeIsAnAliasOfVolumeInABlockedActuator) {
  Dataset dataset = MakeData(true, false);
  dataset.relative_uncertainty[kVolume] = 0.1;
  const Identifiability found = Of(dataset, {{model::FindEffect("dead_volume"), {1e-6}}});
  ASSERT_EQ(found.aliases.size(), 1u);
  EXPECT_THAT(found.aliases[0], UnorderedElementsAre("rest_volume", "dead_volume.volume_m3"));
}

TEST(Identify, ANumberThatNoReadingDependsOnIsSilent) {
  Dataset dataset = MakeData(true, false);  // creep does nothing in a blocked actuator
  dataset.relative_uncertainty[kConductance] = 0.05;
  const Identifiability found = Of(dataset, {{model::FindEffect("creep"), {0.1, 1.0}}});
  EXPECT_THAT(found.silent, UnorderedElementsAre("creep.fraction", "creep.time_constant_s"));
  EXPECT_THAT(found.aliases, IsEmpty());
}

}  // namespace identifiability_test
}  // namespace plenum::calibration
